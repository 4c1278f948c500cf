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
  const name = !command ? { "?": "help" }[key] : key === "z" ? (event.shiftKey ? "redo" : "undo") : { y: "redo" }[key];
  if (!name || event.altKey) return;
  event.preventDefault();
  emitEvent(name);
});

// Paper is light.
let dark = false;
addEventListener("beforeprint", () => (dark = document.body.classList.contains("body--dark")) && document.body.classList.remove("body--dark"));
addEventListener("afterprint", () => dark && document.body.classList.add("body--dark"));

// A part of the page that is drawn anew keeps the focus, and what is being typed there, in the field of the same name.
let field = null; // where the focus is: its name, the element, and what was typed and not yet handed over
const named = (element) => element.getAttribute?.("aria-label");
document.addEventListener("focusin", ({ target }) => (field = named(target) ? { name: named(target), target, typed: null } : null));
document.addEventListener("pointerdown", () => (field = null), true);
document.addEventListener("input", ({ target }) => field?.target === target && (field.typed = target.value));
document.addEventListener("change", ({ target }) => {
  // where a field is taken away a browser tells of a change as well, and nobody hears it
  setTimeout(() => target.isConnected && field?.target === target && (field.typed = null));
});
new MutationObserver(() => {
  if (!field || field.target.isConnected) return;
  const { name, typed } = field;
  const again = document.querySelector(`[aria-label="${CSS.escape(name)}"]`);
  if (!again) return;
  again.focus({ preventScroll: true });
  if (typed === null || again.type === "range") return;
  field = { name, target: again, typed };
  again.value = typed;
  let told = false; // a browser tells of a change that the user has made, and not of this one
  again.addEventListener("change", () => (told = true), { once: true });
  const tell = () => told || !again.isConnected || again.dispatchEvent(new Event("change", { bubbles: true }));
  again.addEventListener("blur", () => setTimeout(tell), { once: true }); // not where it is taken away as well
}).observe(document, { childList: true, subtree: true });
