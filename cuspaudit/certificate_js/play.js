// Play: for every robot whose axes, or numbers, are off by so much. docs/certificate.md has
// the letters. All entries are jets of one term, over all play and intervals of joint values.

import { STILL } from "./arm.js";
import { difference, enclosed, interval, isPositive, magnitude, middle, powerOfTwo,
  product, quotient, rootOf, sum, widened } from "./interval.js";
import { UNIT, minus, plus } from "./jet.js";
import { Refusal } from "./rational.js";

const MOST_PIECES = 20000, MOST_BOXES = 96, TIGHT = 0.35;
const SMALL = powerOfTwo(-40), NOUGHT = interval(0);
const value = (jet) => jet[0] ?? NOUGHT;
const size = (jet) => magnitude(value(jet));
const added = (u, v) => u.map((x, i) => plus(x, v[i]));
const less = (u, v) => u.map((x, i) => plus(x, minus(v[i])));
const turnedBack = (arm, R, v) => arm.turn([0, 1, 2].map((j) => R.map((row) => row[j])), v);
const bound = (...terms) => terms.reduce((total, x) => sum(total, interval(x)), NOUGHT).h;
const times = (x, y) => product(interval(x), interval(y)).h;

function norm(v) {
  const squares = v.map((x) => interval(times(size(x), size(x))));
  return rootOf(squares.reduce(sum, NOUGHT)).h;
}

const motions = ({ joints, tool }) => [...joints.flatMap((joint) => joint.before), ...tool];
export const isLoose = (robot) => motions(robot).some((motion) => motion.play);

/** The robot in the middle: no play. */
export function withoutPlay(robot) {
  const fixed = (motions) => motions.filter((motion) => !motion.play);
  const joints = robot.joints.map((joint) => ({ ...joint, before: fixed(joint.before) }));
  return { ...robot, joints, tool: fixed(robot.tool) };
}

/** From link k both ways: screws, places of play, and frames of base, last link and tip. */
function walk(arm, k, q) {
  const count = arm.joints.length, screws = [], places = [];
  let frame = STILL;
  for (let i = k - 1; i >= 0; i--) {
    screws[i] = arm.screw(arm.joints[i], frame);
    frame = arm.then(frame, arm.moved(arm.joints[i], q[i], true));
    const steps = i ? arm.links[i] : [];
    steps.map((step, at) => ({ ...step, at })).reverse().forEach(({ play, undone, at }) => {
      const o = frame.p;
      frame = arm.then(frame, undone);
      if (play) places.push({ play, key: `${i} ${at}`, link: i, R: frame.R, o });
    });
  }
  const base = frame;
  let hand = frame = STILL;
  for (let i = k; i <= count; i++) {
    hand = i === count ? frame : hand;
    (i ? arm.links[i] : []).forEach(({ play, motion }, at) => {
      const { R } = frame;
      frame = arm.then(frame, motion);
      if (play && (i < count || count === 3))
        places.push({ play, key: `${i} ${at}`, link: i, R, o: frame.p });
    });
    if (i === count) break;
    screws[i] = arm.screw(arm.joints[i], frame);
    frame = arm.then(frame, arm.moved(arm.joints[i], q[i], false));
  }
  return { screws, places, base, hand, tip: frame };
}

const home = (arm) => (arm.joints.length === 6 ? 3 : 1);
const columnsOf = (arm, { screws, tip }) =>
  screws.map((screw) => (screws.length === 6 ? [...screw.m, ...screw.w] : arm.velocity(screw, tip.p)));

/** A_k and B_k: a twist (mu, omega) before joint k changes det J by mu . A + omega . B. */
function covectors(arm, walked) {
  const { screws, tip } = walked, columns = columnsOf(arm, walked), count = columns.length;
  const gradient = columns.map((_, j) => columns.map((_, r) => arm.det(
    columns.map((column, i) => (i === j ? column.map((_, s) => (s === r ? UNIT : [])) : column)))));
  const cross = (u, v) => arm.cross(u, v), none = [[], [], []];
  const found = [];
  for (let k = 0; k <= count; k++) {
    let [A, B] = [none, none];
    screws.forEach(({ m, w }, j) => {
      const c = gradient[j].slice(0, 3), turn = gradient[j].slice(3);
      if (count === 6 && j >= k) {
        A = added(A, cross(w, c));
        B = added(B, added(cross(m, c), cross(w, turn)));
      } else if (count === 3 && j < k) A = added(A, cross(c, w));
      else if (count === 3) B = added(B, cross(columns[j], c));
    });
    found.push({ A, B: count === 3 ? added(B, cross(tip.p, A)) : B });
  }
  return found;
}

