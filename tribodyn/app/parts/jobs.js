// Longer work: progress, cancel, results.
export default {
  template: `
<div class="tb-jobs">
  <p v-if="!jobs.length" class="tb-quiet">Nothing has been started.</p>
  <article v-for="job in jobs" :key="job.number" :data-job="job.state" :aria-label="job.title">
    <h3>{{ job.title }} <span class="tb-quiet">{{ job.ending && job.state === "running" ? "is being ended" : words[job.state] }}</span></h3>
    <p v-if="job.state === 'running'"><progress :value="job.fraction === null ? undefined : job.fraction" max="1" :aria-label="'Progress of ' + job.title"></progress> <button type="button" :disabled="job.ending" @click="$emit('cancel', {number: job.number})">Cancel</button></p>
    <p v-if="job.resumable"><button type="button" :aria-label="'Go on with ' + job.title" @click="$emit('resume', {number: job.number})">Go on</button></p>
    <p class="tb-line" :class="job.state === 'failed' ? 'tb-error' : 'tb-quiet'">{{ job.said }}</p>
    <p><code v-for="name in job.records" :key="name">{{ name }}</code> <a v-for="file in job.files" :key="file.name" :href="file.link" target="_blank" rel="noopener">{{ file.name }}</a> <button v-for="name in job.scenarios" :key="name" type="button" @click="$emit('open', {name: name})">Open {{ name }}</button></p>
    <details v-if="job.output"><summary>What it printed</summary><pre tabindex="0">{{ job.output }}</pre></details>
  </article>
</div>`,
  props: { jobs: Array },
  emits: ["cancel", "resume", "open"],
  data() { return { words: { running: "is running", done: "is done", failed: "failed", cancelled: "was cancelled" } }; },
};
