// The theme's scripts, corrected.

// Its scroll spy would read all links of a page, and fail at a link to a moment of a
// scene: it shall read those of the page's contents, as it means to.
addEventListener("DOMContentLoaded", () => {
  document.body.dataset.bsTarget = "#pst-page-toc-nav";
});

// Paper is light, whatever the screen is.
const page = document.documentElement.dataset;
let theme;
addEventListener("beforeprint", () => {
  theme = page.theme;
  page.theme = "light";
});
addEventListener("afterprint", () => {
  page.theme = theme;
});
