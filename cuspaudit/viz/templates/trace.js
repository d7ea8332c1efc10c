"use strict";
(() => {
  const data = JSON.parse(document.getElementById("drawing").textContent);
  const signs = JSON.parse(document.getElementById("signs").textContent);
  const canvas = document.getElementById("arm");
  const slider = document.getElementById("along"), play = document.getElementById("play");
  const choice = document.getElementById("run"), says = document.getElementById("says");
  if (!data.runs.length) return;
  const frame = Sticks.box(data.runs.flatMap((run) => run.points).concat([data.path]));
  let chosen = Number(choice.value), moving = false, last = 0;
  const at = () => (Number(slider.value) / 1000) * data.legs;
  function points(run, s) {
    const end = run.s.length - 1;
    if (s >= run.s[end]) return s > run.s[end] + 1e-9 ? null : run.points[end];
    let k = 0;
    while (run.s[k + 1] < s) k++;
    const t = (s - run.s[k]) / ((run.s[k + 1] - run.s[k]) || 1);
    return run.points[k].map((p, i) => p.map((x, j) => x + t * (run.points[k + 1][i][j] - x)));
  }
  const colour = (i) => Sticks.ink(signs[i] > 0 ? "--accent" : signs[i] < 0 ? "--cuspidal" : "--quiet");
  function draw() {
    const pen = Sticks.fit(canvas), s = at();
    Sticks.line(pen, frame, data.path, Sticks.ink("--trace"), 2, 0.9);
    Sticks.line(pen, frame, [[0, 0, frame.middle - frame.size], [0, 0, 0]], Sticks.ink("--line"), 8, 1);
    data.runs.forEach((run, i) => {
      const own = i === chosen ? null : points(run, s);
      if (own) Sticks.arm(pen, frame, own, colour(i), false);
    });
    const run = data.runs[chosen], own = points(run, s);
    Sticks.arm(pen, frame, own || run.points[run.points.length - 1], colour(chosen), Boolean(own));
    says.textContent = "at " + s.toFixed(3) + (own ? "" : ": the run has ended");
    for (const mark of document.querySelectorAll(".now")) {
      mark.setAttribute("x1", slider.value);
      mark.setAttribute("x2", slider.value);
    }
  }
  function choose(i) {
    chosen = i;
    choice.value = String(i);
    for (const g of document.querySelectorAll("[data-run]")) {
      g.classList.toggle("chosen", Number(g.dataset.run) === i);
    }
    draw();
  }
  function step(now) {
    if (!moving) return;
    const next = Number(slider.value) + (now - last) / 8;
    last = now;
    slider.value = String(next > 1000 ? 0 : next);
    draw();
    requestAnimationFrame(step);
  }
  play.addEventListener("click", () => {
    moving = !moving;
    play.textContent = moving ? "Pause" : "Play";
    play.setAttribute("aria-pressed", String(moving));
    last = performance.now();
    requestAnimationFrame(step);
  });
  slider.addEventListener("input", draw);
  choice.addEventListener("change", () => choose(Number(choice.value)));
  Sticks.follow(canvas, draw);
  choose(chosen);
})();
