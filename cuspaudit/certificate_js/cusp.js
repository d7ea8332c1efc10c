// kind "cusp": next to one posture the map of the task has a cusp.
//
// h = det J, g = k . grad h and k . grad g are the derivatives of h along the flow of the
// field k = adj(J) e_r. The common zero of h and g is proved by the theorem of Poincare
// and Miranda: two combinations of them change sign across a square.

import { Arm } from "./arm.js";
import { enclosed, excludesZero, interval, isPositive, magnitude, middle, negated, powerOfTwo,
  product, sum } from "./interval.js";
import { UNIT } from "./jet.js";
import { checkInside } from "./path.js";
import { Refusal } from "./rational.js";

const FARTHEST = powerOfTwo(-24);
const FINEST = 256; // pieces of an edge

export function proveCusp({ robot, limits, posture }) {
  if (robot.task === "position-and-angle") throw new Refusal("a cusp is of another task");
  const field = new Field(robot, posture.map(enclosed));
  const square = field.squareWithZero(posture.map(enclosed));
  const { kernel, second } = field.flow(square);
  if (!kernel.some((x) => x && excludesZero(x))) throw new Refusal("the rank of J at the cusp is not proved");
  if (!field.variables.some((i) => excludesZero(field.slope(square, i))))
    throw new Refusal("grad det J at the cusp is not proved to differ from 0");
  if (!excludesZero(second)) throw new Refusal("k . grad(k . grad det J) is not proved to differ from 0");
  checkInside(limits, square);
  return "cuspidal: the map of the task has a cusp near the posture of the certificate";
}

const value = (jet, k = 0) => jet[k] ?? interval(0);

class Field {
  constructor(robot, posture) {
    this.arm = new Arm(robot, 3);
    this.size = robot.joints.length;
    this.variables = this.size === 3 ? [1, 2] : [1, 2, 3, 4]; // det J depends on no other
    const sizes = posture.map((_, row) => { this.row = row; return this.largest(posture); });
    this.row = sizes.indexOf(Math.max(...sizes));
  }

  largest(q) { return Math.max(...this.kernel(q.map((x) => [x])).map((jet) => (jet ? magnitude(value(jet)) : 0))); }

  /** adj(J) e_r at jets, one entry for each joint that counts. */
  kernel(q) {
    const columns = this.arm.columns(q);
    const unit = columns.map((_, i) => (i === this.row ? UNIT : []));
    return columns.map((_, i) => this.variables.includes(i)
      && this.arm.det(columns.map((column, j) => (i === j ? unit : column))));
  }

  /** k, h, g and k . grad g on a box: along x + k t + (Dk k) t^2 / 2, the flow to order 2. */
  flow(box) {
    const still = box.map((x) => [x]);
    const kernel = this.kernel(still).map((jet) => jet && value(jet));
    const first = box.map((x, i) => (kernel[i] ? [x, kernel[i]] : [x]));
    const bend = this.kernel(first).map((jet) => jet && product(value(jet, 1), interval(0.5)));
    const h = this.arm.determinant(first.map((jet, i) => (kernel[i] ? [...jet, bend[i]] : jet)));
    return { kernel, h: value(h), g: value(h, 1), second: product(value(h, 2), interval(2)) };
  }

  /** The derivative of h by joint i. */
  slope(box, i) {
    return value(this.arm.determinant(box.map((x, j) => (i === j ? [x, interval(1)] : [x]))), 1);
  }

  /** Two free joints and a square of their values, the others fixed, with h = g = 0 in it. */
  squareWithZero(posture) {
    let point = posture.map(middle);
    const pairs = this.variables.flatMap((a) => this.variables.filter((b) => b > a).map((b) => [a, b]));
    const size = ([a, b]) => { const [[p, q], [r, s]] = this.derivative(point, a, b); return Math.abs(p * s - q * r); };
    const [a, b] = pairs.reduce((best, pair) => (size(pair) > size(best) ? pair : best));
    let Y;
    for (let step = 0; step < 4; step++) { // Newton's method finds the middle, and proves nothing
      const [[p, q], [r, s]] = this.derivative(point, a, b);
      const below = p * s - q * r;
      Y = [[s / below, -q / below], [-r / below, p / below]];
      const { h, g } = this.flow(point.map((x) => interval(x)));
      [a, b].forEach((joint, i) => { point[joint] -= Y[i][0] * middle(h) + Y[i][1] * middle(g); });
    }
    const [[p, q], [r, s]] = Y.map((row) => row.map((x) => interval(x)));
    if (!excludesZero(sum(product(p, s), negated(product(q, r))))) throw new Refusal("no cusp is proved near the posture");
    for (let reach = powerOfTwo(-38); reach < FARTHEST / 4; reach *= 4) {
      const box = posture.map((x, i) => (i === a || i === b ? interval(point[i] - reach, point[i] + reach) : x));
      const near = [a, b].every((i) => box[i].h - posture[i].l < FARTHEST && posture[i].h - box[i].l < FARTHEST);
      if (near && this.changesSign(box, a, b, Y[0], 1) && this.changesSign(box, b, a, Y[1], 1)) return box;
    }
    throw new Refusal("no cusp is proved near the posture");
  }

  /** Whether y . (h, g) is negative where joint a is lowest in the box, and positive where highest. */
  changesSign(box, a, b, y, pieces) {
    const side = (edge, sign) => Array.from({ length: pieces }, (_, k) => k).every((k) => {
      const at = (part) => box[b].l + ((box[b].h - box[b].l) * part) / pieces;
      const [low, high] = [k === 0 ? box[b].l : at(k), k === pieces - 1 ? box[b].h : at(k + 1)];
      const { h, g } = this.flow(box.map((x, i) => (i === a ? interval(edge) : i === b ? interval(low, high) : x)));
      const total = sum(product(interval(y[0]), h), product(interval(y[1]), g));
      return isPositive(sign > 0 ? total : negated(total));
    });
    if (side(box[a].h, 1) && side(box[a].l, -1)) return true;
    return pieces < FINEST && this.changesSign(box, a, b, y, pieces * 4);
  }

  /** About d(h, g) by joints a and b, by differences: for Newton's method only. */
  derivative(point, a, b) {
    const at = (joint, step) => this.flow(point.map((x, i) => interval(i === joint ? x + step : x)));
    const columns = [a, b].map((joint) => {
      const [there, back] = [at(joint, 1e-5), at(joint, -1e-5)];
      return [middle(there.h) - middle(back.h), middle(there.g) - middle(back.g)].map((x) => x / 2e-5);
    });
    return [[columns[0][0], columns[1][0]], [columns[0][1], columns[1][1]]];
  }
}
