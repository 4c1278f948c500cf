// One of a list of plain texts. What is chosen stays until that was heard.
export default {
  template: `<select :aria-label="label" v-model="shown" @change="give">
      <option v-for="one in options" :key="one" :value="one">{{ one }}</option>
    </select>`,
  props: { label: String, options: Array, value: String, heard: Number },
  emits: ["put"],
  data() {
    return { shown: this.value, given: this.heard };
  },
  watch: { value: "show", heard: "show" },
  methods: {
    show() {
      if (this.given <= this.heard) this.shown = this.value;
    },
    give() {
      this.given += 1;
      this.$emit("put", this.shown);
    },
  },
};
