// The link of the page that is shown, going back included; the new page is announced by its title.
setInterval(() => {
  for (const link of document.querySelectorAll(".rail a")) {
    const here = link.getAttribute("href") === location.pathname;
    if (here) link.setAttribute("aria-current", "page");
    else link.removeAttribute("aria-current");
    if (here) document.title = `${link.querySelector(".name").textContent} – Workbench`;
  }
}, 150);
