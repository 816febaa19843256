// A file of this computer brought into the folder.
export default {
  template: `
<p class="tb-bring"><label>Bring a file into this folder <input type="file" :accept="endings.join(',')" @change="bring"></label></p>`,
  props: { address: String, endings: Array },
  emits: ["brought", "refused"],
  methods: {
    async bring(event) {
      const input = event.target, file = input.files[0];
      if (!file) return;
      try {
        const answer = await fetch(this.address + "bring/" + encodeURIComponent(file.name), { method: "POST", body: file });
        const text = await answer.text();
        this.$emit(answer.ok ? "brought" : "refused", { text: text });
      } catch (error) {
        this.$emit("refused", { text: "The file could not be read: " + error.message });
      }
      input.value = ""; // the same file may be chosen again; the dialog may be gone
    },
  },
};
