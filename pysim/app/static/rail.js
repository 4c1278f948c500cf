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

// Paper is light.
let dark = false;
addEventListener("beforeprint", () => (dark = document.body.classList.contains("body--dark")) && document.body.classList.remove("body--dark"));
addEventListener("afterprint", () => dark && document.body.classList.add("body--dark"));
