// The whole scenario as text, with line numbers; it stands in place of the form.
export default {
  template: `
<div class="tb-text">
  <p><button type="button" :aria-pressed="String(shown)" @click="shown = !shown; $emit('show', {open: shown})">Edit as text</button></p>
  <div v-show="shown" class="tb-editor">
    <div class="tb-lines" aria-hidden="true" ref="lines"><span v-for="n in count" :key="n" :class="{wrong: wrong.includes(n)}">{{ n }}</span></div>
    <textarea ref="area" wrap="off" spellcheck="false" autocapitalize="off" autocomplete="off" aria-label="Scenario as text" :aria-invalid="Boolean(wrong.length)" @input="typed" @change="send" @scroll="$refs.lines.scrollTop = $event.target.scrollTop"></textarea>
  </div>
</div>`,
  // `taken` is the number of the text that the server has taken last
  props: { open: Boolean, text: String, taken: Number, wrong: Array, most: Number },
  emits: ["show", "text"],
  data() { return { shown: this.open, count: 1, sent: null, number: this.taken }; },
  mounted() { this.put(this.text); this.place(); },
  watch: {
    text() { this.follow(); },
    taken() { this.follow(); },
    open() { this.shown = this.open; },
    shown() { this.place(); },
  },
  methods: {
    place() { document.documentElement.classList.toggle("tb-as-text", this.shown); },
    // of a server that is behind nothing is shown: what has been typed meanwhile stays
    follow() { if (this.taken === this.number && this.text !== this.sent) this.put(this.text); },
    put(text) {
      const area = this.$refs.area, [top, at] = [area.scrollTop, area.selectionStart];
      clearTimeout(this.timer);
      this.sent = area.value = text;
      this.count = text.split("\n").length;
      area.selectionStart = area.selectionEnd = at;
      area.scrollTop = top;
    },
    typed() {
      this.count = this.$refs.area.value.split("\n").length;
      clearTimeout(this.timer);
      this.timer = setTimeout(() => this.send(), 400);
    },
    send() {
      clearTimeout(this.timer);
      const text = this.$refs.area.value;
      if (text === this.sent) return;
      this.sent = text;
      // a longer message would not arrive
      this.$emit("text", text.length > this.most ? { length: text.length } : { text: text, number: ++this.number });
    },
    go(line) {
      this.$nextTick(() => {
        const area = this.$refs.area, lines = area.value.split("\n");
        const begin = lines.slice(0, line - 1).reduce((sum, one) => sum + one.length + 1, 0);
        area.focus();
        area.setSelectionRange(begin, begin + (lines[line - 1] || "").length);
        area.scrollTop = area.scrollHeight * (line - 1) / lines.length - area.clientHeight / 3;
        area.scrollLeft = 0;
      });
    },
  },
};
