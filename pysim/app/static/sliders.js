// A table of parameters: a number, a slider between its bounds (by its logarithm where they lie far apart), fitted or not.
const STEPS = 1000;
const far = (row) => row.min > 0 && row.max / row.min > 100;

export default {
  template: `
    <div class="table-scroll"><table class="table sliders">
      <caption class="unseen">Parameters</caption>
      <thead><tr><th v-for="name in ['parameter', 'value', 'slider', 'unit', 'min', 'max', 'fitted']" :key="name" scope="col">{{ name }}</th></tr></thead>
      <tbody><tr v-for="row in rows" :key="row.name">
        <td class="words"><b>{{ row.name }}</b> <span class="small">{{ row.about }}</span></td>
        <td><input type="number" step="any" class="field" :aria-label="'value of ' + row.name" :value="shown(row)" @change="typed(row, $event.target)" /></td>
        <td><input v-if="row.slides" type="range" min="0" :max="steps" :aria-label="'slider of ' + row.name" :value="place(row)"
                   :aria-valuetext="shown(row) + ' ' + row.unit" @input="slid(row, $event, false)" @change="slid(row, $event, true)" /></td>
        <td>{{ row.unit }}</td>
        <td v-for="end in ['min', 'max']" :key="end"><input type="number" step="any" class="field bound" :aria-label="end + ' of ' + row.name"
              :value="row[end]" @change="bound(row, end, $event.target)" /></td>
        <td class="tick"><input v-if="row.slides" type="checkbox" :aria-label="'fit ' + row.name" :checked="row.fitted"
                                @change="$emit('fit', { name: row.name, on: $event.target.checked })" /></td>
      </tr></tbody>
    </table></div>`,
  props: { rows: Array },
  data() {
    return { steps: STEPS, values: this.told() };
  },
  watch: {
    rows: {
      deep: true,
      handler() {
        this.values = this.told();
      },
    },
  },
  methods: {
    told() {
      return Object.fromEntries(this.rows.map((row) => [row.name, row.value]));
    },
    shown(row) {
      return Number(this.values[row.name].toPrecision(5));
    },
    place(row) {
      const value = this.values[row.name];
      const share = far(row) ? Math.log(value / row.min) / Math.log(row.max / row.min) : (value - row.min) / (row.max - row.min);
      return Math.round(STEPS * share);
    },
    slid(row, event, done) {
      const share = event.target.value / STEPS;
      const value = far(row) ? row.min * (row.max / row.min) ** share : row.min + (row.max - row.min) * share;
      this.move(row, value, done);
    },
    typed(row, field) {
      const value = Number(field.value);
      if (field.value !== "" && Number.isFinite(value)) this.move(row, value, true);
      else field.value = this.shown(row);
    },
    bound(row, end, field) {
      if (field.value !== "") this.$emit("bound", { name: row.name, end, value: Number(field.value) });
      else field.value = row[end];
    },
    move(row, value, done) {
      this.values[row.name] = value;
      this.$emit("move", { name: row.name, value, done });
    },
  },
};
