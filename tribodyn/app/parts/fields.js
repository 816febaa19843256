// The form: groups of fields with units, usual ranges, sliders and messages.
const number = (text) => (/^\s*[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?\s*$/i.test(String(text)) ? Number(text) : NaN);
const short = (value) => String(Number(value.toPrecision(6)));
let forms = 0;

export default {
  template: `
<div class="tb-fields">
  <p class="tb-search"><label :for="name + '-search'">Find a field</label>
    <input :id="name + '-search'" type="search" v-model="wanted" autocomplete="off" placeholder="tip relief, oil, speed …" data-search></p>
  <p class="tb-quiet" role="status">{{ wanted ? found + (found === 1 ? " field" : " fields") : "" }}</p>
  <details v-for="(group, g) in groups" :key="group.path" v-show="(shown(group).length || (!wanted && (group.removed || !group.present))) && (group.present || absent || wanted || wrong(group))" :class="{absent: !group.present}" :open="opened(group, g)" @toggle="toggled(group, g, $event)">
    <summary><span>{{ group.title }}</span><span class="tb-count" v-if="wrong(group)">{{ wrong(group) }} to mend</span></summary>
    <p class="tb-quiet" v-if="group.description">{{ group.description }}</p>
    <p class="tb-rows" v-if="group.copied || group.removed || (!group.present && opened(group, g))">
      <button v-if="!group.present" type="button" :aria-label="'Add ' + group.title" @click="$emit('add', {path: group.path})">Add this table</button>
      <button v-if="group.copied" type="button" :aria-label="'Copy ' + group.title" @click="$emit('copy', {path: group.path})">Copy</button>
      <button v-if="group.removed" type="button" :aria-label="'Remove ' + group.title" @click="$emit('remove', {path: group.path})">Remove</button>
    </p>
    <div v-if="opened(group, g)">
    <div v-for="field in shown(group)" :key="field.path" class="tb-field" :class="{wrong: errors[field.path], set: isSet(field)}" :data-field="field.path">
      <div class="tb-label">
        <label :for="id(field)">{{ field.label }}<abbr v-if="field.required" title="must be given">*</abbr></label>
        <button type="button" class="tb-small" :aria-expanded="String(about === field.path)" :aria-controls="id(field) + '-about'" :aria-label="'About ' + field.label" @click="about = about === field.path ? '' : field.path">?</button>
        <button v-if="isSet(field) && !field.required" type="button" class="tb-small" :aria-label="'Back to the default: ' + field.label" title="Back to the default" @click="$emit('unset', {path: field.path})">×</button>
      </div>
      <div class="tb-entry">
        <input v-if="field.kind === 'switch'" :id="id(field)" type="checkbox" role="switch" :checked="text(field) === 'true'" :aria-describedby="described(field)" :aria-invalid="Boolean(errors[field.path])"
          @change="send(field, $event.target.checked ? 'true' : 'false')">
        <select v-else-if="field.kind === 'choice'" :id="id(field)" :value="text(field)" :aria-describedby="described(field)" :aria-invalid="Boolean(errors[field.path])" @change="send(field, $event.target.value)">
          <option v-if="!field.choices.includes(text(field))" :value="text(field)">{{ text(field) || "–" }}</option>
          <option v-for="choice in field.choices" :key="choice" :value="choice">{{ choice }}</option>
        </select>
        <template v-else>
          <input :id="id(field)" type="text" autocomplete="off" spellcheck="false" :inputmode="field.kind === 'number' ? 'decimal' : 'text'" :value="text(field)" :placeholder="field.default || (field.example ? 'like ' + field.example : '')"
            :aria-describedby="described(field)" :aria-invalid="Boolean(errors[field.path])" :list="field.choices.length ? id(field) + '-names' : null"
            @focus="begin(field, $event.target.value)" @input="typed(field, $event.target.value)" @change="send(field, $event.target.value)" @blur="end(field)" @keydown="stepped(field, $event)">
          <datalist v-if="field.choices.length" :id="id(field) + '-names'"><option v-for="choice in field.choices" :key="choice" :value="choice"></option></datalist>
          <select v-if="field.kind === 'number' && field.units.length > 1" :aria-label="'Unit of ' + field.label" :value="unit(field)" @change="$emit('unit', {path: field.path, unit: $event.target.value})">
            <option v-for="one in field.units" :key="one" :value="one">{{ one }}</option>
          </select>
          <span v-else-if="field.kind === 'number'" class="tb-unit">{{ unit(field) }}</span>
        </template>
      </div>
      <div class="tb-slide" v-if="ranges[field.path]">
        <input type="range" :aria-label="field.label + ', slider'" :aria-valuetext="text(field) + ' ' + unit(field)" :min="ranges[field.path][0]" :max="ranges[field.path][1]" :step="step(field)" :value="place(field)"
          @pointerdown="begin(field, text(field))" @input="slid(field, $event.target.value)" @change="released(field, $event.target.value)">
        <small class="tb-quiet">{{ ranges[field.path][2] ? "usual" : "slider" }} {{ brief(ranges[field.path][0]) }} to {{ brief(ranges[field.path][1]) }} {{ unit(field) }}</small>
      </div>
      <p class="tb-error" :id="id(field) + '-error'" v-if="errors[field.path]">{{ errors[field.path] }}</p>
      <p class="tb-about" :id="id(field) + '-about'" v-show="about === field.path">{{ field.description }}<br><code>{{ field.path }}</code><template v-if="field.default">; default {{ field.default }}</template><template v-if="values[field.path] && values[field.path][3]">; from {{ values[field.path][3] }}</template><template v-if="field.source">; usual range: {{ field.source }}</template></p>
    </div>
    </div>
    <p v-if="group.further && opened(group, g) && !wanted"><button type="button" class="tb-plain" @click="all[group.path] = !all[group.path]">{{ all[group.path] ? "Fewer fields" : "All fields of " + group.title }}</button></p>
  </details>
  <p v-if="!wanted && groups.some((group) => !group.present)"><button type="button" class="tb-plain" :aria-expanded="String(absent)" @click="absent = !absent">{{ absent ? "Hide tables that are not written" : "Tables that this scenario does not have yet" }}</button></p>
  <form v-if="!wanted && held.length" class="tb-add" @submit.prevent="added">
    <label :for="name + '-add'">Add one of</label>
    <select :id="name + '-add'" v-model="adding"><option value="">–</option><option v-for="one in held" :key="one.path" :value="one.path">{{ one.label }}</option></select>
    <template v-if="chosen && chosen.named"><label :for="name + '-new'">Its name</label><input :id="name + '-new'" type="text" v-model="called" autocomplete="off" spellcheck="false"></template>
    <button type="submit" :disabled="!chosen || (chosen.named && !called)">Add</button>
    <p class="tb-quiet" v-if="chosen && chosen.about">{{ chosen.about }}</p>
  </form>
</div>`,
  props: { groups: Array, held: Array },
  emits: ["edit", "unset", "unit", "ready", "add", "copy", "remove"],
  mounted() { this.$emit("ready"); },
  data() {
    return { values: {}, errors: {}, ranges: {}, written: "", absent: false, wanted: "", about: "", open: {}, all: {}, local: {}, adding: "", called: "", name: "tb" + ++forms };
  },
  computed: {
    chosen() { return this.held.find((one) => one.path === this.adding); },
    found() { return this.groups.reduce((sum, group) => sum + this.shown(group).length, 0); },
    // the fields of every group that are shown, looked for once while a value is dragged
    lists() { return new Map(this.groups.map((group) => [group.path, this.matching(group)])); },
    given() { return new Set(this.written.split("\n")); },
  },
  methods: {
    id(field) { return this.name + "-" + field.path.replace(/[^A-Za-z0-9]/g, "-"); },
    described(field) { return this.errors[field.path] ? this.id(field) + "-error" : this.id(field) + "-about"; },
    isSet(field) { return this.given.has(field.path); },
    text(field) {
      if (field.path in this.local) return this.local[field.path];
      return this.values[field.path] ? this.values[field.path][0] : "";
    },
    unit(field) { return (this.values[field.path] && this.values[field.path][1]) || field.unit; },
    shown(group) { return this.lists.get(group.path) || []; },
    matching(group) {
      const words = this.wanted.toLowerCase().split(/\s+/).filter(Boolean);
      return group.fields.filter((field) => {
        if (this.errors[field.path]) return true;
        if (words.length) {
          const all = (group.title + " " + field.label + " " + field.path + " " + field.description).toLowerCase();
          return words.every((word) => all.includes(word));
        }
        return !field.advanced || this.all[group.path] || this.isSet(field);
      });
    },
    wrong(group) { return group.fields.filter((field) => this.errors[field.path]).length; },
    opened(group, g) { return Boolean(this.wanted) || (this.open[group.path] ?? (group.open || false)); },
    toggled(group, g, event) { if (!this.wanted) this.open[group.path] = event.target.open; },
    added() {
      this.$emit("add", { path: this.adding, name: this.chosen.named ? this.called.trim() : "", held: true });
      this.adding = this.called = "";
    },
    step(field) { const [low, high] = this.ranges[field.path]; return field.whole ? 1 : (high - low) / 200; },
    place(field) {
      const value = number(this.text(field) || field.default);
      const [low, high] = this.ranges[field.path];
      return isNaN(value) ? low : Math.min(high, Math.max(low, value));
    },
    brief(value) { return short(value); },
    begin(field, text) { this.local[field.path] = text; },
    end(field) { delete this.local[field.path]; },
    typed(field, text) {
      this.local[field.path] = text;
      clearTimeout(this.timer);
      this.timer = setTimeout(() => this.send(field, text), 350);
    },
    stepped(field, event) {
      const sign = { ArrowUp: 1, ArrowDown: -1 }[event.key];
      if (!sign || !this.ranges[field.path]) return;
      const value = number(this.text(field) || field.default);
      if (isNaN(value)) return;
      event.preventDefault();
      const text = short(value + sign * this.step(field) * (event.shiftKey ? 10 : 1));
      this.local[field.path] = text;
      this.send(field, text);
    },
    // the next value goes when the one before it has been taken: the server is never behind
    slid(field, value) {
      this.local[field.path] = short(Number(value));
      this.late = { path: field.path, text: this.local[field.path], dragging: true };
      this.next();
    },
    next() {
      if (!this.late || this.waiting) return;
      this.waiting = setTimeout(() => { this.waiting = null; this.next(); }, 1000);
      this.$emit("edit", this.late);
      if (this.late.released) delete this.local[this.late.path];
      this.late = null;
    },
    released(field, value) {
      this.local[field.path] = short(Number(value));
      this.late = { path: field.path, text: this.local[field.path], dragging: true, released: true };
      this.next();
    },
    send(field, text) {
      clearTimeout(this.timer);
      const now = this.values[field.path];
      if (!text && now === undefined) return;
      if (now && now[0] === text && !this.errors[field.path]) return;
      this.$emit("edit", { path: field.path, text: text, dragging: false });
    },
    take(values, errors, ranges) {
      // Vue does not watch what is frozen, and draws what depends on these alone where one of them is another
      for (const [name, now] of Object.entries({ values, errors, ranges })) if (JSON.stringify(this[name]) !== JSON.stringify(now)) this[name] = Object.freeze(now);
      this.written = Object.keys(values).filter((path) => values[path][2]).join("\n");
      clearTimeout(this.waiting);
      this.waiting = null;
      this.next();
    },
    // Open the group of a field, and go to it.
    go(path) {
      const group = this.groups.find((one) => one.fields.some((field) => field.path === path));
      if (!group) return;
      this.wanted = "";
      this.open[group.path] = true;
      this.all[group.path] = true;
      this.$nextTick(() => this.$nextTick(() => {
        const place = document.getElementById(this.id({ path: path }));
        if (place) { place.scrollIntoView({ block: "center" }); place.focus(); }
      }));
    },
    search() { const place = document.getElementById(this.name + "-search"); place.focus(); place.select(); },
  },
};
