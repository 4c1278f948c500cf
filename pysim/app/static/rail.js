// The link of the page that is shown, going back included; the new page begins at its top and is announced by its title.
let shown = location.pathname;
setInterval(() => {
  if (shown !== location.pathname) document.getElementById("page")?.scrollTo({ top: 0, behavior: "instant" });
  shown = location.pathname;
  for (const link of document.querySelectorAll(".rail a")) {
    const here = link.getAttribute("href") === location.pathname;
    if (here) link.setAttribute("aria-current", "page");
    else link.removeAttribute("aria-current");
    if (here) document.title = `${link.querySelector(".name").textContent} – Workbench`;
  }
}, 150);
