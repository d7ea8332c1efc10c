// kind "structure": relations of the axes, exactly, and a theorem that rests on them.

import { Arm } from "./arm.js";
import { enclosed, excludesZero } from "./interval.js";
import { constant, value } from "./jet.js";
import { ONE, Rational, ZERO, demand, integerRoot, ratio } from "./rational.js";

const MOST_TERMS = 2000, THIRD = ratio(1, 3), HALF = ratio(1, 2);

/** Sums of c exp(i pi t) exp(i r), 0 <= t < 2/3, no t and r twice. */
class Sum {
  terms = new Map();

  static of(number) { return new Sum().add(ZERO, ZERO, number); }
  static power(halfTurns, radians) { return new Sum().add(halfTurns, radians, ONE); }

  get isZero() { return this.terms.size === 0; }

  /** Adds c exp(i pi t) exp(i r) in place, t reduced by z^12 = -1 and z^8 = z^4 - 1. */
  add(t, r, c) {
    const turns = t.floor, rest = t.minus(new Rational(turns)), value = turns % 2n ? c.negative : c;
    if (rest.lessThan(ratio(2, 3))) return this.collect(rest, r, value);
    const below = rest.minus(THIRD);
    return this.collect(below, r, value).collect(below.minus(THIRD), r, value.negative);
  }

  collect(t, r, c) {
    const key = `${t} ${r}`, total = c.plus(this.terms.get(key)?.c ?? ZERO);
    if (total.isZero) this.terms.delete(key);
    else this.terms.set(key, { t, r, c: total });
    return this;
  }

  plus(other) {
    const found = new Sum();
    for (const { t, r, c } of [...this.terms.values(), ...other.terms.values()]) found.collect(t, r, c);
    return found;
  }

  times(other) {
    demand(this.terms.size * other.terms.size <= MOST_TERMS, "a relation is too long to be tested exactly");
    const found = new Sum();
    for (const a of this.terms.values())
      for (const b of other.terms.values()) found.add(a.t.plus(b.t), a.r.plus(b.r), a.c.times(b.c));
    return found;
  }

  scaled(number) { return this.times(Sum.of(number)); }
  minus(other) { return this.plus(other.scaled(ratio(-1))); }
}

function cosineAndSine(halfTurns, radians) {
  const there = Sum.power(halfTurns, radians), back = Sum.power(halfTurns.negative, radians.negative);
  const overI = Sum.power(HALF.negative, ZERO);
  return [there.plus(back).scaled(HALF), there.minus(back).times(overI).scaled(HALF)];
}

const twiceCosine = (d) => cosineAndSine(ratio(1, d), ZERO)[0].scaled(ratio(2));
const ROOTS = [[1n, Sum.of(ONE)], [2n, twiceCosine(4)], [3n, twiceCosine(6)],
  [6n, twiceCosine(4).times(twiceCosine(6))]];

/** The root of a positive number that is 1, 2, 3 or 6 times a square. */
function root(square) {
  for (const [d, rootOfD] of ROOTS) {
    const side = integerRoot(square.n * square.d / d);
    if (side * side * d === square.n * square.d) return rootOfD.scaled(new Rational(side, square.d));
  }
  return demand(false, "a rotation axis has a length whose root is not known exactly here");
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
  const [cosine, sine] = cosineAndSine(motion.angle.pi, motion.angle.rad);
  const along = scaled(v, dot(v, w).scaled(ONE.over(square)));
  const found = added(along, scaled(added(w, opposite(along)), cosine));
  const beside = cross(v, w);
  if (sine.isZero || vanish(beside)) return found;
  return added(found, scaled(beside, sine.times(root(square)).scaled(ONE.over(square))));
}

const placed = (motion, point) =>
  (motion.translate ? added(point, column(motion.translate)) : turned(motion, point));

const vanish = (sums) => sums.every((x) => x.isZero);
const isAbout = (motion, axis) => !motion.translate && vanish(cross(column(motion.rotate), column(axis)));

// --- relations

/** Axes `first` and `last`: directions u and v, a point p of the second, in the first's frame;
 *  and whether no joint between them turns. */
function pair(robot, first, last) {
  const [one, other] = [robot.joints[first - 1], robot.joints[last - 1]];
  const motions = robot.joints.slice(first, last).flatMap((joint) => joint.before);
  while (motions.length && isAbout(motions[0], one.axis)) motions.shift();
  while (motions.length && isAbout(motions.at(-1), other.axis)) motions.pop();
  const v = motions.reduceRight((w, motion) => turned(motion, w), column(other.axis));
  const p = motions.reduceRight((x, motion) => placed(motion, x), column([ZERO, ZERO, ZERO]));
  const areFixed = robot.joints.slice(first, last - 1).every((joint) => !joint.turns);
  return { u: column(one.axis), v, p, one, other, motions, areFixed };
}

const pairs = (robot, axes) => axes.slice(1).map((last, k) => pair(robot, axes[k], last));
const areInARow = (axes) => axes.every((k, i) => k === axes[0] + i);

