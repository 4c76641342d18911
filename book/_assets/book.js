// The theme's scripts, corrected.

// Its scroll spy would read all links of a page, and fail at a link to a moment of a
// scene: it shall read those of the page's contents, as it means to.
addEventListener("DOMContentLoaded", () => {
  document.body.dataset.bsTarget = "#pst-page-toc-nav";
});

// What the theme writes into its pages, where a server may forbid scripts.
addEventListener("DOMContentLoaded", () => {
  for (const button of document.querySelectorAll("[data-clicked]")) {
    button.addEventListener("click", () => globalThis[button.dataset.clicked]());
  }
});

// What is late comes when the page was drawn once; drawn, not only asked to be.
addEventListener("DOMContentLoaded", () => {
  if (!PerformanceObserver.supportedEntryTypes.includes("paint")) return load();
  new PerformanceObserver((_, painted) => {
    painted.disconnect();
    load();
  }).observe({ type: "paint", buffered: true });
});
function load() {
  for (const { src } of document.querySelectorAll("script[type='text/later']")) {
    document.head.append(Object.assign(document.createElement("script"), { src }));
  }
}

// Formulas are set a few at a time: between them the page answers its reader.
const SLICE = 8; // milliseconds
globalThis.MathJax = {
  ...globalThis.MathJax,
  startup: {
    async pageReady() {
      const waiting = [...document.querySelectorAll(".math")];
      while (waiting.length) {
        const end = performance.now() + SLICE;
        while (waiting.length && performance.now() < end) {
          MathJax.typeset(waiting.splice(0, 4));
        }
        await new Promise((resume) => setTimeout(resume));
      }
      return MathJax.typesetPromise(); // what stands elsewhere
    },
  },
};

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
