// One of a list of plain texts.
export default {
  template: `<select :aria-label="label" v-model="shown" @change="$emit('put', shown)">
      <option v-for="one in options" :key="one" :value="one">{{ one }}</option>
    </select>`,
  props: { label: String, options: Array, value: String, stamp: Number },
  emits: ["put"],
  data() {
    return { shown: this.value };
  },
  watch: { value: "show", stamp: "show" },
  methods: {
    show() {
      this.shown = this.value;
    },
  },
};
