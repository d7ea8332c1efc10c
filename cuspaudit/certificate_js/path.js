// kind "path": two postures of one value of the task, joined by a path with det J != 0.

import { Arm } from "./arm.js";
import { PI, difference, enclosed, excludesZero, interval, isPositive, isZero, magnitude,
  middle, negated, powerOfTwo, product, quotient, sum, widened } from "./interval.js";
import { coverLoosely, isLoose, secondPostures, withoutPlay } from "./play.js";
import { Refusal } from "./rational.js";

const TERMS = 5; // of a jet along the path: the last one bounds the remainder
const MOST_INTERVALS = 100000;
const LARGEST_RADIUS = powerOfTwo(-30);

/** Proves the certificate, or throws a Refusal; returns what was proved. */
export function provePath({ robot: all, limits, sign, postures: [first, second], path }) {
  const robot = withoutPlay(all), loose = isLoose(all);
  if (!same(path[0], first)) throw new Refusal("the path does not start at the first posture");
  if (!same(path.at(-1), second)) throw new Refusal("the path does not end at the second posture");
  path.forEach((point) => checkInside(limits, point.map(enclosed)));
  const box = truePosture(new Arm(robot, 1), first, second);
  const still = new Arm(robot, 1), every = new Arm(all, 1);
  const atEnd = still.determinant(box.map((x) => [x]));
  const ends = loose ? secondPostures(every, first, box, inverse) : { box, change: 0 };
  if (!hasSign([widened(atEnd[0] ?? interval(0), ends.change)], sign))
    throw new Refusal("det J at the second posture: sign not proved");
  checkInside(limits, ends.box);
  if (!differs(robot, ends.box, first)) throw new Refusal("the two postures are the same");
  const arm = new Arm(robot, TERMS);
  for (let k = 1; k < path.length; k++)
    if (loose) coverLoosely(still, every, path[k - 1], path[k], sign, k);
    else coverSegment(arm, path[k - 1], path[k], sign, k);
  const count = path.length - 1;
  return `cuspidal: two postures of one place, joined by a path of ${count} ` +
    `segment${count > 1 ? "s" : ""} with det J ${sign > 0 ? ">" : "<"} 0`;
}

/** Intervals of joint values lie strictly inside the limits. */
export function checkInside(limits, box) {
  const inside = (x, { lower, upper }) => enclosed(lower).h < x.l && x.h < enclosed(upper).l;
  if (limits && !limits.every((pair, k) => !pair || inside(box[k], pair)))
    throw new Refusal("the claim is not proved to lie inside the limits");
}

const same = (a, b) => a.every((x, k) => x.equals(b[k]));

function hasSign(jet, sign) {
  return jet.length > 0 && isPositive(sign > 0 ? jet[0] : negated(jet[0]));
}

/** A box round the second posture with exactly one posture of the first one's value. */
export function truePosture(arm, first, second) {
  const target = arm.outward(0, first.map((x) => [enclosed(x)])).tip;
  const claimed = second.map(enclosed), centre = claimed.map(middle);
  const at = linearised(arm, centre.map((x) => [interval(x)]), target);
  const Y = inverse(at.rows.map((row) => row.map(middle)));
  const newton = Y.map((row) => combined(row, at.values));
  let radius = Math.max(...newton.map(magnitude), powerOfTwo(-48)) * 2;
  for (; radius <= LARGEST_RADIUS / 2; radius *= 2) {
    const box = centre.map((x) => widened(interval(x), radius));
    const over = linearised(arm, box.map((x) => [x]), target);
    const inside = Y.every((row, i) => {
      let reach = newton[i];
      row.forEach((_, j) => {
        const entry = combined(row, over.rows.map((each) => each[j]));
        const rest = difference(interval(i === j ? 1 : 0), entry);
        reach = sum(reach, product(rest, interval(-radius, radius)));
      });
      return magnitude(reach) < radius;
    });
    const near = claimed.every((x, i) => box[i].l < x.l && x.h < box[i].h);
    if (inside && near && over.isNoHalfTurn) return box;
  }
  throw new Refusal("no true posture is proved next to the second one");
}

/** Row times column: sums of y x over numbers y and intervals x. */
const combined = (row, column) =>
  row.reduce((total, y, k) => sum(total, product(interval(y), column[k])), interval(0));

