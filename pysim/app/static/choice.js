// One of a list of plain texts.
export default {
  template: `<select :aria-label="label" v-model="value" @change="$emit('pick', value)">
      <option v-for="one in options" :key="one" :value="one">{{ one }}</option>
    </select>`,
  props: { label: String, options: Array, chosen: String },
  data() {
    return { value: this.chosen };
  },
  watch: {
    chosen(now) {
      this.value = now;
    },
  },
};
