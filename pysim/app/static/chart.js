// A Plotly figure in the look of the page: colours by name, long signals by window, clicks and keys.
const palette = (el) => {
  const style = getComputedStyle(el);
  const known = {}; // asking is slow
  return (name) => (known[name] ??= style.getPropertyValue(`--${name}`).trim() || "#888");
};

function dressed(value, colour) {
  if (typeof value === "string") {
    if (value === "@heat") return [0, 1, 2, 3].map((k) => [k / 3, colour(`heat${k}`)]);
    if (value === "inherit") return "Roboto, system-ui, sans-serif";
    return value.startsWith("@") ? colour(value.slice(1)) : value;
  }
  if (Array.isArray(value)) {
    return value.length && typeof value[0] === "number" ? value : value.map((one) => dressed(one, colour));
  }
  if (value && typeof value === "object") {
    return Object.fromEntries(Object.entries(value).map(([key, one]) => [key, dressed(one, colour)]));
  }
  return value;
}

// Handed over with the first drawing only: Plotly 3.1.1 and later find that lists of buttons differ from themselves,
// and then draw anew without end (plotly.js issue 7572).
function settings(series) {
  const modeBarButtons = [["zoom2d", "pan2d", "zoomIn2d", "zoomOut2d", "resetScale2d", "toImage"]];
  return { displaylogo: false, displayModeBar: series ? "hover" : false, doubleClick: "reset", showTips: false, modeBarButtons };
}

export default {
  template: `<div class="chart" :role="series ? 'group' : 'img'" :aria-label="label" :tabindex="series ? 0 : -1" @keydown="key"></div>`,
  props: { figure: String, series: Object, label: String },
  async mounted() {
    const { Plotly } = await import("nicegui-plotly");
    this.Plotly = Plotly;
    if (!this.$el.isConnected) return;
    await this.draw();
    this.$el.on("plotly_click", (event) => {
      const point = event.points[0];
      this.$emit("pick", { x: point.x, y: point.y, curve: point.curveNumber, index: point.pointIndex });
    });
    this.$el.on("plotly_relayout", (change) => this.moved(change));
    let dark = document.body.classList.contains("body--dark");
    this.look = new MutationObserver(() => {
      const now = document.body.classList.contains("body--dark");
      if (now !== dark) this.draw();
      dark = now;
    });
    this.look.observe(document.body, { attributes: true, attributeFilter: ["class"] });
    let width = this.$el.clientWidth;
    this.size = new ResizeObserver(() => {
      if (this.$el.offsetParent && this.$el.clientWidth !== width) this.draw();
      width = this.$el.clientWidth;
    });
    this.size.observe(this.$el);
    this.$el.dataset.ready = "yes";
  },
  unmounted() {
    this.look?.disconnect();
    this.size?.disconnect();
    if (this.Plotly) this.Plotly.purge(this.$el);
  },
  watch: {
    figure: {
      flush: "post", // a chart may have another height now
      handler() {
        if (this.Plotly) this.draw();
      },
    },
  },
  methods: {
    turn(work) {
      // one call at a time: Plotly does not bear two at once in one place
      const next = () => (this.$el.isConnected ? work() : undefined);
      this.turns = (this.turns ?? Promise.resolve()).then(next, next);
      return this.turns;
    },
    draw() {
      this.wanted = true;
      this.drawing ??= this.redraw().finally(() => (this.drawing = null));
      return this.drawing;
    },
    async redraw() {
      while (this.wanted && this.$el.isConnected) {
        this.wanted = false;
        const { data, layout } = dressed(JSON.parse(this.figure), palette(this.$el));
        const { clientWidth: width, clientHeight: height } = this.$el; // Plotly looks at it for the first drawing only
        if (width && height) Object.assign(layout, { width, height });
        const buttons = this.drawn ? undefined : settings(this.series);
        await this.turn(() => this.Plotly.react(this.$el, data, layout, buttons));
        this.drawn = true;
        if (this.next) this.follow(...Object.values(this.next)); // came before there was a drawing
        if (this.series && this.range) await this.fetch(this.range);
      }
    },
    follow(y, traces, number) {
      this.next = { y, traces, number };
      if (this.drawn) this.following ??= this.catchUp().finally(() => (this.following = null));
    },
    async catchUp() {
      while (this.next && this.$el.isConnected) {
        const { y, traces, number } = this.next;
        this.next = null;
        await this.turn(() => this.Plotly.restyle(this.$el, { y }, traces));
        this.$el.dataset.move = number;
      }
    },
    moved(change) {
      if (!this.series) return;
      const keys = Object.keys(change);
      if (keys.some((key) => key.startsWith("xaxis.autorange"))) this.range = null;
      else if (keys.some((key) => key.startsWith("xaxis.range"))) this.range = [...this.$el.layout.xaxis.range];
      else return;
      this.$emit("range", this.range);
      clearTimeout(this.later);
      this.later = setTimeout(() => this.fetch(this.range), 40);
    },
    async fetch(range) {
      const [low, high] = range ?? this.series.span;
      const room = (high - low) / 2; // what comes into sight while it is moved is there already
      const url = `${this.series.url}&begin=${low - room}&end=${high + room}&most=${this.series.most}`;
      const number = (this.asked = (this.asked ?? 0) + 1);
      const answer = await fetch(url);
      if (!answer.ok || number !== this.asked) return; // another window was asked for since
      const { x, y, exact } = await answer.json();
      await this.turn(() => this.Plotly.restyle(this.$el, { x, y }, this.series.traces));
      this.$el.dataset.exact = exact ? "yes" : "no";
      this.$el.dataset.points = Math.max(...x.map((one) => one.length));
    },
    key(event) {
      if (!this.series || event.altKey || event.ctrlKey || event.metaKey) return;
      const [low, high] = this.range ?? this.series.span;
      const size = high - low;
      const to = {
        ArrowLeft: [low - size / 4, high - size / 4],
        ArrowRight: [low + size / 4, high + size / 4],
        "+": [low + size / 4, high - size / 4],
        "-": [low - size / 2, high + size / 2],
        0: this.series.span,
      }[event.key];
      if (!to) return;
      event.preventDefault();
      this.turn(() => this.Plotly.relayout(this.$el, { "xaxis.range": to }));
    },
  },
};
