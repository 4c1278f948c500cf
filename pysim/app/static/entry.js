// A field, or a box to tick. What is typed is handed over when it is left, and stays until that was heard, whatever else is
// drawn anew: what was sent before says what stood there before.
const holds = (field) => (field.type === "checkbox" ? "checked" : "value");

export default {
  template: `<component :is="tag" @input="type" @change="give" @blur="leave" />`,
  props: {
    value: [String, Number, Boolean],
    tag: { type: String, default: "input" },
    each: Boolean,
    needed: Boolean,
    stamp: Number,
    heard: { type: Number, default: Infinity }, // how many of those that were handed over
  },
  emits: ["put"],
  data() {
    return { given: this.heard };
  },
  mounted() {
    this.show();
  },
  watch: { value: "show", stamp: "show", heard: "show" },
  methods: {
    show() {
      if (!this.typed && this.given <= this.heard) this.$el[holds(this.$el)] = this.value ?? "";
    },
    type() {
      this.typed = true;
      if (this.each) this.put();
    },
    give() {
      this.typed = false;
      if (this.needed && this.$el.value === "") this.show();
      else this.put();
    },
    put() {
      this.given += 1;
      this.$emit("put", this.$el[holds(this.$el)]);
    },
    leave() {
      if (!this.typed) return; // it was given
      this.typed = false;
      this.show();
    },
  },
};
