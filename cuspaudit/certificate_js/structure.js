// kind "structure": relations of the axes, exactly, and a theorem that rests on them.

import { Arm } from "./arm.js";
import { enclosed, excludesZero } from "./interval.js";
import { constant } from "./jet.js";
import { ONE, Rational, Refusal, ZERO, integerRoot, ratio } from "./rational.js";

const MOST_TERMS = 2000;

/** Sums of c exp(i pi (t0 + k/12)) exp(i r); the map holds c by its exponents. */
class Sum {
  constructor(terms = new Map()) { this.terms = terms; }

  static of(number) { return new Sum().add(ZERO, ZERO, number); }
  static power(halfTurns, radians) { return new Sum().add(halfTurns, radians, ONE); }

  get isZero() { return this.terms.size === 0; }

  /** Adds c exp(i pi t) exp(i r) in place, its power of z = exp(i pi / 12) reduced. */
  add(t, r, c) {
    const twelfths = t.times(ratio(12)).floor;
    const rest = t.minus(new Rational(twelfths, 12n));
    let k = Number(((twelfths % 24n) + 24n) % 24n);
    if (k >= 12) [k, c] = [k - 12, c.negative];          // z^12 = -1
    if (k < 8) return this.collect(rest, r, k, c);
    this.collect(rest, r, k - 4, c);                     // z^8 = z^4 - 1
    return this.collect(rest, r, k - 8, c.negative);
  }

  collect(rest, r, k, c) {
    const key = `${rest} ${r} ${k}`;
    const total = c.plus(this.terms.get(key)?.c ?? ZERO);
    if (total.isZero) this.terms.delete(key);
    else this.terms.set(key, { rest, r, k, c: total });
    return this;
  }

  plus(other) {
    const found = new Sum(new Map(this.terms));
    for (const { rest, r, k, c } of other.terms.values()) found.collect(rest, r, k, c);
    return found;
  }

  scaled(number) {
    const found = new Sum();
    for (const { rest, r, k, c } of this.terms.values()) found.collect(rest, r, k, c.times(number));
    return found;
  }

  minus(other) { return this.plus(other.scaled(ratio(-1))); }

  times(other) {
    if (this.terms.size * other.terms.size > MOST_TERMS)
      throw new Refusal("a relation is too long to be tested exactly");
    const found = new Sum();
    for (const a of this.terms.values())
      for (const b of other.terms.values())
        found.add(a.rest.plus(b.rest).plus(ratio(a.k + b.k, 12)), a.r.plus(b.r), a.c.times(b.c));
    return found;
  }
}

function cosineAndSine(halfTurns, radians) {
  const there = Sum.power(halfTurns, radians), back = Sum.power(halfTurns.negative, radians.negative);
  const half = ratio(1, 2), overI = Sum.power(ratio(-1, 2), ZERO);
  return [there.plus(back).scaled(half), there.minus(back).times(overI).scaled(half)];
}

/** The root of a positive number that is 1, 2, 3 or 6 times a square. */
function root(square) {
  const whole = square.n * square.d;
  for (const d of [1n, 2n, 3n, 6n]) {
    const side = integerRoot(whole / d);
    if (side * side * d !== whole) continue;
    let found = Sum.of(new Rational(side, square.d));
    for (const [prime, below] of [[2n, 4], [3n, 6]])
      if (d % prime === 0n) found = found.times(cosineAndSine(ratio(1, below), ZERO)[0].scaled(ratio(2)));
    return found;
  }
  throw new Refusal("a rotation axis has a length whose root is not known exactly here");
}

// --- vectors of sums

const column = (v) => v.map(Sum.of);
const added = (a, b) => a.map((x, i) => x.plus(b[i]));
const scaled = (a, factor) => a.map((x) => x.times(factor));
const opposite = (a) => a.map((x) => x.scaled(ratio(-1)));
const dot = (a, b) => a.reduce((total, x, i) => total.plus(x.times(b[i])), new Sum());
const cross = (a, b) => [0, 1, 2].map((i) => {
  const [j, k] = [(i + 1) % 3, (i + 2) % 3];
  return a[j].times(b[k]).minus(a[k].times(b[j]));
});

