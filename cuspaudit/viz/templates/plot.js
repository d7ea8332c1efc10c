"use strict";
(() => {
  const sheet = JSON.parse(document.getElementById("sheet").textContent);
  const figure = document.getElementById("figure");
  const says = document.getElementById("says");
  const cells = figure.querySelector('image[id^="cells-"]');

  // the drawing's own titles would show a second time, and later
  for (const title of figure.querySelectorAll("g[id] > title")) {
    title.parentElement.dataset.says = title.textContent;
    title.remove();
  }

  function postures(event) {
    if (!cells) return "";
    const box = cells.getBoundingClientRect();
    const x = (event.clientX - box.left) / box.width;
    const y = (event.clientY - box.top) / box.height;
    if (!(x >= 0 && x < 1 && y >= 0 && y < 1)) return "";
    const row = sheet.cells[Math.floor(y * sheet.cells.length)];
    const count = parseInt(row[Math.floor(x * row.length)], 36);
    const [left, right, bottom, top] = sheet.window;
    const at = [left + x * (right - left), top - y * (top - bottom)];
    const place = `(${at.map((v) => v.toFixed(3)).join(", ")})`;
    return `${place}: ${count ? count + " postures" : "out of reach"}`;
  }

  function read(event) {
    const mark = event.target.closest("[data-says]");
    const text = mark ? mark.dataset.says : postures(event);
    says.hidden = !text;
    says.textContent = text;
    const left = Math.min(event.clientX + 14, innerWidth - says.offsetWidth - 8);
    says.style.left = Math.max(4, left) + "px";
    says.style.top = event.clientY + 18 + "px";
  }

  figure.addEventListener("pointermove", read);
  figure.addEventListener("pointerdown", read);
  figure.addEventListener("pointerleave", () => (says.hidden = true));
  document.documentElement.dataset.ready = performance.now().toFixed(0); // ms
})();
