// Makes places of a flowchart that can be picked into buttons: Enter picks one, arrow keys go to the next that way.
const middle = (g) => {
  const box = g.getBoundingClientRect();
  return { x: box.x + box.width / 2, y: box.y + box.height / 2 };
};

export default {
  template: `<div class="drawing" role="group" :aria-label="label"><slot></slot></div>`,
  props: { label: String, places: Array, picked: String },
  mounted() {
    this.drawn = new MutationObserver(() => this.dress());
    this.drawn.observe(this.$el, { childList: true, subtree: true });
    this.dress();
  },
  unmounted() {
    this.drawn.disconnect();
  },
  watch: {
    picked() {
      this.dress();
    },
  },
  methods: {
    dress() {
      for (const g of this.$el.querySelectorAll("g.node")) {
        const place = this.places[Number(/-n(\d+)-/.exec(g.id)?.[1])];
        if (!place) continue;
        if (!g.dataset.name) this.begin(g, place);
        g.classList.toggle("on", place.name === this.picked);
        if (place.pick) g.setAttribute("aria-pressed", String(place.name === this.picked));
      }
    },
    begin(g, place) {
      g.dataset.name = place.name;
      g.classList.add(...place.kind.split(" "));
      g.setAttribute("role", place.pick ? "button" : "img");
      g.querySelector(".label")?.setAttribute("aria-hidden", "true"); // its name is the title
      const title = document.createElementNS("http://www.w3.org/2000/svg", "title");
      title.textContent = place.words;
      g.prepend(title);
      if (place.share !== null) this.bar(g, place.share);
      if (!place.pick) return;
      g.classList.add("pick");
      g.setAttribute("tabindex", "0");
      g.addEventListener("click", () => this.$emit("pick", place.name));
      g.addEventListener("keydown", (event) => this.key(event, g, place));
    },
    bar(g, share) {
      const around = g.querySelector("rect").getBBox();
      const bar = document.createElementNS("http://www.w3.org/2000/svg", "rect");
      const sizes = { x: around.x + 5, y: around.y + around.height - 8, rx: 2, height: 4 };
      sizes.width = Math.max(2, (around.width - 10) * share);
      for (const [name, value] of Object.entries(sizes)) bar.setAttribute(name, value);
      bar.setAttribute("class", "share");
      g.append(bar);
    },
    key(event, g, place) {
      if (event.altKey || event.ctrlKey || event.metaKey) return;
      const way = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
      if (event.key === "Enter" || event.key === " ") this.$emit("pick", place.name);
      else if (way) this.next(g, way)?.focus();
      else return;
      event.preventDefault();
    },
    next(g, way) {
      const here = middle(g);
      const far = (other) => {
        const to = middle(other);
        const along = (to.x - here.x) * way[0] + (to.y - here.y) * way[1];
        return along > 1 ? along + 2.5 * (Math.abs((to.x - here.x) * way[1]) + Math.abs((to.y - here.y) * way[0])) : Infinity;
      };
      const others = [...this.$el.querySelectorAll("g.node.pick")].filter((one) => far(one) < Infinity);
      return others.sort((a, b) => far(a) - far(b))[0];
    },
  },
};
