// Curves over their abscissa, those of the pinned variant dashed behind them; drawn by plotly.
const COLORS = ["--c1", "--c2", "--c3", "--c4", "--c5", "--c6"];
// How long charts that are not seen wait for another value, ms.
const QUIET = 300;
const DASHES = ["solid", "dash", "dot", "dashdot", "longdash", "longdashdot"];
const plain = (text) => String(text).replace(/&/g, "&amp;").replace(/</g, "&lt;");
const short = (value) => (Math.abs(value) >= 1e5 || (value && Math.abs(value) < 1e-3) ? value.toExponential(2) : String(Number(value.toPrecision(4))));

export default {
  template: `
<div class="tb-charts">
  <figure v-for="chart in charts" :key="chart.name" class="tb-chart" :data-chart="chart.name" :class="{late: late.includes(chart.stage)}">
    <h3>{{ chart.title }}<span class="tb-quiet" v-if="chart.y_unit && chart.y_unit !== '1'"> ({{ chart.y_unit }})</span></h3>
    <div class="tb-plot" role="img" :aria-label="said[chart.name]" :data-plot="chart.name"></div>
    <figcaption class="tb-quiet">{{ said[chart.name] }}<br v-if="chart.note">{{ chart.note }}</figcaption>
  </figure>
</div>`,
  emits: ["ready"],
  data() { return { stages: {}, said: {}, late: [] }; },
  computed: {
    charts() { return Object.values(this.stages).flat().sort((a, b) => a.place - b.place); },
  },
  beforeCreate() { this.before = {}; this.seen = new Set(); this.stale = new Set(); },
  async mounted() {
    const { Plotly } = await import("nicegui-plotly");
    this.Plotly = Plotly;
    this.dark = window.matchMedia("(prefers-color-scheme: dark)");
    this.again = () => this.draw(this.charts);
    this.dark.addEventListener("change", this.again);
    this.observer = new ResizeObserver(() => { clearTimeout(this.timer); this.timer = setTimeout(this.again, 60); });
    this.observer.observe(this.$el);
    this.watched = new IntersectionObserver((entries) => {
      for (const { target, isIntersecting } of entries) this.seen[isIntersecting ? "add" : "delete"](target.dataset.plot);
      this.next();
    }, { rootMargin: "100px" });
    this.$emit("ready");
  },
  updated() { for (const place of this.$el.querySelectorAll(".tb-plot")) this.watched?.observe(place); },
  unmounted() { this.observer?.disconnect(); this.watched?.disconnect(); this.dark?.removeEventListener("change", this.again); },
  methods: {
    // charts of a stage; those of the pinned variant; null: there are none
    take(stage, charts, pinned) {
      this.stages[stage] = Object.freeze(charts.map(Object.freeze)); // Vue does not watch what is frozen
      this.before[stage] = pinned || [];
      for (const chart of charts) this.said[chart.name] = this.told(chart);
      this.$nextTick(() => this.draw(charts));
    },
    wait(late) {
      this.late = late;
      this.next();
    },
    told(chart) {
      const all = chart.curves.flatMap((curve) => curve.y).filter((one) => one !== null && isFinite(one));
      if (!all.length) return "no values";
      const low = Math.min(...all), high = Math.max(...all), unit = chart.y_unit === "1" ? "" : " " + chart.y_unit;
      const before = this.older(chart), old = before ? before.curves.flatMap((curve) => curve.y).filter((one) => one !== null && isFinite(one)) : [];
      const was = old.length ? "; pinned " + short(Math.min(...old)) + " to " + short(Math.max(...old)) : "";
      return short(low) + " to " + short(high) + unit + was;
    },
    older(chart) { return (this.before[chart.stage] || []).find((one) => one.name === chart.name); },
    draw(charts) {
      for (const chart of charts) this.stale.add(chart.name);
      this.next();
    },
    // charts that are seen are drawn at once, the others a while after nothing is computed any more; between
    // two of them the browser does what else there is
    next() {
      clearTimeout(this.drawing);
      const first = this.charts.find((one) => this.stale.has(one.name) && this.seen.has(one.name));
      const chart = first || this.charts.find((one) => this.stale.has(one.name));
      if (!this.Plotly || !chart || (!first && this.late.length)) return;
      this.drawing = setTimeout(() => { this.stale.delete(chart.name); this.drawOne(chart); this.next(); }, first ? 0 : QUIET);
    },
    drawOne(chart) {
      const place = this.$el.querySelector(`[data-plot="${chart.name}"]`);
      if (!place || !place.clientWidth) return;
      const css = getComputedStyle(this.$el), color = (name) => css.getPropertyValue(name).trim();
      const coarse = window.matchMedia("(pointer: coarse)").matches;
      const bars = chart.kind === "bars", before = this.older(chart);
      const line = (curve, k, old) => ({
        x: (old ? before : chart).x, y: curve.y, name: plain(curve.name || (old ? "" : "now")) + (old ? (curve.name ? ", pinned" : "pinned") : ""), hoverlabel: { namelength: 30 },
        ...(bars ? { type: "bar", marker: { color: old ? color("--pin") : color(COLORS[k % 6]) } }
          : { type: "scatter", mode: "lines", connectgaps: false, line: old ? { color: color("--pin"), width: 1.2, dash: "dot" } : { color: color(COLORS[k % 6]), width: 1.8, dash: chart.curves.length > 1 ? DASHES[k % 6] : "solid" } }),
      });
      const data = [...(before ? before.curves.map((curve, k) => line(curve, k, true)) : []), ...chart.curves.map((curve, k) => line(curve, k, false))];
      const axis = { color: color("--ink"), gridcolor: color("--line"), zerolinecolor: color("--line"), automargin: true, ticks: "", fixedrange: coarse };
      const several = data.length > 1;
      this.Plotly.react(place, data, {
        width: place.clientWidth, height: several ? 250 : 215, margin: { l: 48, r: 8, t: 6, b: 36 }, paper_bgcolor: "rgba(0,0,0,0)", plot_bgcolor: "rgba(0,0,0,0)", font: { color: color("--ink"), size: 12, family: "system-ui, sans-serif" },
        xaxis: { ...axis, title: { text: plain(chart.x_label + (chart.x_unit && chart.x_unit !== "1" ? " (" + chart.x_unit + ")" : "")), standoff: 6 } }, yaxis: { ...axis, rangemode: chart.name.startsWith('te-') || bars ? 'normal' : 'tozero' },
        showlegend: several, legend: { orientation: "h", y: 1.02, yanchor: "bottom", x: 0, font: { size: 11 } }, hovermode: "x unified", hoverlabel: { bgcolor: color("--card"), font: { color: color("--ink") } }, uirevision: "same", bargap: 0.25, dragmode: coarse ? false : "zoom",
      }, { displayModeBar: false, responsive: false });
    },
  },
};