/** F and F' over the values q, and whether the rotation left over is no half turn. */
function linearised(arm, q, target) {
  const { screws, tip } = arm.outward(0, q);
  const value = (jet) => jet[0] ?? interval(0);
  const velocities = screws.map((screw) => arm.velocity(screw, tip.p).map(value));
  const values = [0, 1, 2].map((i) => difference(value(tip.p[i]), value(target.p[i])));
  const rows = [0, 1, 2].map((i) => velocities.map((v) => v[i]));
  if (screws.length === 3) return { values, rows, isNoHalfTurn: true };
  const back = arm.undo(target);
  const E = arm.then(back, tip).R.map((row) => row.map(value));
  const trace = sum(sum(E[0][0], E[1][1]), E[2][2]);
  const half = (x) => product(x, interval(0.5));
  const turning = E.map((row, i) => row.map((x, j) =>
    half(i === j ? difference(trace, x) : negated(x))));
  const rates = screws.map(({ w }) => {
    const seen = arm.turn(back.R, w).map(value);
    return turning.map((row) => row.reduce((t, x, k) => sum(t, product(x, seen[k])), interval(0)));
  });
  for (const [i, j, k] of [[0, 2, 1], [1, 0, 2], [2, 1, 0]]) {
    values.push(half(difference(E[j][k], E[k][j])));
    rows.push(rates.map((rate) => rate[i]));
  }
  return { values, rows, isNoHalfTurn: isPositive(difference(trace, interval(1))) };
}

/** An approximate inverse: nothing depends on how good it is but whether a proof is found. */
function inverse(matrix) {
  const size = matrix.length;
  const rows = matrix.map((row, i) => [...row, ...row.map((_, j) => (i === j ? 1 : 0))]);
  for (let k = 0; k < size; k++) {
    const candidates = rows.slice(k).map((row) => Math.abs(row[k]));
    const pivot = k + candidates.indexOf(Math.max(...candidates));
    if (!(Math.abs(rows[pivot]?.[k]) > 0)) throw new Refusal("J is singular at the second posture");
    [rows[k], rows[pivot]] = [rows[pivot], rows[k]];
    rows[k] = rows[k].map((x, _, row) => x / row[k]);
    rows.forEach((row, i) => {
      if (i !== k) rows[i] = row.map((x, j) => x - row[k] * rows[k][j]);
    });
  }
  return rows.map((row) => row.slice(size));
}

/** Whether some joint tells the box from the first posture, modulo 2 pi where it turns. */
function differs(robot, box, first) {
  const turn = product(PI, interval(2));
  return robot.joints.some(({ turns }, k) => {
    const step = difference(box[k], enclosed(first[k]));
    if (!turns) return excludesZero(step);
    const { l, h } = quotient(step, turn);
    return l <= h && Math.floor(h) < l; // no integer in [l, h]
  });
}

/** det J has the sign on the segment from a to b: halves of it until each is proved. */
function coverSegment(arm, a, b, sign, number) {
  const start = a.map(enclosed), step = b.map((x, k) => enclosed(x.minus(a[k])));
  const along = (s) => arm.determinant(start.map((x, k) =>
    isZero(step[k]) ? [x] : [sum(x, product(s, step[k])), step[k]]));
  const open = [[0, 1]]; // ends are dyadic numbers, exact
  for (let count = 1; open.length; count++) {
    if (count > MOST_INTERVALS) throw new Refusal(`segment ${number}: not covered`);
    const [low, high] = open.pop();
    const [centre, reach] = [(low + high) / 2, (high - low) / 2];
    if (!(low < centre && centre < high)) throw new Refusal(`segment ${number}: not covered`);
    const at = along(interval(centre));
    const opposite = at.length > 0 && (sign > 0 ? at[0].h < 0 : at[0].l > 0);
    if (opposite) throw new Refusal(`det J has the opposite sign on segment ${number} at ${centre}`);
    const over = along(interval(low, high));
    if (!hasSign([taylor(at, over, reach)], sign) && !hasSign(over, sign))
      open.push([centre, high], [low, centre]);
  }
}

/** The values f0 + f1 t + ... + r t^N for |t| <= reach, with Lagrange's remainder. */
function taylor(at, over, reach) {
  const t = interval(-reach, reach);
  let value = over[TERMS - 1] ?? interval(0);
  for (let k = TERMS - 2; k >= 0; k--) value = sum(product(value, t), at[k] ?? interval(0));
  return value;
}
