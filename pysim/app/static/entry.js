// A field, or a box to tick. What is typed is handed over when it is left, and stays until then, whatever else is drawn anew.
const holds = (field) => (field.type === "checkbox" ? "checked" : "value");

export default {
  template: `<component :is="tag" @input="type" @change="give" @blur="leave" />`,
  props: {
    value: [String, Number, Boolean],
    tag: { type: String, default: "input" },
    each: Boolean,
    needed: Boolean,
    stamp: Number,
  },
  emits: ["put"],
  mounted() {
    this.show();
  },
  watch: { value: "show", stamp: "show" },
  methods: {
    show() {
      if (!this.typed) this.$el[holds(this.$el)] = this.value ?? "";
    },
    type() {
      this.typed = true;
      if (this.each) this.$emit("put", this.$el.value);
    },
    give() {
      this.typed = false;
      if (this.needed && this.$el.value === "") this.show();
      else this.$emit("put", this.$el[holds(this.$el)]);
    },
    leave() {
      if (!this.typed) return; // it was given
      this.typed = false;
      this.show();
    },
  },
};
