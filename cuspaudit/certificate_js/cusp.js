// kind "cusp": next to one posture the map of the task has a cusp.
//
// h = det J, g = k . grad h and k . grad g are the derivatives of h along the flow of the
// field k = adj(J) e_r. The common zero of h and g is proved by Krawczyk's test in two joints.

import { Arm } from "./arm.js";
import { difference, enclosed, excludesZero, interval, magnitude, middle, negated, powerOfTwo,
  product, sum, widened } from "./interval.js";
import { UNIT } from "./jet.js";
import { checkInside } from "./path.js";
import { isLoose } from "./play.js";
import { Refusal } from "./rational.js";

const FARTHEST = powerOfTwo(-24), FARTHEST_OF_MANY = powerOfTwo(-1);

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
    this.farthest = isLoose(robot) ? FARTHEST_OF_MANY : FARTHEST;
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

  /** The derivative of g by joint b: half the difference of two second coefficients of h,
   *  along x + (e_b + k) t + (d k / d b) t^2 and x + (e_b - k) t - (d k / d b) t^2. */
  slopeOfG(box, b) {
    const along = this.kernel(box.map((x, j) => (b === j ? [x, interval(1)] : [x])));
    const second = (turn) => value(this.arm.determinant(box.map((x, j) => {
      const own = interval(j === b ? 1 : 0), k = along[j] || [];
      return [x, sum(own, turn(value(k))), turn(value(k, 1))];
    })), 2);
    return product(difference(second((x) => x), second(negated)), interval(0.5));
  }

  derivative(box, joints) {
    return [joints.map((i) => this.slope(box, i)), joints.map((i) => this.slopeOfG(box, i))];
  }

  /** Two free joints and a square of their values, the others fixed, with h = g = 0 in it. */
  squareWithZero(posture) {
    const pairs = this.variables.flatMap((a) => this.variables.filter((b) => b > a).map((b) => [a, b]));
    const numbers = (joints) => this.derivative(posture, joints).map((row) => row.map(middle));
    const size = (joints) => { const [[p, q], [r, s]] = numbers(joints); return Math.abs(p * s - q * r); };
    const joints = pairs.reduce((best, pair) => (size(pair) > size(best) ? pair : best));
    const [[p, q], [r, s]] = numbers(joints), below = p * s - q * r;
    const Y = [[s / below, -q / below], [-r / below, p / below]].map((row) => row.map((x) => interval(x)));
    const applied = (column) => Y.map((row) => sum(product(row[0], column[0]), product(row[1], column[1])));
    const centre = posture.map((x, i) => (joints.includes(i) ? interval(middle(x)) : x));
    const { h, g } = this.flow(centre);
    const newton = applied([h, g]);
    for (let reach = 2 * Math.max(...newton.map(magnitude), powerOfTwo(-50)); reach <= this.farthest; reach *= 2) {
      const box = centre.map((x, i) => (joints.includes(i) ? widened(x, reach) : x));
      const A = this.derivative(box, joints), step = interval(-reach, reach);
      const columns = [0, 1].map((j) => applied([A[0][j], A[1][j]]));
      const inside = [0, 1].every((i) => magnitude([0, 1].reduce((total, j) => sum(total, product(
        difference(interval(i === j ? 1 : 0), columns[j][i]), step)), newton[i])) < reach);
      const near = joints.every((i) => box[i].l < posture[i].l && posture[i].h < box[i].h);
      if (inside && near) return box;
    }
    throw new Refusal("no cusp is proved near the posture");
  }
}
