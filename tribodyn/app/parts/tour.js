// Five steps for the first time: what each part of the page is for.
const SEEN = "tribodyn-tour";
const STEPS = [
  [".tb-form", "Every value of the scenario", "Groups open by a click; find a field by a word. Type a number, or drag its slider. A line at the side marks what this file says itself."],
  [".tb-picture", "The teeth follow", "They are drawn anew at once. Drag them, or use the arrow keys, to roll them through mesh; arrows are the loads of the pairs."],
  [".tb-curves", "So do the curves", "First the quasi-static ones, then those of the teeth in motion with film and temperature. Drag in a chart to zoom, click twice to see all."],
  [".tb-results", "Pin, then compare", "Pin keeps this state: whatever you change is drawn over its curves, and the numbers show the difference."],
  [".tb-bar", "Save, and go on", "Save writes a scenario file for the command line too. Run starts a run, a sweep, a search or an assessment, each with a report."],
];
export default {
  template: `
<section v-if="at >= 0" class="tb-tour" role="dialog" aria-label="First steps" @keydown.escape="end">
  <h2 ref="title" tabindex="-1">{{ at + 1 }} of {{ steps.length }}: {{ steps[at][1] }}</h2>
  <p>{{ steps[at][2] }}</p>
  <p><button type="button" @click="end">{{ at + 1 < steps.length ? "Skip" : "Done" }}</button> <button v-if="at > 0" type="button" @click="show(at - 1)">Back</button> <button v-if="at + 1 < steps.length" type="button" class="tb-main" @click="show(at + 1)">Next</button></p>
</section>`,
  data() { return { at: -1, steps: STEPS }; },
  mounted() {
    let seen = false;
    try { seen = localStorage.getItem(SEEN) === "seen"; } catch (error) { seen = true; }
    if (!seen) setTimeout(() => this.show(0), 400);
  },
  methods: {
    show(number) {
      this.mark(false);
      this.at = number;
      this.mark(true);
      this.$nextTick(() => this.$refs.title && this.$refs.title.focus({ preventScroll: true }));
    },
    mark(on) {
      const place = this.at >= 0 && document.querySelector(this.steps[this.at][0]);
      if (!place) return;
      place.classList.toggle("tb-shown", on);
      if (on) place.scrollIntoView({ block: "nearest" });
    },
    end() {
      this.mark(false);
      this.at = -1;
      try { localStorage.setItem(SEEN, "seen"); } catch (error) { return; }
    },
  },
};