/** The image of a direction w under a fixed motion. */
function turned(motion, w) {
  if (motion.translate) return w;
  const v = column(motion.rotate);
  const square = motion.rotate.reduce((total, x) => total.plus(x.times(x)), ZERO);
  const [cosine, sine] = cosineAndSine(motion.halfTurns, motion.radians);
  const along = scaled(v, dot(v, w).scaled(ONE.over(square)));
  const found = added(along, scaled(added(w, opposite(along)), cosine));
  const beside = cross(v, w);
  if (sine.isZero || beside.every((x) => x.isZero)) return found;
  return added(found, scaled(beside, sine.times(root(square)).scaled(ONE.over(square))));
}

function placed(motion, point) {
  return motion.translate ? added(point, column(motion.translate)) : turned(motion, point);
}

const isAbout = (motion, axis) => !motion.translate && [0, 1, 2].every((i) => {
  const [j, k] = [(i + 1) % 3, (i + 2) % 3];
  return motion.rotate[j].times(axis[k]).equals(motion.rotate[k].times(axis[j]));
});

// --- relations

/** Axes `first` and `last`: directions u and v, a point p of the second, in the first's frame. */
function pair(robot, first, last) {
  const [one, other] = [robot.joints[first - 1], robot.joints[last - 1]];
  const motions = robot.joints.slice(first, last).flatMap((joint) => joint.before);
  while (motions.length && isAbout(motions[0], one.axis)) motions.shift();
  while (motions.length && isAbout(motions.at(-1), other.axis)) motions.pop();
  const v = motions.reduceRight((w, motion) => turned(motion, w), column(other.axis));
  const p = motions.reduceRight((x, motion) => placed(motion, x), column([ZERO, ZERO, ZERO]));
  return { u: column(one.axis), v, p, one, other, motions };
}

const vanish = (...sums) => sums.every((x) => x.isZero);

function areParallel(robot, axes) {
  return axes.slice(1).every((last, k) => {
    const first = axes[k];
    if (robot.joints.slice(first, last - 1).some((joint) => joint.turns)) return false;
    const { u, v } = pair(robot, first, last);
    return vanish(...cross(u, v));
  });
}

export function areSquare(robot, [first, last]) {
  const { u, v } = pair(robot, first, last);
  return last === first + 1 && vanish(dot(u, v));
}

function areLevel(robot, axes) {
  const [first, middle, last] = axes;
  if (axes.length !== 3 || !areSquare(robot, [first, middle]) || !areSquare(robot, [middle, last]))
    return false;
  const [before, after] = [pair(robot, first, middle), pair(robot, middle, last)];
  return vanish(dot(before.p, before.v).plus(dot(after.p, after.u)));
}

function areMeeting(robot, axes) {
  if (axes.length < 2 || axes.length > 3) return false;
  const pairs = axes.slice(1).map((last, k) => last === axes[k] + 1 && pair(robot, axes[k], last));
  const cut = pairs.every((two) => two && vanish(dot(two.p, cross(two.u, two.v))) && isSkew(robot, two));
  if (!cut || axes.length === 2) return cut;
  const [before, after] = pairs;
  // the middle axis runs along v of the pair before it and along u of the pair after it
  const [above, below] = crossing(before.v, before.u, opposite(before.p));
  const [top, bottom] = crossing(after.u, after.v, after.p);
  return vanish(above.times(bottom).minus(top.times(below)));
}

/** Whether two axes are not parallel, by intervals. */
function isSkew(robot, { one, other, motions }) {
  const arm = new Arm(robot, 1);
  const v = arm.turn(arm.fixed(motions).R, other.axis.map((x) => constant(enclosed(x))));
  const normal = arm.cross(one.axis.map((x) => constant(enclosed(x))), v);
  return normal.some((x) => x.length > 0 && excludesZero(x[0]));
}

function crossing(a, b, q) {
  const normal = cross(a, b);
  return [dot(cross(q, b), normal), dot(normal, normal)];
}

