// Two gears in mesh: rolled by dragging, by keys and by a slider; zoom; path of contact, contacts and loads.
import { circle, toothed } from "tribodyn-shapes";

// digits of outlines, mm
const DIGITS = 3;
const place = (points) => {
  let text = "", starts = true;
  for (let k = 0; k + 1 < points.length; k += 2) {
    if (points[k] === null) { text += "Z"; starts = true; continue; }
    text += (starts ? "M" : "L") + points[k].toFixed(4) + " " + points[k + 1].toFixed(4);
    starts = false;
  }
  return text + "Z";
};
const open = (points) => place(points).slice(0, -1);
const degrees = 180 / Math.PI;

export default {
  template: `
<figure class="tb-teeth">
  <svg v-if="picture" ref="svg" tabindex="0" role="application" :aria-label="label" :viewBox="box" preserveAspectRatio="xMidYMid meet"
      @pointerdown="grab" @pointermove="drag" @pointerup="drop" @pointercancel="drop" @wheel.prevent="wheel" @keydown="key">
    <g transform="scale(1,-1)">
      <g v-for="(body, k) in picture.bodies" :key="k" :transform="pose(body)"><path :d="outlines[k]" :class="'tb-body tb-' + body.role" fill-rule="evenodd"/><circle r="0.6" class="tb-axis"/></g>
      <g v-if="pinned"><g v-for="(body, k) in pinned.bodies" :key="'p' + k" :transform="pose(body)"><path :d="pinnedOutlines[k]" class="tb-pinned"/></g></g>
      <path :d="path" class="tb-path"/>
      <path v-if="pinned" :d="pinnedPath" class="tb-path tb-before"/>
      <g v-for="(one, k) in contacts" :key="'c' + k"><path :d="arrow(one)" class="tb-load"/><circle :cx="one.x" :cy="one.y" :r="dot" class="tb-contact"/></g>
    </g>
  </svg>
  <p v-else class="tb-quiet">{{ empty }}</p>
  <div class="tb-roll" v-if="picture">
    <button type="button" @click="play" :aria-pressed="String(playing)">{{ playing ? "Stop" : "Roll" }}</button>
    <input type="range" min="0" max="1" step="0.005" :value="phase" aria-label="Position within one pitch" :aria-valuetext="Math.round(100 * phase) + ' % of a pitch'" @input="to($event.target.value)">
    <button type="button" aria-label="Zoom out" @click="zoomBy(1 / 1.4)">−</button><button type="button" aria-label="Zoom in" @click="zoomBy(1.4)">+</button><button type="button" @click="reset">Fit</button>
    <button type="button" @click="whole">Whole gears</button>
  </div>
  <figcaption v-if="picture"><span v-for="(one, k) in contacts" :key="k" class="tb-chip">pair {{ k + 1 }}{{ one.load === null ? "" : ": " + one.load.toFixed(0) + " N" }}</span>
    <div v-if="picture.said" class="tb-quiet tb-hint">{{ picture.said }}</div>
    <span class="tb-quiet tb-hint">Drag, ← → or the slider roll the teeth; wheel, + − zoom; Shift and drag moves the picture.</span></figcaption>
</figure>`,
  props: { picture: Object, pinned: Object, label: String, empty: String },
  data() { return { angle: 0, zoom: 1, shift: [0, 0], playing: false, held: null }; },
  computed: {
    outlines() { return this.picture.bodies.map((body) => toothed(body, DIGITS) + (body.outside || body.bore ? circle(body.outside || body.bore) : "")); },
    pinnedOutlines() { return this.pinned.bodies.map((body) => toothed(body, DIGITS)); },
    path() { return open(this.picture.path); },
    pinnedPath() { return open(this.pinned.path); },
    // half the width that is seen, mm
    half() { return this.picture.reach / this.zoom; },
    dot() { return 0.018 * this.half; },
    box() {
      const w = this.half, h = 0.72 * w;
      return [this.shift[0] - w, this.shift[1] - h, 2 * w, 2 * h].map((one) => one.toFixed(4)).join(" ");
    },
    phase() { const turned = this.angle / this.picture.pitch; return turned - Math.floor(turned); },
    contacts() {
      const frames = this.picture.contacts;
      if (!frames || !frames.length) return [];
      return frames[Math.min(frames.length - 1, Math.floor(this.phase * frames.length))];
    },
    most() { return Math.max(1e-9, ...(this.picture.contacts || []).flat().map((one) => one.load || 0)); },
  },
  unmounted() { this.playing = false; },
  methods: {
    pose(body) { return "translate(" + body.centre[0] + " " + body.centre[1] + ") rotate(" + (body.turn * this.angle * degrees).toFixed(5) + ")"; },
    arrow(one) {
      if (one.load === null || one.load <= 0) return "";
      const size = 0.34 * this.half * one.load / this.most, dx = one.nx * size, dy = one.ny * size, head = 0.05 * this.half;
      const tip = [one.x + dx, one.y + dy], side = [-one.ny * head * 0.5, one.nx * head * 0.5], back = [tip[0] - one.nx * head, tip[1] - one.ny * head];
      return "M" + one.x + " " + one.y + "L" + tip[0] + " " + tip[1] + "M" + (back[0] + side[0]) + " " + (back[1] + side[1]) + "L" + tip[0] + " " + tip[1] + "L" + (back[0] - side[0]) + " " + (back[1] - side[1]);
    },
    to(phase) { this.angle = this.picture.pitch * (Math.floor(this.angle / this.picture.pitch) + Number(phase)); },
    scale() { return 2 * this.half / this.$refs.svg.clientWidth; },
    grab(event) { this.held = [event.clientX, event.clientY]; event.currentTarget.setPointerCapture(event.pointerId); },
    drag(event) {
      if (!this.held) return;
      const dx = (event.clientX - this.held[0]) * this.scale(), dy = (event.clientY - this.held[1]) * this.scale();
      this.held = [event.clientX, event.clientY];
      if (event.shiftKey || event.buttons === 4) this.shift = [this.shift[0] - dx, this.shift[1] - dy];
      else this.angle += dx / this.picture.radius;
    },
    drop() { this.held = null; },
    wheel(event) { this.zoomBy(event.deltaY < 0 ? 1.15 : 1 / 1.15, event); },
    zoomBy(factor, event) {
      const zoom = Math.min(60, Math.max(this.picture.reach / this.picture.extent / 1.2, this.zoom * factor)), by = zoom / this.zoom;
      if (event) {
        const box = this.$refs.svg.getBoundingClientRect(), scale = this.scale();
        const at = [event.clientX - box.left - box.width / 2, event.clientY - box.top - box.height / 2].map((one) => one * scale);
        this.shift = this.shift.map((one, k) => one + at[k] * (1 - 1 / by));
      }
      this.zoom = zoom;
    },
    reset() { this.zoom = 1; this.shift = [0, 0]; },
    whole() { this.zoom = this.picture.reach / this.picture.extent; this.shift = [0, -this.picture.middle]; },
    play() {
      this.playing = !this.playing;
      let last = null;
      const next = (now) => {
        if (!this.playing || !this.picture) return;
        if (last !== null) this.angle += this.picture.pitch * Math.min(0.1, (now - last) / 1000) / 2;
        last = now;
        requestAnimationFrame(next);
      };
      requestAnimationFrame(next);
    },
    key(event) {
      const step = this.picture.pitch / (event.shiftKey ? 10 : 100);
      const done = { ArrowRight: () => (this.angle += step), ArrowLeft: () => (this.angle -= step), "+": () => this.zoomBy(1.2), "=": () => this.zoomBy(1.2), "-": () => this.zoomBy(1 / 1.2), "0": this.reset, " ": this.play }[event.key];
      if (done && !event.ctrlKey && !event.metaKey) { event.preventDefault(); done(); }
    },
  },
};
