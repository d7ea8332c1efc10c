"use strict";
(() => {
  const frames = JSON.parse(document.getElementById("frames").textContent);
  const svg = document.getElementById("mechanism");
  if (!svg || !frames.length) return;
  const every = frames.flatMap((f) => [...f.legs.flat(), ...f.platform]);
  const xs = every.map((p) => p[0]), ys = every.map((p) => -p[1]);
  const left = Math.min(...xs), top = Math.min(...ys);
  const width = Math.max(...xs) - left || 1, height = Math.max(...ys) - top || 1;
  const unit = Math.max(width, height) / 100, margin = 6 * unit;
  svg.setAttribute("viewBox", [left - margin, top - margin, width + 2 * margin,
    height + 2 * margin].join(" "));
  const mark = (name, attributes) => {
    const made = document.createElementNS("http://www.w3.org/2000/svg", name);
    for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
    return made;
  };
  const text = (points) => points.map((p) => `${p[0]},${-p[1]}`).join(" ");
  const drawn = (frame, name) => {
    const group = mark("g", { class: name, fill: "none" });
    group.append(mark("polygon", { points: text(frame.platform), "stroke-width": unit }));
    for (const leg of frame.legs) {
      group.append(mark("polyline", { points: text(leg), "stroke-width": unit }));
      for (const p of leg) group.append(mark("circle", { cx: p[0], cy: -p[1], r: unit }));
    }
    return group;
  };
  const way = document.getElementById("way"), play = document.getElementById("play");
  const show = () => svg.replaceChildren(drawn(frames[0], "first"),
    drawn(frames[Number(way.value)], "now"));
  let timer = 0;
  const stop = () => { clearInterval(timer); timer = 0; play.textContent = "Play"; };
  play.addEventListener("click", () => {
    if (timer) return stop();
    if (Number(way.value) === frames.length - 1) way.value = 0;
    play.textContent = "Stop";
    timer = setInterval(() => {
      way.value = Number(way.value) + 1;
      show();
      if (Number(way.value) === frames.length - 1) stop();
    }, 60);
  });
  way.addEventListener("input", () => { if (timer) stop(); show(); });
  show();
})();
