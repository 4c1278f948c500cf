// The link of the page that is shown, going back included; the new page begins at its top and is announced by its title.
// The title also says that work goes on, and that it is done, until somebody looks.
let shown = location.pathname;
let mark = "";
setInterval(() => {
  if (shown !== location.pathname) document.getElementById("page")?.scrollTo({ top: 0, behavior: "instant" });
  shown = location.pathname;
  if (document.querySelector(".job")) mark = "… ";
  else if (mark === "… ") mark = document.hidden ? "✓ " : "";
  else if (!document.hidden) mark = "";
  for (const link of document.querySelectorAll(".rail a")) {
    const here = link.getAttribute("href") === location.pathname;
    if (here) link.setAttribute("aria-current", "page");
    else link.removeAttribute("aria-current");
    if (here) document.title = `${mark}${link.querySelector(".name").textContent} – Workbench`;
  }
}, 150);

// Keys that count everywhere but where something is being typed.
document.addEventListener("keydown", (event) => {
  if (event.target.matches?.("textarea, input:not([type=range], [type=checkbox])")) return;
  const key = event.key.toLowerCase();
  const command = event.ctrlKey || event.metaKey;
  const shut = document.querySelector(".help") ? "help" : "";
  const name = !command ? { "?": "help", escape: shut }[key] : key === "z" ? (event.shiftKey ? "redo" : "undo") : { y: "redo" }[key];
  if (!name || event.altKey) return;
  event.preventDefault();
  emitEvent(name);
});

// A press counts where a button or a box stood when the mouse went down, though the page has moved it before the mouse went up.
let pressed = null;
document.addEventListener("pointerdown", (event) => {
  const target = event.button === 0 && event.target.closest("button, a, [type=checkbox]");
  pressed = target && { target, place: target.getBoundingClientRect() };
});
document.addEventListener("pointerup", (event) => {
  if (!pressed || pressed.target.contains(event.target)) return;
  const { left, right, top, bottom } = pressed.place;
  const [x, y] = [event.clientX, event.clientY];
  if (left <= x && x <= right && top <= y && y <= bottom) pressed.target.click();
});

// Paper is light.
let dark = false;
addEventListener("beforeprint", () => (dark = document.body.classList.contains("body--dark")) && document.body.classList.remove("body--dark"));
addEventListener("afterprint", () => dark && document.body.classList.add("body--dark"));
