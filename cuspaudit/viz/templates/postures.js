"use strict";
(() => {
  const data = JSON.parse(document.getElementById("drawing").textContent);
  const frame = Sticks.box(data.postures);
  const hues = ["--accent", "--cuspidal", "--noncuspidal", "--undecided", "--target", "--no", "--trace", "--quiet"];
  document.querySelectorAll("canvas.sticks").forEach((canvas, i) => {
    const colour = () => Sticks.ink(hues[data.groups[i] % hues.length]);
    const draw = () => {
      const pen = Sticks.fit(canvas);
      Sticks.line(pen, frame, [[0, 0, frame.middle - frame.size], [0, 0, 0]], Sticks.ink("--line"), 6, 1);
      Sticks.arm(pen, frame, data.postures[i], colour(), true);
      canvas.parentElement.style.borderColor = colour();
    };
    Sticks.follow(canvas, draw);
    draw();
  });
})();
