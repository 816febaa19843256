// Numbers of a variant, beside those of the pinned one.
export default {
  template: `
<div class="tb-numbers">
  <ul v-if="words.length" aria-label="In words" class="tb-words"><li v-for="(one, k) in words" :key="k">{{ one }}</li></ul>
  <table>
    <caption>{{ caption }}</caption>
    <thead><tr><th scope="col">quantity</th><th scope="col">value</th><th scope="col" v-if="compared">pinned</th><th scope="col" v-if="compared">difference</th><th scope="col">unit</th></tr></thead>
    <tbody v-for="group in groups" :key="group.title">
      <tr class="tb-group"><th scope="rowgroup" :colspan="compared ? 5 : 3">{{ group.title }}</th></tr>
      <tr v-for="row in group.rows" :key="row.name" :data-number="row.name" :title="row.about" :class="{moved: compared && row.difference && row.difference !== '0'}">
        <th scope="row">{{ row.label }}</th><td>{{ row.value }}</td><td v-if="compared">{{ row.pinned }}</td><td v-if="compared">{{ row.difference }}</td><td>{{ row.unit }}</td>
      </tr>
    </tbody>
  </table>
  <details v-for="table in tables" :key="table.title"><summary>{{ table.title }}</summary><div class="tb-wide" tabindex="0" role="region" :aria-label="table.title"><table><thead><tr><th v-for="(one, k) in table.columns" :key="k" scope="col">{{ one }}</th></tr></thead><tbody><tr v-for="(row, k) in table.rows" :key="k"><td v-for="(one, n) in row" :key="n">{{ one }}</td></tr></tbody></table></div></details>
</div>`,
  props: { caption: String, groups: Array, compared: Boolean, words: Array, tables: Array },
};