/** The slopes of det J: by each joint value; by (v, w) of each play in its own frame. */
function slopes(arm, walked) {
  const all = covectors(arm, walked);
  const byJoint = walked.screws.map(({ m, w }, k) =>
    plus(arm.dot(m, all[k + 1].A), arm.dot(w, all[k + 1].B)));
  const byPlay = walked.places.map(({ link, R, o }) => {
    const { A, B } = all[link];
    return { v: turnedBack(arm, R, A), w: turnedBack(arm, R, added(B, arm.cross(A, o))) };
  });
  return { byJoint, byPlay };
}

/** The most that v . (vector) + w . (turn) takes on a play. */
function reach(arm, { lengths, angles, axis }, { v, w }) {
  const most = axis ? (u) => size(arm.dot(u, axis)) : norm;
  return bound(times(most(v), lengths), times(most(w), angles));
}

const changes = (arm, { places }, rates) => bound(...places.map(({ play }, i) => reach(arm, play, rates[i])));

/** det J keeps its sign on the segment from a to b, for all play. */
export function coverLoosely(still, arm, a, b, sign, number) {
  const start = a.map(enclosed), step = b.map((x, k) => enclosed(x.minus(a[k])));
  const holds = (s, half) => {
    const q = start.map((x, k) => sum(x, product(interval(s), step[k])));
    const box = q.map((x, k) => [sum(x, product(interval(-half, half), step[k]))]);
    const walked = walk(arm, home(arm), box), { byJoint, byPlay } = slopes(arm, walked);
    const along = byJoint.reduce((total, x, k) => sum(total, product(value(x), step[k])), NOUGHT);
    const lost = bound(times(magnitude(along), half), changes(arm, walked, byPlay));
    const height = product(interval(sign), value(still.determinant(q.map((x) => [x]))));
    return isPositive(difference(height, interval(lost)));
  };
  const open = [[0, 1]];
  for (let count = 1; open.length; count++) {
    const [low, high] = open.pop(), s = (low + high) / 2;
    if (holds(s, (high - low) / 2)) continue;
    if (count > MOST_PIECES || !holds(s, 0))
      throw new Refusal(`det J is not proved to keep its sign for every robot on segment ${number} at ${s}`);
    open.push([s, high], [low, s]);
  }
}

// --- matrices of jets, and the second postures

const matrix = (columns) => columns[0].map((_, i) => columns.map((column) => column[i]));
const rowTimes = (arm, row, columns) => columns.map((column) =>
  column.reduce((total, x, i) => plus(total, [product(row[i], value(x))]), []));

/** By v and by w of play in a frame: the twists, or velocities of the tip, as six columns. */
function effects(arm, { R, p }, tip) {
  const axes = [0, 1, 2].map((j) => R.map((row) => row[j]));
  const moved = tip ? less(tip, p) : p;
  const turned = (n) => (tip ? arm.cross(n, moved) : [...arm.cross(moved, n), ...n]);
  return [...axes.map((n) => (tip ? n : [...n, [], [], []])), ...axes.map(turned)];
}

/** Where the play of the first posture stands, seen from the base, or from the last link. */
function firstPosture(arm, q) {
  const out = walk(arm, 0, q), seen = new Map();
  for (const { key, R, o } of out.places) seen.set(key, { frame: { R, p: o }, by: "base" });
  if (q.length === 6)
    for (const { key, link, R, o } of walk(arm, 6, q).places)
      if (link >= 3) seen.set(key, { frame: { R, p: o }, by: "hand" });
  return { seen, tip: out.tip.p };
}

