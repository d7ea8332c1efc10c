// kind "path": two postures of one value of the task, joined by a path with det J != 0.

import { Arm, less } from "./arm.js";
import { boxWithZero, cover, transposed } from "./boxes.js";
import { PI, around, difference, enclosed, excludesZero, inner, interval, isPositive, isZero,
  middle, negated, powerOfTwo, product, quotient, scaled, sum, total, widened } from "./interval.js";
import { term, value } from "./jet.js";
import { isLoose, keepsSign, secondPostures, withoutPlay } from "./play.js";
import { demand } from "./rational.js";

const TERMS = 5; // of a jet along the path: the last one bounds the remainder
const MOST_INTERVALS = 100000, MOST_LOOSE = 20000;

/** Proves the certificate, or throws a Refusal; returns what was proved. */
export function provePath({ robot: all, limits, sign, postures: [first, second], path }) {
  const robot = withoutPlay(all), loose = isLoose(all);
  demand(same(path[0], first), "the path does not start at the first posture");
  demand(same(path.at(-1), second), "the path does not end at the second posture");
  path.forEach((point) => checkInside(limits, point.map(enclosed)));
  const still = new Arm(robot, 1), every = new Arm(all, 1), along = new Arm(robot, TERMS);
  const box = truePosture(still, first, second);
  const ends = loose ? secondPostures(every, first, box) : { box, change: 0 };
  const atEnd = value(still.determinant(box.map((x) => [x])));
  demand(hasSign(widened(atEnd, ends.change), sign), "det J at the second posture: sign not proved");
  checkInside(limits, ends.box);
  demand(differs(robot, ends.box, first), "the two postures are the same");
  path.slice(1).forEach((to, k) => {
    const start = path[k].map(enclosed), step = to.map((x, j) => enclosed(x.minus(path[k][j])));
    const line = { start, step, sign, name: `segment ${k + 1}` };
    if (loose) cover([interval(0, 1)], keepsSign(still, every, line), MOST_LOOSE);
    else cover([interval(0, 1)], keepsSignAlong(along, line), MOST_INTERVALS);
  });
  const count = path.length - 1;
  return `cuspidal: two postures of one place, joined by a path of ${count} ` +
    `segment${count > 1 ? "s" : ""} with det J ${sign > 0 ? ">" : "<"} 0`;
}

/** Intervals of joint values lie strictly inside the limits. */
export function checkInside(limits, box) {
  const inside = (x, [lower, upper]) => enclosed(lower).h < x.l && x.h < enclosed(upper).l;
  const all = !limits || limits.every((pair, k) => !pair || inside(box[k], pair));
  demand(all, "the claim is not proved to lie inside the limits");
}

const same = (a, b) => a.every((x, k) => x.equals(b[k]));
const hasSign = (x, sign) => isPositive(sign > 0 ? x : negated(x));

/** A box round the second posture with exactly one posture of the first one's value. */
function truePosture(arm, first, second) {
  const target = arm.walk(0, first.map((x) => [enclosed(x)])).tip;
  const system = (box) => linearised(arm, box.map((x) => [x]), target);
  return boxWithZero("true posture", second.map(enclosed), system, powerOfTwo(-48), powerOfTwo(-31));
}

/** F and F' over the values q, and whether the rotation left over is no half turn. */
function linearised(arm, q, target) {
  const { screws, tip } = arm.walk(0, q);
  const place = less(tip.p, target.p).map(value);
  const velocities = screws.map((screw) => arm.velocity(screw, tip.p).map(value));
  if (screws.length === 3) return { values: place, rows: transposed(velocities), holds: true };
  const back = arm.undo(target);
  const E = arm.then(back, tip).R.map((row) => row.map(value));
  const trace = total([E[0][0], E[1][1], E[2][2]]);
  const turning = E.map((row, i) => row.map((x, j) =>
    scaled(0.5, i === j ? difference(trace, x) : negated(x))));
  const rates = screws.map(({ w }) => {
    const seen = arm.turn(back.R, w).map(value);
    return turning.map((row) => inner(row, seen));
  });
  const skew = [[2, 1], [0, 2], [1, 0]].map(([j, k]) => scaled(0.5, difference(E[j][k], E[k][j])));
  const rows = transposed(velocities.map((velocity, k) => [...velocity, ...rates[k]]));
  return { values: [...place, ...skew], rows, holds: isPositive(difference(trace, interval(1))) };
}

/** Whether some joint tells the box from the first posture, modulo 2 pi where it turns. */
function differs(robot, box, first) {
  return robot.joints.some(({ turns }, k) => {
    const step = difference(box[k], enclosed(first[k]));
    if (!turns) return excludesZero(step);
    const { l, h } = quotient(step, scaled(2, PI));
    return l <= h && Math.floor(h) < l; // no integer in [l, h]
  });
}

/** Whether det J has the sign on a part of the segment; the opposite sign ends the proof. */
function keepsSignAlong(arm, { start, step, sign, name }) {
  const along = (s) => arm.determinant(start.map((x, k) =>
    isZero(step[k]) ? [x] : [sum(x, product(s, step[k])), step[k]]));
  return ([part]) => { // its ends are dyadic numbers, exact
    const centre = middle(part), at = along(interval(centre)), over = along(part);
    demand(!hasSign(value(at), -sign), `det J has the opposite sign on ${name} at ${centre}`);
    return hasSign(taylor(at, over, (part.h - part.l) / 2), sign) || hasSign(value(over), sign);
  };
}

/** The values f0 + f1 t + ... + r t^N for |t| <= reach, with Lagrange's remainder. */
function taylor(at, over, reach) {
  const lower = Array.from({ length: TERMS - 1 }, (_, k) => term(at, k));
  return lower.reduceRight((found, x) => sum(product(found, around(reach)), x), term(over, TERMS - 1));
}
