"use strict";
(() => {
  const read = (id) => JSON.parse(document.getElementById(id).textContent);
  const get = (id) => document.getElementById(id);
  const data = read("drawing");
  const heights = read("heights");
  const last = data.postures.length - 1;
  const pane = get("pane");
  const others = get("others"); // null when there are none, or a path
  let place = 0; // along the postures, 0 to last
  let scene = null; // null without WebGL: the numbers still follow the slider

  // ---- numbers

  const minus = (text) => text.replace("-", "\u2212");
  const value = (joint, x) =>
    joint.kind === "revolute"
      ? minus(((x * 180) / Math.PI).toFixed(1)) + "\u00b0"
      : minus(Number(x.toPrecision(5)).toString()) + " " + data.unit;
  const length = (x) => tidy(x) + " " + data.unit;

  function tidy(x) {
    const [mantissa, power] = x.toExponential(2).split("e").map(Number);
    if (Math.abs(power) < 5) return minus(Number(x.toPrecision(3)).toString());
    const raised = [...String(power)].map((c) => "\u207b\u2070\u00b9\u00b2\u00b3\u2074\u2075\u2076\u2077\u2078\u2079"["-0123456789".indexOf(c)]);
    return minus(String(mantissa)) + "\u00b710" + raised.join("");
  }

  function between(values) {
    const low = Math.min(Math.floor(place), last);
    const high = Math.min(low + 1, last);
    const part = place - low;
    const mix = (a, b) => a + (b - a) * part;
    return Array.isArray(values[low])
      ? values[low].map((x, i) => mix(x, values[high][i]))
      : mix(values[low], values[high]);
  }

  function share() {
    if (data.isPath) return last ? place / last : 0;
    return last ? 0.05 + (0.9 * place) / last : 0.5;
  }

  function showNumbers() {
    const posture = between(data.postures);
    const rows = get("joints").rows;
    data.joints.forEach((joint, i) => {
      rows[i].querySelector(".nowvalue").textContent = value(joint, posture[i]);
    });
    const det = between(data.determinants);
    get("detnow").textContent = tidy(det);
    const left = 100 * share() + "%";
    get("cursor").style.left = left;
    get("dot").style.left = left;
    get("dot").style.top = between(heights) + "%";
    get("status").replaceChildren(...status());
  }

  function status() {
    const strong = (text) => {
      const b = document.createElement("b");
      b.textContent = text;
      return b;
    };
    if (!data.isPath) {
      const ghost = data.ghosts[Math.round(place)];
      return [`Posture ${ghost.label} of ${last + 1}, ${ghost.group}`];
    }
    const end = place < 1e-6 ? "A" : place > last - 1e-6 ? "B" : "";
    const far = between(data.distances);
    const turn = (between(data.turns) * 180) / Math.PI;
    const turned = data.task === "pose" ? `, turned ${turn.toFixed(0)}\u00b0` : "";
    if (!end) return [`On the way: tool ${length(far)} from its place${turned}`];
    const here = far * data.scale < 1e-5 && (data.task !== "pose" || turn < 1e-3);
    return [`Posture ${end}: `, here ? strong("tool at the marked place") : `tool ${length(far)} from its place`];
  }

  // ---- the arm

  class Scene {
    constructor() {
      this.THREE = MeshCat.THREE;
      this.viewer = new MeshCat.Viewer(pane);
      const viewer = this.viewer;
      viewer.set_3d_pane_size = () => this.resize();
      viewer.set_property(["Background"], "visible", false);
      for (const blob of read("commands")) {
        const bytes = Uint8Array.from(atob(blob), (c) => c.charCodeAt(0));
        viewer.handle_command_bytearray(bytes);
      }
      this.arm = viewer.scene_tree.find(["meshcat", "arm"]).object;
      this.befores = data.joints.map((j) => new this.THREE.Matrix4().fromArray(j.before));
      this.axes = data.joints.map((j) => new this.THREE.Vector3(...j.axis));
      this.nodes = this.nodesOf(this.arm);
      this.ghosts = data.ghosts.map((g, i) => this.ghost(g, i));
      this.lights();
      this.labels = this.makeLabels();
      const draw = viewer.render.bind(viewer);
      viewer.render = () => {
        draw();
        this.placeLabels();
      };
      viewer.controls.enableZoom = false; // the wheel scrolls the page until a click
      pane.addEventListener("pointerdown", () => (viewer.controls.enableZoom = true));
      pane.addEventListener("pointerleave", () => (viewer.controls.enableZoom = false));
      viewer.controls.addEventListener("start", () => (this.touched = true));
      new ResizeObserver(() => this.resize()).observe(pane);
      this.resize();
    }

    nodesOf(root) {
      const nodes = [];
      let node = root;
      for (let i = 0; i < data.joints.length; i++) {
        const found = node.children.find((c) => c.name === "j" + i);
        if (!found) break;
        nodes.push((node = found));
      }
      return nodes;
    }

    pose(nodes, posture) {
      const turn = new this.THREE.Matrix4();
      nodes.forEach((node, i) => {
        const axis = this.axes[i];
        if (data.joints[i].kind === "revolute") {
          turn.makeRotationAxis(axis, posture[i]);
        } else {
          const step = posture[i] * data.scale;
          turn.makeTranslation(axis.x * step, axis.y * step, axis.z * step);
        }
        const placed = this.befores[i].clone().multiply(turn);
        placed.decompose(node.position, node.quaternion, node.scale);
      });
    }

    // A copy of the arm, drawn twice: first its depth alone, so that the pieces inside
    // it do not show through, then its colour, set back a little from the arm itself.
    ghost(ghost, order) {
      const { THREE } = this;
      const group = new THREE.Group();
      const common = { transparent: true, side: THREE.FrontSide, polygonOffset: true };
      const back = { polygonOffsetFactor: 2, polygonOffsetUnits: 4 };
      const depth = new THREE.MeshBasicMaterial({ ...common, ...back, colorWrite: false });
      const tint = new THREE.MeshLambertMaterial({
        ...common, ...back, color: ghost.colour, opacity: data.isPath ? 0.5 : 0.42,
        depthWrite: false,
      });
      group.tint = tint;
      [depth, tint].forEach((material, pass) => {
        const copy = this.arm.clone(true);
        copy.traverse((node) => {
          if (!node.isMesh) return;
          node.material = material;
          node.renderOrder = 1 + 2 * order + pass;
          node.castShadow = false;
        });
        this.pose(this.nodesOf(copy), data.postures[ghost.index]);
        group.add(copy);
      });
      group.name = "ghost " + ghost.label;
      this.viewer.scene_tree.find(["meshcat"]).object.add(group);
      return group;
    }

    lights() {
      const { viewer } = this;
      const lights = (name) => viewer.scene_tree.find(["Lights", name, "<object>"]).object;
      lights("AmbientLight").intensity = 0.62;
      lights("FillLight").intensity = 0.25;
      lights("PointLightNegativeX").intensity = 0.5;
      lights("PointLightPositiveX").intensity = 0.3;
    }

    show(posture) {
      this.pose(this.nodes, posture);
      this.ghosts.forEach((group, i) => {
        const apart = Math.abs(place - data.ghosts[i].index) > 0.02;
        group.visible = apart && (!others || others.checked);
      });
      this.viewer.set_dirty();
    }

    // The arm in one posture, in the colour of its ghost, on a canvas of its own.
    portrait(wanted) {
      const { viewer, ghosts, arm } = this;
      const seen = ghosts.map((group) => group.visible);
      const { tint } = ghosts[wanted], { opacity } = tint;
      arm.visible = false;
      ghosts.forEach((group, i) => (group.visible = i === wanted));
      tint.opacity = 0.95;
      viewer.renderer.render(viewer.scene, viewer.camera);
      const picture = document.createElement("canvas");
      picture.width = 360;
      picture.height = Math.round((360 * pane.clientHeight) / pane.clientWidth);
      const { width, height } = picture;
      picture.getContext("2d").drawImage(viewer.renderer.domElement, 0, 0, width, height);
      arm.visible = true;
      ghosts.forEach((group, i) => (group.visible = seen[i]));
      tint.opacity = opacity;
      return picture.toDataURL();
    }

    // ---- camera: meshcat's camera lives where y is up

    up(point) {
      return new this.THREE.Vector3(point[0], point[2], -point[1]);
    }

    resize() {
      const w = pane.clientWidth, h = pane.clientHeight;
      if (!w || !h) return;
      this.viewer.camera.aspect = w / h;
      this.viewer.renderer.setSize(w, h);
      if (!this.touched) this.frame();
      this.viewer.set_dirty();
    }

    // Without a graphics card, draw fewer points while the arm moves.
    keepPace(elapsed) {
      this.slow = elapsed > 70 ? this.slow + 1 : 0;
      if (this.slow < 6 || this.coarse) return;
      this.coarse = true;
      this.viewer.renderer.setPixelRatio(0.6);
    }

    sharpen() {
      this.slow = 0;
      if (!this.coarse) return;
      this.coarse = false;
      this.viewer.renderer.setPixelRatio(window.devicePixelRatio);
      this.viewer.set_dirty();
    }

    // Stand as near as all points allow, looking along the chosen direction.
    frame() {
      const { THREE, viewer } = this;
      const camera = viewer.camera;
      camera.fov = 24;
      camera.updateProjectionMatrix();
      const toward = this.up(data.view).normalize();
      const right = new THREE.Vector3(0, 1, 0).cross(toward).normalize();
      const above = toward.clone().cross(right);
      const tanV = Math.tan((camera.fov * Math.PI) / 360) / 1.06;
      const tanH = tanV * camera.aspect;
      const PAD = 0.05; // the points are on the links' middle lines
      const points = data.fit.map((p) => this.up(p));
      const centre = new THREE.Vector3();
      let distance = 1;
      for (let round = 0; round < 12; round++) {
        let l = Infinity, r = -Infinity, b = Infinity, t = -Infinity;
        distance = 0.05;
        for (const p of points) {
          const q = p.clone().sub(centre);
          const x = q.dot(right), y = q.dot(above), z = q.dot(toward);
          distance = Math.max(
            distance, z + (Math.abs(x) + PAD) / tanH, z + (Math.abs(y) + PAD) / tanV);
        }
        for (const p of points) {
          const q = p.clone().sub(centre);
          const depth = distance - q.dot(toward);
          l = Math.min(l, q.dot(right) / depth); r = Math.max(r, q.dot(right) / depth);
          b = Math.min(b, q.dot(above) / depth); t = Math.max(t, q.dot(above) / depth);
        }
        centre.addScaledVector(right, ((l + r) / 2) * distance);
        centre.addScaledVector(above, ((b + t) / 2) * distance);
      }
      camera.position.copy(centre).addScaledVector(toward, distance);
      viewer.controls.target.copy(centre);
      viewer.controls.update();
    }

    // ---- labels over the picture

    makeLabels() {
      const holder = get("labels");
      const made = [];
      const add = (text, kind, where, colour) => {
        const span = document.createElement("span");
        span.className = kind;
        span.textContent = text;
        if (colour) span.style.borderColor = colour;
        holder.append(span);
        made.push({ span, where, kind });
      };
      data.ghosts.forEach((g, i) =>
        add(data.isPath ? "posture " + g.label : g.label, "ghost",
          () => this.ghosts[i].visible && this.up(g.at), g.colour));
      if (data.target) add(data.isPath ? "tool: same place in A and B" : "tool", "tool", () => this.up(data.target));
      const joints = get("names");
      joints.checked = data.joints.length <= 3;
      joints.addEventListener("change", () => this.viewer.set_dirty());
      this.nodes.forEach((node, i) =>
        add(String(i + 1), "joint",
          () => joints.checked && node.getWorldPosition(new this.THREE.Vector3())));
      return made;
    }

    placeLabels() {
      const w = pane.clientWidth, h = pane.clientHeight;
      for (const { span, where, kind } of this.labels) {
        const point = where();
        span.hidden = !point;
        if (!point) continue;
        point.project(this.viewer.camera);
        const half = span.offsetWidth / 2 + 4;
        const x = Math.min(w - half, Math.max(half, ((point.x + 1) / 2) * w));
        const lift = kind === "tool" ? 34 : kind === "ghost" ? -22 : 0;
        const y = Math.min(h - 14, Math.max(14, ((1 - point.y) / 2) * h + lift));
        span.style.left = x + "px";
        span.style.top = y + "px";
      }
    }
  }

  // ---- the postures side by side

  const gallery = get("gallery");
  const tiles = gallery ? [...gallery.querySelectorAll("button")] : [];

  // One portrait a frame, so that the page can be used meanwhile.
  function hangPortrait(i) {
    if (i < tiles.length) {
      tiles[i].querySelector("img").src = scene.portrait(i);
      tiles[i].addEventListener("click", () => go(data.ghosts[i].index));
      return void requestAnimationFrame(() => hangPortrait(i + 1));
    }
    scene.viewer.set_dirty();
    gallery.dataset.ready = "yes";
  }

  function markTile() {
    tiles.forEach((tile, i) => {
      if (data.ghosts[i].index === Math.round(place)) tile.setAttribute("aria-current", "true");
      else tile.removeAttribute("aria-current");
    });
  }

  // ---- one clock for arm, slider, strip and table

  const slider = get("slider");
  const scaleOf = data.isPath ? Number(slider.max) / Math.max(1, last) : 1;

  function go(to, fromSlider) {
    place = Math.min(last, Math.max(0, to));
    if (!fromSlider) slider.value = String(Math.round(place * scaleOf));
    if (scene) scene.show(between(data.postures));
    showNumbers();
    markTile();
  }

  const play = get("play");
  const HOLD = 1.1, PASS = 7; // seconds at each end, and from end to end
  let playing = false, direction = 1, held = 0, before = 0;

  function setPlaying(on) {
    playing = on;
    if (scene) scene.sharpen();
    play.textContent = on ? "Pause" : "Play";
    play.setAttribute("aria-pressed", String(on));
    if (!on) return;
    before = performance.now();
    held = 0;
    if (place >= last) {
      if (get("loop").checked) direction = -1;
      else go(0);
    }
    if (place <= 0) direction = 1;
    requestAnimationFrame(step);
  }

  function step(now) {
    if (!playing) return;
    if (scene) scene.keepPace(now - before);
    const dt = Math.min(0.1, (now - before) / 1000) * Number(get("speed").value);
    before = now;
    if (held > 0) held -= dt;
    else {
      go(place + (direction * dt * last) / PASS);
      const ended = direction > 0 ? place >= last : place <= 0;
      if (ended && !get("loop").checked) return setPlaying(false);
      if (ended) {
        direction = -direction;
        held = HOLD;
      }
    }
    requestAnimationFrame(step);
  }

  slider.addEventListener("input", () => {
    if (playing) setPlaying(false);
    go(Number(slider.value) / scaleOf, true);
  });
  if (play) play.addEventListener("click", () => setPlaying(!playing));

  // ---- paper: the picture as it stands

  addEventListener("beforeprint", () => {
    if (!scene) return;
    get("still").src = scene.viewer.capture_image();
    pane.parentElement.classList.add("stilled");
  });
  addEventListener("afterprint", () => pane.parentElement.classList.remove("stilled"));

  if (data.isPath) {
    [data.postures[0], data.postures[last]].forEach((posture, end) => {
      data.joints.forEach((joint, i) => {
        get("joints").rows[i].cells[end ? 3 : 1].textContent = value(joint, posture[i]);
      });
    });
  }
  try {
    scene = new Scene();
    get("reset").addEventListener("click", () => {
      scene.touched = false;
      scene.resize();
    });
  } catch (error) {
    get("failure").hidden = false;
    pane.parentElement.classList.add("failed");
    console.warn("no picture:", error);
  }
  if (others) others.addEventListener("change", () => go(place));
  if (scene && gallery) {
    gallery.hidden = false;
    requestAnimationFrame(() => hangPortrait(0));
  }
  go(0);
  const still = matchMedia("(prefers-reduced-motion: reduce)").matches;
  if (play && scene && !still) setPlaying(true);
  document.documentElement.dataset.ready = performance.now().toFixed(0); // ms
})();
