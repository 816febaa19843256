// A gearbox in the true positions of its axes; a mesh is chosen by click or key.
import { circle, toothed } from "tribodyn-shapes";

export default {
  template: `
<figure class="tb-gearbox" v-if="bodies.length">
  <svg :viewBox="box" preserveAspectRatio="xMidYMid meet" role="group" :aria-label="'Gearbox seen along its axes: ' + bodies.map((one) => one.name).join(', ')">
    <g transform="scale(1,-1)">
      <g v-for="(body, k) in bodies" :key="body.name" :transform="'translate(' + body.x + ' ' + body.y + ') rotate(' + body.angle + ')'"><path :d="outlines[k]" fill-rule="evenodd" :class="'tb-wheel' + (body.internal ? ' tb-internal' : '') + (touched.includes(body.name) ? ' tb-chosen' : '')"/></g>
      <g v-for="mesh in meshes" :key="mesh.name" role="button" tabindex="0" :data-mesh="mesh.name" :aria-pressed="String(mesh.name === chosen)" :aria-label="'Mesh ' + mesh.name" :class="'tb-mesh' + (mesh.name === chosen ? ' tb-chosen' : '')" @click="$emit('choose', {mesh: mesh.name})" @keydown.enter.prevent="$emit('choose', {mesh: mesh.name})" @keydown.space.prevent="$emit('choose', {mesh: mesh.name})"><circle :cx="mesh.x" :cy="mesh.y" :r="0.045 * size"/><title>{{ mesh.name }}</title></g>
    </g>
    <text v-for="body in bodies" :key="'t' + body.name" :x="body.x" :y="body.internal ? 0.94 * body.reach - body.y : -body.y + 0.02 * size" :font-size="0.05 * size" text-anchor="middle">{{ body.name }}</text>
  </svg>
  <label class="tb-which">Mesh <select :value="chosen" @change="$emit('choose', {mesh: $event.target.value})"><option v-for="mesh in meshes" :key="mesh.name" :value="mesh.name">{{ mesh.name }}</option></select></label>
</figure>`,
  props: { bodies: Array, meshes: Array, chosen: String },
  emits: ["choose"],
  computed: {
    outlines() { return this.bodies.map((body) => toothed(body, 2) + (body.radius > 0 ? circle(body.radius) : "")); },
    touched() { const mesh = this.meshes.find((one) => one.name === this.chosen); return mesh ? mesh.bodies : []; },
    limits() {
      const low = [0, 1].map((k) => Math.min(...this.bodies.map((one) => (k ? one.y : one.x) - one.reach)));
      const high = [0, 1].map((k) => Math.max(...this.bodies.map((one) => (k ? one.y : one.x) + one.reach)));
      return [low, high];
    },
    size() { const [low, high] = this.limits; return Math.max(high[0] - low[0], high[1] - low[1]) / 2; },
    box() { const [low, high] = this.limits, pad = 0.08 * this.size; return [low[0] - pad, -high[1] - pad, high[0] - low[0] + 2 * pad, high[1] - low[1] + 2 * pad].join(" "); },
  },
};
