"use strict";
(() => {
  const data = JSON.parse(document.getElementById("drawing").textContent);
  const canvas = document.getElementById("arm"), way = document.getElementById("way");
  const play = document.getElementById("play"), said = document.getElementById("said");
  const moving = document.getElementById("moving"), proof = document.getElementById("proof");
  let chosen = null, timer = null;
  const frame = Sticks.box(data.frames.filter(Boolean).flat());
  function draw() {
    const frames = data.frames[chosen];
    if (!frames) return;
    const pen = Sticks.fit(canvas), k = Number(way.value);
    Sticks.line(pen, frame, [[0, 0, frame.middle - frame.size], [0, 0, 0]], Sticks.ink("--line"), 6, 1);
    Sticks.line(pen, frame, frames.map((f) => f[f.length - 1]), Sticks.ink("--trace"), 2, 0.8);
    Sticks.arm(pen, frame, frames[0], Sticks.ink("--quiet"), false);
    Sticks.arm(pen, frame, frames[k], Sticks.ink("--accent"), true);
  }
  function stop() {
    clearInterval(timer);
    timer = null;
    play.textContent = "Play";
  }
  function choose(number) {
    stop();
    chosen = number;
    document.querySelectorAll("[data-stretch]").forEach((each) => {
      each.classList.toggle("chosen", Number(each.dataset.stretch) === number);
    });
    const row = data.rows[number];
    document.querySelectorAll(".arc.chosen").forEach((arc) => arc.parentNode.append(arc));
    said.textContent = `${row.lower} to ${row.upper}: ${row.word}; ${row.why}.`;
    moving.hidden = !data.frames[number];
    if (moving.hidden) return;
    proof.href = data.links[number];
    way.value = 0;
    draw();
  }
  document.querySelectorAll(".arc, .show").forEach((each) => {
    const pick = () => choose(Number(each.dataset.stretch));
    each.addEventListener("click", pick);
    each.addEventListener("keydown", (e) => {
      if (e.key === "Enter" || e.key === " ") { e.preventDefault(); pick(); }
    });
  });
  document.querySelectorAll(".show").forEach((each) => {
    each.addEventListener("click", () => {
      document.getElementById("witness").scrollIntoView({ block: "nearest" });
    });
  });
  way.addEventListener("input", () => { stop(); draw(); });
  play.addEventListener("click", () => {
    if (timer) { stop(); return; }
    play.textContent = "Pause";
    timer = setInterval(() => {
      way.value = (Number(way.value) + 1) % (Number(way.max) + 1);
      draw();
    }, 60);
  });
  Sticks.follow(canvas, draw);
  const first = data.frames.findIndex(Boolean);
  if (first >= 0) choose(first);
})();
