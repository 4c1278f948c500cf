// A table of plain texts: rows that can be picked by mouse or keyboard, sorted, and ticked.
export default {
  template: `
    <div class="table-scroll" :style="height ? { maxHeight: height } : {}">
      <table class="table">
        <caption class="unseen">{{ label }}</caption>
        <thead><tr>
          <th v-for="(c, j) in columns" :key="j" scope="col" :class="c.kind" :aria-sort="by === j ? (down ? 'descending' : 'ascending') : 'none'">
            <button type="button" @click="sort(j)">{{ c.title }}<span aria-hidden="true">{{ by === j ? (down ? ' ↓' : ' ↑') : '' }}</span></button>
          </th>
        </tr></thead>
        <tbody>
          <tr v-for="i in order" :key="i" :class="{ picked: i === picked, pickable }" :tabindex="pickable ? 0 : -1"
              :aria-selected="i === picked" @click="pickable && $emit('row', i)" @keydown.enter.prevent="pickable && $emit('row', i)"
              @keydown.down.prevent="step($event, 1)" @keydown.up.prevent="step($event, -1)">
            <td v-for="(c, j) in columns" :key="j" :class="[c.kind, mark(rows[i][j])]">
              <input v-if="c.kind === 'tick'" type="checkbox" :checked="rows[i][j]" :aria-label="c.title + ', ' + rows[i][0]"
                     @click.stop @change="$emit('tick', { row: i, column: c.title, on: $event.target.checked })" />
              <template v-else>{{ text(rows[i][j]) }}</template>
            </td>
          </tr>
        </tbody>
      </table>
    </div>`,
  props: { columns: Array, rows: Array, label: String, picked: Number, pickable: Boolean, height: String },
  data: () => ({ by: null, down: false }),
  computed: {
    order() {
      const all = this.rows.map((_, i) => i);
      if (this.by === null) return all;
      const value = (i) => {
        const cell = this.rows[i][this.by];
        const plain = cell && typeof cell === "object" ? (cell.value ?? cell.text) : cell;
        return plain === "" || plain === null ? null : Number.isNaN(Number(plain)) ? plain : Number(plain);
      };
      const rank = (a, b) => {
        const [p, q] = [value(a), value(b)];
        if (p === null || q === null) return (p === null) - (q === null);
        const size = typeof p === "number" && typeof q === "number" ? p - q : String(p).localeCompare(String(q));
        return this.down ? -size : size;
      };
      return all.sort(rank);
    },
  },
  methods: {
    text: (cell) => (cell && typeof cell === "object" ? cell.text : cell),
    mark: (cell) => (cell && typeof cell === "object" ? cell.mark : ""),
    sort(j) {
      this.down = this.by === j ? !this.down : false;
      this.by = j;
    },
    step(event, by) {
      const next = by > 0 ? event.target.nextElementSibling : event.target.previousElementSibling;
      if (next) next.focus();
    },
  },
};
