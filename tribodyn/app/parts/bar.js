// What can be done with the scenario as a whole; its keys.
export default {
  template: `
<div class="tb-tools">
  <h1><span class="tb-name">{{ name }}</span><span v-if="unsaved" class="tb-quiet"> (not saved)</span></h1>
  <div class="tb-buttons" role="toolbar" aria-label="Scenario">
    <button v-if="!few" type="button" @click="act('open')">Open</button>
    <button type="button" :disabled="!undo" title="Ctrl Z" @click="act('undo')">Undo</button>
    <button type="button" :disabled="!redo" title="Ctrl Y" @click="act('redo')">Redo</button>
    <button type="button" title="Keep this state to compare with: Alt P" @click="act('pin')">Pin</button>
    <button v-if="!few" type="button" @click="act('jobs')">Run …</button>
    <button v-if="!few" type="button" @click="act('link')">Link</button>
    <button v-if="!few" type="button" @click="act('tour')">Tour</button>
    <button v-if="!few" type="button" @click="act('save-as')">Save as</button>
    <button type="button" class="tb-main" title="Ctrl S" @click="act('save')">Save</button>
    <span class="tb-busy" :class="{on: busy.length}" role="img" :aria-label="busy.length ? 'computing' : 'up to date'" :data-late="busy.join(' ')"></span>
  </div>
  <p class="tb-said" role="status">{{ said || (work ? "Computing " + work : "") }}</p>
</div>`,
  props: { name: String, unsaved: Boolean, undo: Boolean, redo: Boolean, few: Boolean, busy: Array, work: String },
  emits: ["act"],
  data() { return { said: "" }; },
  // numbers of the values before are in italics, until motion is computed
  watch: { busy(now) { document.documentElement.classList.toggle("tb-late", now.includes("motion")); } },
  mounted() {
    this.keys = (event) => {
      const writes = event.target.matches && event.target.matches("input:not([type=range]):not([type=checkbox]), textarea");
      const key = event.key.toLowerCase(), ctrl = event.ctrlKey || event.metaKey;
      const name = ctrl && key === "s" ? "save" : ctrl && key === "z" && !writes ? (event.shiftKey ? "redo" : "undo") : ctrl && key === "y" && !writes ? "redo" : event.altKey && key === "p" ? "pin" : !ctrl && !event.altKey && key === "/" && !writes ? "search" : "";
      if (!name) return;
      event.preventDefault();
      if (name === "search") { const place = document.querySelector("[data-search]"); if (place) place.focus(); }
      else this.act(name);
    };
    this.stay = (event) => { if (this.unsaved && !this.few) event.preventDefault(); };
    this.back = () => this.$emit("act", { name: "back", at: new URLSearchParams(location.search).get("at") || "" });
    document.addEventListener("keydown", this.keys);
    window.addEventListener("popstate", this.back);
    window.addEventListener("beforeunload", this.stay);
  },
  unmounted() { window.removeEventListener("popstate", this.back); document.removeEventListener("keydown", this.keys); window.removeEventListener("beforeunload", this.stay); },
  methods: {
    act(name) {
      // a value that is still being typed counts
      if (document.activeElement && name === "save") document.activeElement.dispatchEvent(new Event("change"));
      this.$emit("act", { name: name });
    },
    say(text) { this.said = text; clearTimeout(this.timer); this.timer = setTimeout(() => { this.said = ""; }, 8000); },
    keep(state, isNew) { history[isNew ? "pushState" : "replaceState"](null, "", state); },
    copy(text) { if (navigator.clipboard) navigator.clipboard.writeText(text).catch(() => {}); },
  },
};
