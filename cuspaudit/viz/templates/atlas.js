"use strict";
(() => {
  const body = document.querySelector("#arms tbody");
  const rows = [...body.rows];
  const search = document.getElementById("search");
  const choices = [...document.querySelectorAll("select[data-column]")];
  const words = (row) => row.textContent.toLowerCase();
  const NUMBERS = ["joints", "aspects", "postures", "clearance", "margin"];

  function show() {
    const asked = search.value.toLowerCase().split(/\s+/).filter(Boolean);
    let count = 0;
    for (const row of rows) {
      const fits = asked.every((word) => words(row).includes(word))
        && choices.every((c) => !c.value || row.dataset[c.dataset.column] === c.value);
      row.hidden = !fits;
      count += fits;
    }
    document.getElementById("shown").textContent = count === 1 ? "1 arm" : `${count} arms`;
  }

  /** Rows without a value come last, whichever way; the order of equals is kept. */
  function sort(key, up) {
    const value = (row) => row.dataset[key];
    const order = (a, b) => NUMBERS.includes(key) ? Number(a) - Number(b) : a.localeCompare(b, "en", { numeric: true });
    const sorted = [...rows].sort((a, b) => {
      const [x, y] = [value(a), value(b)];
      if (!x || !y) return (x ? 0 : 1) - (y ? 0 : 1);
      return up ? order(x, y) : order(y, x);
    });
    body.append(...sorted);
  }

  for (const button of document.querySelectorAll("[data-sort]"))
    button.addEventListener("click", () => {
      const head = button.closest("th");
      const up = head.getAttribute("aria-sort") !== "ascending";
      for (const other of head.parentElement.cells)
        if (other.hasAttribute("aria-sort")) other.setAttribute("aria-sort", "none");
      head.setAttribute("aria-sort", up ? "ascending" : "descending");
      sort(button.dataset.sort, up);
    });
  search.addEventListener("input", show);
  for (const choice of choices) choice.addEventListener("change", show);
  document.querySelector("form.controls").addEventListener("submit", (event) => event.preventDefault());
  document.getElementById("cards").addEventListener("change", (event) =>
    document.body.classList.toggle("cards", event.target.checked));
  show();
  document.documentElement.dataset.ready = "";
})();
