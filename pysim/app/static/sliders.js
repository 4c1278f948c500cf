// A table of parameters: a number, a slider between its bounds (by its logarithm where they lie far apart), fitted or not.
// What is given stays until the server has heard of it: what it said before says what stood there before.
import Entry from "/static/entry.js";

const STEPS = 1000;
const far = (row) => row.min > 0 && row.max / row.min > 100;

export default {
  template: `
    <div class="table-scroll"><table class="table sliders">
      <caption class="unseen">Parameters</caption>
      <thead><tr><th v-for="name in heads" :key="name" scope="col">{{ name }}</th></tr></thead>
      <tbody><tr v-for="row in rows" :key="row.name">
        <td class="words"><b>{{ row.name }}</b> <span class="small">{{ row.about }}</span></td>
        <td><Entry needed type="number" step="any" class="field" :aria-label="'value of ' + row.name" :value="shown(row)" :stamp="stamp"
                   @put="(words) => move(row, Number(words), true)" /></td>
        <td><input v-if="row.slides" type="range" min="0" :max="steps" :aria-label="'slider of ' + row.name" :value="place(row)"
                   :aria-valuetext="shown(row) + ' ' + row.unit" @input="slid(row, $event, false)" @change="slid(row, $event, true)"
                   @pointerup="held = false" @blur="held = false" /></td>
        <td v-if="fits" class="number">{{ row.now == null ? "" : Number(row.now.toPrecision(4)) }}</td>
        <td>{{ row.unit }}</td>
        <td v-for="end in ['min', 'max']" :key="end"><Entry needed type="number" step="any" class="field bound" :aria-label="end + ' of ' + row.name"
              :value="short(row[end])" :stamp="stamp" @put="(words) => give('bound', { name: row.name, end, value: Number(words) })" /></td>
        <td class="tick"><input v-if="row.slides" type="checkbox" :aria-label="'fit ' + row.name" :checked="row.fitted"
                                @change="give('fit', { name: row.name, on: $event.target.checked })" /></td>
      </tr></tbody>
    </table></div>`,
  components: { Entry },
  props: { rows: Array, heard: Number },
  emits: ["move", "fit", "bound"],
  data() {
    return { steps: STEPS, values: this.told(), stamp: 0, given: this.heard, held: false }; // a slider is held
  },
  computed: {
    fits() {
      return this.rows.some((row) => row.now != null);
    },
    heads() {
      return ["parameter", "begins at", "slider", ...(this.fits ? ["fitted value"] : []), "unit", "min", "max", "is fitted"];
    },
  },
  watch: {
    rows: { deep: true, handler: "follow" },
    heard: "follow",
  },
  methods: {
    follow() {
      if (this.held || this.given > this.heard) return;
      this.values = this.told();
      this.stamp += 1; // what was refused is shown no more
    },
    give(kind, what) {
      this.given += 1;
      this.$emit(kind, what);
    },
    told() {
      return Object.fromEntries(this.rows.map((row) => [row.name, row.value]));
    },
    shown(row) {
      return Number(this.values[row.name].toPrecision(5));
    },
    short(value) {
      const power = value == null ? "" : value.toExponential().replace("e+", "e"); // 3e8 for 300000000: all of it is seen
      return String(value ?? "").length > Math.max(7, power.length) ? power : value;
    },
    place(row) {
      const value = this.values[row.name];
      const share = far(row) ? Math.log(value / row.min) / Math.log(row.max / row.min) : (value - row.min) / (row.max - row.min);
      return Math.round(STEPS * share);
    },
    slid(row, event, done) {
      this.held = !done;
      const share = event.target.value / STEPS;
      const value = far(row) ? row.min * (row.max / row.min) ** share : row.min + (row.max - row.min) * share;
      this.move(row, value, done);
    },
    move(row, value, done) {
      this.values[row.name] = value;
      if (done) this.give("move", { name: row.name, value, done });
      else this.$emit("move", { name: row.name, value, done });
    },
  },
};
