// Boxes and lines of a model. Boxes that can be picked are buttons: Enter picks one, arrow keys go to the next that way.
const headed = (points, back) => {
  const [tip, from] = back ? [points[0], points[1]] : [points[points.length - 1], points[points.length - 2]];
  const [dx, dy] = [Math.sign(tip[0] - from[0]), Math.sign(tip[1] - from[1])];
  const [x, y] = tip;
  return `M${x},${y} L${x - 7 * dx + 3.6 * dy},${y - 7 * dy + 3.6 * dx} L${x - 7 * dx - 3.6 * dy},${y - 7 * dy - 3.6 * dx} Z`;
};

export default {
  template: `
    <div class="drawing">
      <svg :viewBox="'0 0 ' + width + ' ' + height" :style="{ width: width + 'px' }" role="group" :aria-label="label">
        <g v-for="(line, i) in lines" :key="'l' + i" class="link" :class="line.kind" aria-hidden="true">
          <polyline :points="line.points.map((p) => p.join(',')).join(' ')" />
          <path v-if="line.kind !== 'joint' && line.points.length > 1" :d="head(line.points, false)" />
          <path v-if="line.kind === 'both' && line.points.length > 1" :d="head(line.points, true)" />
        </g>
        <circle v-for="(dot, i) in dots" :key="'d' + i" class="branch" :cx="dot[0]" :cy="dot[1]" r="3" aria-hidden="true" />
        <g v-for="box in boxes" :key="box.name" class="box" :class="[box.kind, { on: box.name === picked, pick: box.pick }]"
           :data-name="box.name" :role="box.pick ? 'button' : 'img'" :aria-label="box.words"
           :aria-pressed="box.pick ? String(box.name === picked) : null" :tabindex="box.pick ? 0 : null"
           :transform="'translate(' + (box.x - box.wide / 2) + ',' + (box.y - box.high / 2) + ')'"
           @click="box.pick && $emit('pick', box.name)" @keydown="key($event, box)">
          <title>{{ box.words }}</title>
          <rect :width="box.wide" :height="box.high" :rx="round(box)" />
          <rect v-if="box.share !== null" class="share" x="5" :y="box.high - 8" :width="Math.max(2, (box.wide - 10) * box.share)" height="4" rx="2" />
          <text :x="box.wide / 2" text-anchor="middle" :class="{ small: box.rows.length > 1 }">
            <tspan v-for="(row, k) in box.rows" :key="k" :x="box.wide / 2" :y="start(box) + 15 * k">{{ row }}</tspan>
          </text>
          <g v-for="(name, k) in box.has" :key="name" class="has" :transform="'translate(' + box.wide / 2 + ',' + -17 * k + ')'">
            <rect :x="-tag(name) / 2" y="-9" :width="tag(name)" height="17" rx="8.5" />
            <text y="4" text-anchor="middle">+ {{ name }}</text>
          </g>
          <text v-if="box.told" class="told" :x="box.wide / 2" :y="start(box) + 15 * box.rows.length + 2" text-anchor="middle">{{ box.told }}</text>
        </g>
      </svg>
    </div>`,
  props: { label: String, width: Number, height: Number, boxes: Array, lines: Array, dots: Array, picked: String },
  methods: {
    head: headed,
    tag: (name) => 6.1 * (name.length + 2) + 14,
    round: (box) => ({ input: box.high / 2, output: box.high / 2, port: box.high / 2, term: 16 })[box.kind] ?? 7,
    start: (box) => (box.high - (box.share === null ? 0 : 7)) / 2 + 5 - 7.5 * (box.rows.length - 1 + (box.told ? 1.1 : 0)),
    key(event, box) {
      if (!box.pick || event.altKey || event.ctrlKey || event.metaKey) return;
      if (event.key === "Enter" || event.key === " ") this.$emit("pick", box.name);
      else {
        const way = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
        if (!way) return;
        const far = (to) => {
          const along = (to.x - box.x) * way[0] + (to.y - box.y) * way[1];
          const aside = Math.abs((to.x - box.x) * way[1]) + Math.abs((to.y - box.y) * way[0]);
          return along > 1 ? along + 2.5 * aside : Infinity;
        };
        const next = this.boxes.filter((to) => to.pick && far(to) < Infinity).sort((a, b) => far(a) - far(b))[0];
        if (next) [...this.$el.querySelectorAll(".box")].find((g) => g.dataset.name === next.name)?.focus();
      }
      event.preventDefault();
    },
  },
};