function holds(robot, { axes, are }) {
  if (are === "parallel") return areParallel(robot, axes);
  if (are === "level") return areLevel(robot, axes);
  return are === "square" ? areSquare(robot, axes) : areMeeting(robot, axes);
}

// --- theorems

const POSE = ["pose", "position-and-axis"];
const told = ({ axes, are }) => `${axes.join(",")} ${are}`;
const inARow = ({ axes }) => axes.every((k, i) => k === axes[0] + i);
const isRow = (relation, size) =>
  relation.axes.length === size && inARow(relation) && ["meeting", "parallel"].includes(relation.are);

function areExactly(relations, wanted) {
  const found = relations.map(told);
  return found.length === wanted.length && new Set(found).size === found.length
    && wanted.every((each) => found.includes(each));
}

/** Three axes that meet in a point, and a pair of the others, or all the others level. */
function pointAndRest(point, rest) {
  return (relations, turn) => {
    const other = relations.find((r) => told(r) !== `${point.join(",")} meeting`);
    if (relations.length !== 2 || !other || !turn(point)) return false;
    if (!relations.some((r) => told(r) === `${point.join(",")} meeting`)) return false;
    const inRest = other.axes.every((k) => rest.includes(k)) && turn(other.axes);
    return inRest && (isRow(other, 2) || told(other) === `${rest.join(",")} level`);
  };
}

/** Whether the relations are those of a theorem; `turn` asks whether joints turn. */
const THEOREMS = {
  "pair of axes": [["position"], (relations, turn) =>
    relations.length === 1 && isRow(relations[0], 2) && turn(relations[0].axes)],
  "no offset": [["position"], (relations, turn) =>
    turn([1, 2, 3]) && areExactly(relations, ["1,2,3 level"])],
  "triple and pair": [POSE, (relations, turn) => {
    const [two, three] = [...relations].sort((a, b) => a.axes.length - b.axes.length);
    return relations.length === 2 && isRow(two, 2) && isRow(three, 3)
      && !two.axes.some((k) => three.axes.includes(k)) && turn([1, 2, 3, 4, 5, 6]);
  }],
  "spherical wrist": [POSE, pointAndRest([4, 5, 6], [1, 2, 3])],
  "spherical shoulder": [POSE, pointAndRest([1, 2, 3], [4, 5, 6])],
  "UR pattern": [POSE, (relations, turn) => turn([1, 2, 3, 4, 5, 6]) && areExactly(relations, [
    "2,3,4 parallel", ...["1,2", "4,5", "5,6"].flatMap((k) => [`${k} meeting`, `${k} square`])])],
  "parallel axes": [["position-and-angle"], (relations, turn) => {
    const turning = [1, 2, 3, 4].filter((k) => turn([k]));
    return turning.length > 0 && areExactly(relations, [`${turning.join(",")} parallel`]);
  }],
  "yaw and pitch": [["position-and-angle"], (relations, turn) =>
    turn([1, 2, 3, 4]) && areExactly(relations, ["1,2 square", "2,3,4 parallel"])],
};

/** det J is not 0 at the posture. */
export function checkRegular(robot, regular) {
  const value = new Arm(robot, 1).determinant(regular.map((x) => [enclosed(x)]));
  if (!value.length || !excludesZero(value[0]))
    throw new Refusal("det J at the regular posture is not proved to differ from 0");
}

/** Proves the certificate, or throws a Refusal; returns what was proved. */
export function proveStructure({ robot, theorem, relations, regular }) {
  if (!Object.hasOwn(THEOREMS, theorem)) throw new Refusal("no theorem of this name is known here");
  const [tasks, fits] = THEOREMS[theorem];
  const turn = (axes) => axes.every((k) => robot.joints[k - 1].turns);
  if (!tasks.includes(robot.task)) throw new Refusal("the theorem is about another task");
  if (!fits(relations, turn)) throw new Refusal("the relations are not those of the theorem");
  for (const relation of relations)
    if (!holds(robot, relation)) throw new Refusal(`not proved: axes ${told(relation)}`);
  checkRegular(robot, regular);
  return `noncuspidal: axes ${relations.map(told).join(", ")}; theorem "${theorem}"`;
}