const areParallel = (robot, axes) =>
  pairs(robot, axes).every(({ u, v, areFixed }) => areFixed && vanish(cross(u, v)));

export const areSquare = (robot, axes) => axes.length === 2 && areInARow(axes)
  && pairs(robot, axes).every(({ u, v }) => dot(u, v).isZero);

function areLevel(robot, axes) {
  if (axes.length !== 3 || !areInARow(axes)) return false;
  const [before, after] = pairs(robot, axes);
  const across = dot(before.p, before.v).plus(dot(after.p, after.u));
  return vanish([dot(before.u, before.v), dot(after.u, after.v), across]);
}

function areMeeting(robot, axes) {
  if (axes.length < 2 || axes.length > 3 || !areInARow(axes)) return false;
  const all = pairs(robot, axes), [before, after] = all;
  const cut = all.every((two) => dot(two.p, cross(two.u, two.v)).isZero && isSkew(robot, two));
  if (!cut || !after) return cut;
  // the middle axis runs along v of the pair before it and along u of the pair after it
  const [above, below] = crossing(before.v, before.u, opposite(before.p));
  const [top, bottom] = crossing(after.u, after.v, after.p);
  return above.times(bottom).minus(top.times(below)).isZero;
}

/** Whether two axes are not parallel, by intervals. */
function isSkew(robot, { one, other, motions }) {
  const arm = new Arm(robot, 1), [u, w] = [one, other].map(({ axis }) =>
    axis.map((x) => constant(enclosed(x))));
  return arm.cross(u, arm.turn(arm.fixed(motions).R, w)).some((x) => excludesZero(value(x)));
}

/** Where a line through q along b meets the line through 0 along a, as a quotient. */
function crossing(a, b, q) {
  const normal = cross(a, b);
  return [dot(cross(q, b), normal), dot(normal, normal)];
}

const HOLDS = { parallel: areParallel, level: areLevel, square: areSquare, meeting: areMeeting };

// --- theorems

const COUPLES = ["1,2", "2,3", "3,4", "4,5", "5,6"];
const TRIPLES = ["1,2,3", "2,3,4", "3,4,5", "4,5,6"];
const rows = (lists) => lists.flatMap((axes) => [`${axes} meeting`, `${axes} parallel`]);
const withEach = (first, others) => others.map((other) => [first, other]);
const apart = (triple) => COUPLES.filter((two) => !two.split(",").some((k) => triple.includes(k)));
const PATTERN = ["1,2", "4,5", "5,6"].flatMap((axes) => [`${axes} meeting`, `${axes} square`]);
const POSE = ["pose", "position-and-axis"], ANGLE = ["position-and-angle"];

/** The tasks of each theorem, and the sets of relations, all axes of which must turn. */
const THEOREMS = {
  "pair of axes": [["position"], () => rows(["1,2", "2,3"]).map((pair) => [pair])],
  "no offset": [["position"], () => [["1,2,3 level"]]],
  "triple and pair": [POSE, (turning) => (turning.length < 6 ? []
    : TRIPLES.flatMap((three) => rows([three]).flatMap((triple) => withEach(triple, rows(apart(three))))))],
  "spherical wrist": [POSE, () => withEach("4,5,6 meeting", [...rows(["1,2", "2,3"]), "1,2,3 level"])],
  "spherical shoulder": [POSE, () => withEach("1,2,3 meeting", [...rows(["4,5", "5,6"]), "4,5,6 level"])],
  "UR pattern": [POSE, () => [["2,3,4 parallel", ...PATTERN]]],
  "parallel axes": [ANGLE, (turning) => [[`${turning} parallel`]]],
  "yaw and pitch": [ANGLE, () => [["1,2 square", "2,3,4 parallel"]]],
};
const told = ({ axes, are }) => `${axes} ${are}`;

/** det J is not 0 at the posture. */
export function checkRegular(robot, regular) {
  const det = new Arm(robot, 1).determinant(regular.map((x) => [enclosed(x)]));
  demand(excludesZero(value(det)), "det J at the regular posture is not proved to differ from 0");
}

/** Proves the certificate, or throws a Refusal; returns what was proved. */
export function proveStructure({ robot, theorem, relations, regular }) {
  demand(Object.hasOwn(THEOREMS, theorem), "no theorem of this name is known here");
  const [tasks, setsOf] = THEOREMS[theorem], found = relations.map(told);
  demand(tasks.includes(robot.task), "the theorem is about another task");
  const turning = robot.joints.flatMap((joint, k) => (joint.turns ? [k + 1] : []));
  const isSame = (set) => set.length === found.length && set.every((each) => found.includes(each));
  demand(setsOf(turning).some(isSame), "the relations are not those of the theorem");
  const named = relations.flatMap(({ axes }) => axes);
  demand(named.every((k) => turning.includes(k)), "a joint of the theorem slides");
  for (const relation of relations)
    demand(HOLDS[relation.are](robot, relation.axes), `not proved: axes ${told(relation)}`);
  checkRegular(robot, regular);
  return `noncuspidal: axes ${found.join(", ")}; theorem "${theorem}"`;
}
