// Play: for every robot whose axes, or numbers, are off by so much. docs/certificate.md has
// the letters. All entries are jets of one term, over all play and intervals of joint values.

import { less, sumOf } from "./arm.js";
import { defect, halves, inverse, transposed } from "./boxes.js";
import { around, difference, enclosed, inner, interval, isPositive, magnitude, middle,
  powerOfTwo, product, quotient, rootOf, scaled, square, sum, total, widened } from "./interval.js";
import { UNIT, plus, value } from "./jet.js";
import { demand } from "./rational.js";

const MOST_BOXES = 96, TIGHT = 0.35, SMALL = powerOfTwo(-40);
const size = (jet) => magnitude(value(jet));
const norm = (v) => rootOf(total(v.map((x) => square(value(x))))).h;

// upper bounds of sums, products and quotients of numbers that are not negative
const bound = (...terms) => total(terms.map((x) => interval(x))).h;
const times = (x, y) => scaled(x, interval(y)).h;
const over = (x, below) => quotient(interval(x), below).h;
const weighted = (row, b) => bound(...row.map((x, j) => times(magnitude(x), b[j])));

const motions = ({ joints, tool }) => [...joints.flatMap((joint) => joint.before), ...tool];
export const isLoose = (robot) => motions(robot).some((motion) => motion.play);

/** The robot in the middle: no play. */
export function withoutPlay(robot) {
  const fixed = (motions) => motions.filter((motion) => !motion.play);
  const joints = robot.joints.map((joint) => ({ ...joint, before: fixed(joint.before) }));
  return { ...robot, joints, tool: fixed(robot.tool) };
}

/** A_k and B_k: a twist (mu, omega) before joint k changes det J by mu . A + omega . B. */
function covectors(arm, { screws, tip }, columns) {
  const count = columns.length, cross = (u, v) => arm.cross(u, v);
  const unit = (r) => columns.map((_, s) => (s === r ? UNIT : []));
  const gradient = columns.map((_, j) => columns.map((_, r) =>
    arm.det(columns.map((column, i) => (i === j ? unit(r) : column)))));
  return Array.from({ length: count + 1 }, (_, k) => {
    let [A, B] = [[[], [], []], [[], [], []]];
    screws.forEach(({ m, w }, j) => {
      const c = gradient[j].slice(0, 3), turn = gradient[j].slice(3);
      if (count === 6 && j >= k) {
        A = sumOf(A, cross(w, c));
        B = sumOf(B, sumOf(cross(m, c), cross(w, turn)));
      } else if (count === 3 && j < k) A = sumOf(A, cross(c, w));
      else if (count === 3) B = sumOf(B, cross(columns[j], c));
    });
    return { A, B: count === 3 ? sumOf(B, cross(tip.p, A)) : B };
  });
}

/** The slopes of det J: by each joint value; by (v, w) of each play in its own frame. */
function slopes(arm, walked, columns) {
  const all = covectors(arm, walked, columns);
  const byJoint = walked.screws.map(({ m, w }, k) =>
    value(plus(arm.dot(m, all[k + 1].A), arm.dot(w, all[k + 1].B))));
  const byPlay = walked.places.map(({ link, R, o }) => {
    const { A, B } = all[link], back = transposed(R);
    return { v: arm.turn(back, A), w: arm.turn(back, sumOf(B, arm.cross(A, o))) };
  });
  return { byJoint, byPlay };
}

/** The most that v . (vector) + w . (turn) takes on a play. */
function reach(arm, { lengths, angles, axis }, { v, w }) {
  const most = axis ? (u) => size(arm.dot(u, axis)) : norm;
  return bound(times(most(v), lengths), times(most(w), angles));
}

const changes = (arm, { places }, rates) => bound(...places.map(({ play }, i) => reach(arm, play, rates[i])));

/** Whether det J has the sign on a part of the segment from `start`, for all play. */
export function keepsSign(still, arm, { start, step, sign, name }) {
  const holds = (s, half) => {
    const q = start.map((x, k) => sum(x, scaled(s, step[k])));
    const box = q.map((x, k) => [sum(x, product(around(half), step[k]))]);
    const walked = arm.fromHome(box), { byJoint, byPlay } = slopes(arm, walked, arm.columns(box, walked));
    const lost = bound(times(magnitude(inner(byJoint, step)), half), changes(arm, walked, byPlay));
    const height = scaled(sign, value(still.determinant(q.map((x) => [x]))));
    return isPositive(difference(height, interval(lost)));
  };
  return ([part]) => {
    const s = middle(part), found = holds(s, (part.h - part.l) / 2);
    demand(found || holds(s, 0), `det J is not proved to keep its sign for every robot on ${name} at ${s}`);
    return found;
  };
}

// --- the second postures

