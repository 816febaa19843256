// Variants side by side: what differs in the scenario, and numbers.
export default {
  template: `
<div class="tb-variants">
  <p v-if="names.length < 2" class="tb-quiet">Pin keeps the present state. Whatever is changed after that is drawn over it.</p>
  <div v-else class="tb-wide" tabindex="0" role="region" aria-label="Variants side by side">
  <table>
    <caption>Variants side by side</caption>
    <thead><tr><td></td><th v-for="name in names" :key="name" scope="col">{{ name || "now" }}</th></tr>
      <tr><td></td><td v-for="name in names" :key="name"><template v-if="name">
        <button type="button" :aria-label="'Compare with ' + name" :aria-pressed="String(name === chosen)" @click="$emit('compare', {name: name})">compare</button>
        <button type="button" :aria-label="'Go on from ' + name" @click="$emit('restore', {name: name})">go on from it</button>
        <button type="button" :aria-label="'Forget ' + name" @click="$emit('forget', {name: name})">forget</button></template></td></tr></thead>
    <tbody v-for="group in groups" :key="group.title"><tr class="tb-group"><th scope="rowgroup" :colspan="names.length + 1">{{ group.title }}</th></tr>
      <tr v-for="row in group.rows" :key="row.name"><th scope="row">{{ row.label }}</th><td v-for="(value, k) in row.values" :key="k">{{ value }}</td></tr></tbody>
  </table></div>
</div>`,
  props: { names: Array, chosen: String, groups: Array },
  emits: ["restore", "compare", "forget"],
};
