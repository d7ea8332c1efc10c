"use strict";
// Arms as sticks on a canvas: turned by dragging, no library, nothing fetched.
const Sticks = (() => {
  const view = { yaw: 0.7, pitch: 0.45 };
  const drawn = [];
  function ink(name) {
    return getComputedStyle(document.body).getPropertyValue(name).trim();
  }
  function turned(p) {
    const c = Math.cos(view.yaw), s = Math.sin(view.yaw);
    const x = c * p[0] + s * p[1], y = -s * p[0] + c * p[1];
    const a = Math.cos(view.pitch), b = Math.sin(view.pitch);
    return [y, a * p[2] - b * x, a * x + b * p[2]];
  }
  function box(clouds) {
    let size = 0, low = Infinity, high = -Infinity;
    for (const points of clouds) for (const p of points) {
      size = Math.max(size, Math.hypot(p[0], p[1]));
      low = Math.min(low, p[2]);
      high = Math.max(high, p[2]);
    }
    if (!isFinite(low)) { low = 0; high = 1; }
    return { middle: (low + high) / 2, size: Math.max(size, (high - low) / 2, 1e-9) };
  }
  function fit(canvas) {
    const ratio = window.devicePixelRatio || 1;
    const w = canvas.clientWidth, h = canvas.clientHeight;
    canvas.width = Math.round(w * ratio);
    canvas.height = Math.round(h * ratio);
    const context = canvas.getContext("2d");
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, w, h);
    return { context, w, h };
  }
  function line(pen, frame, points, colour, width, alpha) {
    const k = 0.42 * Math.min(pen.w, pen.h) / frame.size;
    const flat = points.map((p) => {
      const q = turned([p[0], p[1], p[2] - frame.middle]);
      return [pen.w / 2 + k * q[0], pen.h / 2 - k * q[1]];
    });
    const c = pen.context;
    c.globalAlpha = alpha; c.strokeStyle = colour; c.fillStyle = colour;
    c.lineWidth = width; c.lineJoin = "round"; c.lineCap = "round";
    c.beginPath();
    flat.forEach((p, i) => (i ? c.lineTo(p[0], p[1]) : c.moveTo(p[0], p[1])));
    c.stroke();
    return flat;
  }
  function arm(pen, frame, points, colour, bold) {
    const flat = line(pen, frame, points, colour, bold ? 6 : 2, bold ? 1 : 0.3);
    const c = pen.context;
    for (const p of bold ? flat : flat.slice(-1)) {
      c.beginPath(); c.arc(p[0], p[1], bold ? 5 : 3, 0, 7); c.fill();
    }
    c.globalAlpha = 1;
  }
  function follow(canvas, redraw) {
    drawn.push(redraw);
    let from = null;
    canvas.addEventListener("pointerdown", (e) => {
      from = [e.clientX, e.clientY, view.yaw, view.pitch];
      canvas.setPointerCapture(e.pointerId);
    });
    canvas.addEventListener("pointermove", (e) => {
      if (!from) return;
      view.yaw = from[2] - (e.clientX - from[0]) / 120;
      view.pitch = Math.max(-1.5, Math.min(1.5, from[3] + (e.clientY - from[1]) / 120));
      all();
    });
    for (const end of ["pointerup", "pointercancel"]) {
      canvas.addEventListener(end, () => { from = null; });
    }
  }
  function all() { drawn.forEach((redraw) => redraw()); }
  window.addEventListener("resize", all);
  window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", all);
  return { arm, box, fit, follow, ink, line, all };
})();