/** On a box of joint values: bounds of |q'|, and what the change of det J needs; or null. */
function onBox(arm, first, box, inverse) {
  const walked = walk(arm, home(arm), box.map((x) => [x])), columns = columnsOf(arm, walked);
  const isPose = columns.length === 6;
  const right = walked.places.map(({ key, R, o }) => {
    const { frame, by } = first.seen.get(key), here = { R, p: o };
    if (isPose) return effects(arm, arm.then(walked[by], frame)).map((c, i) => less(c, effects(arm, here)[i]));
    const there = effects(arm, frame, first.tip).map((c) => arm.turn(walked.base.R, c));
    return there.map((c, i) => less(c, effects(arm, here, walked.tip.p)[i]));
  });
  const Y = inverse(matrix(columns).map((row) => row.map((x) => middle(value(x)))));
  if (!Y) return null;
  const rows = Y.map((row) => row.map((x) => interval(x)));
  const D = rows.map((row, i) => rowTimes(arm, row, columns).map((x, j) =>
    difference(interval(i === j ? 1 : 0), value(x))));
  const split = (six) => ({ v: six.slice(0, 3), w: six.slice(3) });
  const b = rows.map((row) => bound(SMALL, ...walked.places.map(({ play }, i) =>
    reach(arm, play, split(rowTimes(arm, row, right[i]))))));
  const rest = D.map((row) => bound(...row.map((x, j) => times(magnitude(x), b[j]))));
  const k = Math.max(...rest.map((x, i) => quotient(interval(x), interval(b[i])).h));
  if (!(k < 1)) return null;
  const room = difference(interval(1), interval(k));
  const rates = b.map((x, i) => bound(x, quotient(interval(rest[i]), room).h));
  const change = () => {
    const { byJoint, byPlay } = slopes(arm, walked), f = byJoint.map(value);
    const weight = bound(...f.map((x, j) => times(magnitude(x), b[j])));
    const far = quotient(interval(times(weight, k)), room).h;
    let z = f.map((x, j) => widened(x, quotient(interval(far), interval(b[j])).h));
    for (let n = 0; n < 3; n++)
      z = f.map((x, j) => z.reduce((total, y, i) => sum(total, product(y, D[i][j])), x));
    const byRate = z.map((_, j) => z.reduce((total, y, i) => sum(total, product(y, rows[i][j])), NOUGHT));
    const both = byPlay.map(({ v, w }, i) => {
      const moved = split(rowTimes(arm, byRate, right[i]));
      return { v: added(v, moved.v), w: added(w, moved.w) };
    });
    return Math.max(changes(arm, walked, both), changes(arm, walked, byPlay));
  };
  return { k, rates, change };
}

/** The bounds over a box, cut until each piece is tight; or null. */
function overBox(arm, first, whole, inverse) {
  const look = (box) => ({ box, found: onBox(arm, first, box, inverse) });
  const loose = ({ found }) => (found ? found.k : 1);
  const pieces = [look(whole)];
  while (pieces.length < MOST_BOXES) {
    pieces.sort((a, b) => loose(a) - loose(b));
    if (loose(pieces.at(-1)) < TIGHT) break;
    const { box, found } = pieces.pop();
    if (!found && !look(box.map((x) => interval(middle(x)))).found) return null;
    const inner = box.map((x, j) => (j === 0 || j === 5 ? 0 : x.h - x.l));
    const j = inner.indexOf(Math.max(...inner)), m = middle(box[j]);
    for (const half of [interval(box[j].l, m), interval(m, box[j].h)])
      pieces.push(look(box.map((x, i) => (i === j ? half : x))));
  }
  if (!pieces.every(({ found }) => found)) return null;
  const rates = whole.map((_, i) => Math.max(...pieces.map(({ found }) => found.rates[i])));
  return { rates, change: () => Math.max(...pieces.map(({ found }) => found.change())) };
}

/** A box with the second posture of every robot, and how much det J changes on the way. */
export function secondPostures(arm, firstValues, box, inverse) {
  const first = firstPosture(arm, firstValues.map((x) => [enclosed(x)]));
  const at = onBox(arm, first, box.map((x) => interval(middle(x))), inverse);
  let radii = at?.rates.map((x) => times(x, 1.125));
  for (let tries = 0; tries < 6 && radii?.every((r) => r < 1); tries++) {
    const wide = box.map((x, i) => widened(x, radii[i]));
    const found = overBox(arm, first, wide, inverse);
    if (!found) break;
    if (found.rates.every((x, i) => x < radii[i])) return { box: wide, change: found.change() };
    radii = radii.map((r, i) => Math.max(r, times(found.rates[i], 1.125)));
  }
  throw new Refusal("a second posture is not proved for every robot");
}