/** By v and by w of play in a frame: the twists, or velocities of the tip, as six columns. */
function effects(arm, { R, p }, tip) {
  const axes = transposed(R), moved = tip ? less(tip, p) : p;
  const turned = (n) => (tip ? arm.cross(n, moved) : [...arm.cross(moved, n), ...n]);
  return [...axes.map((n) => (tip ? n : [...n, [], [], []])), ...axes.map(turned)];
}

/** Where the play of the first posture stands, seen from the base, or from the last link. */
function firstPosture(arm, q) {
  const out = arm.walk(0, q), seen = new Map();
  for (const { key, R, o } of out.places) seen.set(key, { frame: { R, p: o }, by: "base" });
  if (q.length === 6)
    for (const { key, link, R, o } of arm.walk(6, q).places)
      if (link >= 3) seen.set(key, { frame: { R, p: o }, by: "hand" });
  return { seen, tip: out.tip.p };
}

/** How play moves the first posture, less how it moves this one: six columns for each place. */
function rightHandSide(arm, first, { places, base, hand, tip }) {
  return places.map(({ key, R, o }) => {
    const { frame, by } = first.seen.get(key), position = arm.joints.length === 3;
    const there = position ? effects(arm, frame, first.tip).map((c) => arm.turn(base.R, c))
      : effects(arm, arm.then(by === "base" ? base : hand, frame));
    const here = effects(arm, { R, p: o }, position ? tip.p : null);
    return transposed(there.map((column, i) => less(column, here[i]).map(value)));
  });
}

const twist = (six) => ({ v: six.slice(0, 3).map((x) => [x]), w: six.slice(3).map((x) => [x]) });
const rowTimes = (row, matrix) => transposed(matrix).map((column) => inner(row, column));

/** On a box of joint values: bounds of |q'|, and of the change of det J; or null. */
function onBox(arm, first, box) {
  const q = box.map((x) => [x]), walked = arm.fromHome(q), columns = arm.columns(q, walked);
  const right = rightHandSide(arm, first, walked), J = transposed(columns).map((row) => row.map(value));
  const Y = inverse(J);
  if (!Y) return null;
  const D = defect(Y, J), b = Y.map((row) => bound(SMALL, changes(arm, walked,
    right.map((matrix) => twist(rowTimes(row, matrix))))));
  const rest = D.map((row) => weighted(row, b));
  const k = Math.max(...rest.map((x, i) => over(x, interval(b[i]))));
  if (!(k < 1)) return null;
  const room = difference(interval(1), interval(k));
  const change = () => {
    const { byJoint: f, byPlay } = slopes(arm, walked, columns);
    const far = over(times(weighted(f, b), k), room);
    let z = f.map((x, j) => widened(x, over(far, interval(b[j]))));
    for (let n = 0; n < 3; n++) z = rowTimes(z, D).map((x, j) => sum(f[j], x));
    const byRate = rowTimes(z, Y);
    const both = byPlay.map(({ v, w }, i) => {
      const moved = twist(rowTimes(byRate, right[i]));
      return { v: sumOf(v, moved.v), w: sumOf(w, moved.w) };
    });
    return Math.max(changes(arm, walked, both), changes(arm, walked, byPlay));
  };
  return { k, rates: b.map((x, i) => bound(x, over(rest[i], room))), change };
}

/** The bounds over a box, cut until each piece is tight; or null. */
function overBox(arm, first, whole) {
  const look = (box) => ({ box, found: onBox(arm, first, box) });
  const loose = ({ found }) => (found ? found.k : 1);
  const pieces = [look(whole)];
  while (pieces.length < MOST_BOXES) {
    pieces.sort((a, b) => loose(a) - loose(b));
    if (loose(pieces.at(-1)) < TIGHT) break;
    const { box, found } = pieces.pop();
    if (!found && !onBox(arm, first, box.map((x) => interval(middle(x))))) return null;
    pieces.push(...halves(box, (j) => j !== 0 && j !== 5).map(look));
  }
  if (!pieces.every(({ found }) => found)) return null;
  const rates = whole.map((_, i) => Math.max(...pieces.map(({ found }) => found.rates[i])));
  return { rates, change: () => Math.max(...pieces.map(({ found }) => found.change())) };
}

/** A box with the second posture of every robot, and how much det J changes on the way. */
export function secondPostures(arm, firstValues, box) {
  const first = firstPosture(arm, firstValues.map((x) => [enclosed(x)]));
  const at = onBox(arm, first, box.map((x) => interval(middle(x))));
  let radii = at?.rates.map((x) => times(x, 1.125));
  for (let tries = 0; tries < 6 && radii?.every((r) => r < 1); tries++) {
    const wide = box.map((x, i) => widened(x, radii[i]));
    const found = overBox(arm, first, wide);
    if (!found) break;
    if (found.rates.every((x, i) => x < radii[i])) return { box: wide, change: found.change() };
    radii = radii.map((r, i) => Math.max(r, times(found.rates[i], 1.125)));
  }
  return demand(false, "a second posture is not proved for every robot");
}
