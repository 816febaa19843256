// What is wrong, with a way to the field or line and remedies, and warnings.
export default {
  template: `
<div class="tb-messages" role="status" aria-live="polite">
  <p v-if="!errors.length" class="tb-quiet">{{ doubtful ? "What was wrong is being computed with the new values …" : "Nothing to mend." }}</p>
  <ul v-if="errors.length" aria-label="To mend"><li v-for="(one, k) in errors" :key="k" class="tb-error"><button v-if="one.key || one.line" type="button" class="tb-plain" @click="$emit('go', {path: one.key, line: one.line})"><template v-if="one.line && !one.text.includes(': line ' + one.line)">Line {{ one.line }}: </template>{{ one.text }}</button><template v-else>{{ one.text }}</template>
    <span v-if="one.remedies.length" class="tb-remedies"><button v-for="(remedy, n) in one.remedies" :key="n" type="button" @click="$emit('mend', {text: one.text, number: n})">{{ remedy }}</button></span></li></ul>
  <details v-if="warnings.length" open><summary>{{ warnings.length }} {{ warnings.length === 1 ? "warning" : "warnings" }}</summary><ul><li v-for="(one, k) in warnings" :key="k" :class="{old: one.old}">{{ one.text }}</li></ul></details>
  <details v-if="remarks.length"><summary>{{ remarks.length }} {{ remarks.length === 1 ? "remark" : "remarks" }}</summary><ul><li v-for="(one, k) in remarks" :key="k" :class="{old: one.old}">{{ one.text }}</li></ul></details>
</div>`,
  props: { errors: Array, doubtful: Boolean, warnings: Array, remarks: Array },
  emits: ["go", "mend"],
};
