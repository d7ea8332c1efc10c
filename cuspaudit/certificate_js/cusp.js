// kind "cusp": next to one posture the map of the task has a cusp.
// h = det J, g = k . grad h and k . grad g are the derivatives of h along the flow of the
// field k = adj(J) e_r. The common zero of h and g is proved by Krawczyk's test in two joints.

import { Arm } from "./arm.js";
import { boxWithZero } from "./boxes.js";
import { difference, enclosed, excludesZero, interval, magnitude, middle, negated, powerOfTwo,
  scaled, sum } from "./interval.js";
import { UNIT, term, value } from "./jet.js";
import { checkInside } from "./path.js";
import { isLoose } from "./play.js";
import { demand } from "./rational.js";

export function proveCusp({ robot, limits, posture }) {
  const field = new Field(robot, posture.map(enclosed));
  const square = field.squareWithZero(posture.map(enclosed));
  const { kernel, second } = field.flow(square);
  const slopes = field.variables.map((i) => field.slope(square, i));
  demand(kernel.some(excludesZero), "the rank of J at the cusp is not proved");
  demand(slopes.some(excludesZero), "grad det J at the cusp is not proved to differ from 0");
  demand(excludesZero(second), "k . grad(k . grad det J) is not proved to differ from 0");
  checkInside(limits, square);
  return "cuspidal: the map of the task has a cusp near the posture of the certificate";
}

class Field {
  constructor(robot, posture) {
    this.arm = new Arm(robot, 3);
    this.farthest = powerOfTwo(isLoose(robot) ? -1 : -24);
    this.variables = robot.joints.length === 3 ? [1, 2] : [1, 2, 3, 4]; // det J depends on no other
    const largest = (jets) => Math.max(...jets.map((jet) => magnitude(value(jet))));
    const sizes = posture.map((_, row) => largest(this.kernel(posture.map((x) => [x]), row)));
    this.row = sizes.indexOf(Math.max(...sizes));
  }

  /** adj(J) e_r at jets, its entries for the joints that count. */
  kernel(q, row = this.row) {
    const columns = this.arm.columns(q);
    const unit = columns.map((_, i) => (i === row ? UNIT : []));
    return columns.map((_, i) => (this.variables.includes(i)
      ? this.arm.det(columns.map((column, j) => (i === j ? unit : column))) : []));
  }

  /** k, h, g and k . grad g on a box: along x + k t + (Dk k) t^2 / 2, the flow to order 2. */
  flow(box) {
    const kernel = this.kernel(box.map((x) => [x])).map(value);
    const bend = this.kernel(box.map((x, i) => [x, kernel[i]])).map((jet) => scaled(0.5, term(jet, 1)));
    const h = this.arm.determinant(box.map((x, i) => [x, kernel[i], bend[i]]));
    return { kernel, h: value(h), g: term(h, 1), second: scaled(2, term(h, 2)) };
  }

  /** The derivative of h by joint i. */
  slope(box, i) {
    return term(this.arm.determinant(box.map((x, j) => (i === j ? [x, interval(1)] : [x]))), 1);
  }

  /** The derivative of g by joint b: half the difference of two second coefficients of h,
   *  along x + (e_b + k) t + (d k / d b) t^2 and x + (e_b - k) t - (d k / d b) t^2. */
  slopeOfG(box, b) {
    const along = this.kernel(box.map((x, j) => (b === j ? [x, interval(1)] : [x])));
    const second = (turn) => term(this.arm.determinant(box.map((x, j) => {
      const own = interval(j === b ? 1 : 0);
      return [x, sum(own, turn(value(along[j]))), turn(term(along[j], 1))];
    })), 2);
    return scaled(0.5, difference(second((x) => x), second(negated)));
  }

  derivative(box, joints) {
    return [joints.map((i) => this.slope(box, i)), joints.map((i) => this.slopeOfG(box, i))];
  }

  /** A box with a common zero of h and g: two free joints in a square, the others fixed. */
  squareWithZero(posture) {
    const pairs = this.variables.flatMap((a) => this.variables.filter((b) => b > a).map((b) => [a, b]));
    const size = (joints) => {
      const [[p, q], [r, s]] = this.derivative(posture, joints).map((row) => row.map(middle));
      return Math.abs(p * s - q * r);
    };
    const joints = pairs.reduce((best, pair) => (size(pair) > size(best) ? pair : best));
    const boxOf = (square) => posture.map((x, i) => (joints.includes(i) ? square[joints.indexOf(i)] : x));
    const system = (square) => {
      const { h, g } = this.flow(boxOf(square));
      return { values: [h, g], rows: this.derivative(boxOf(square), joints), holds: true };
    };
    const claimed = joints.map((i) => posture[i]);
    return boxOf(boxWithZero("cusp", claimed, system, powerOfTwo(-50), this.farthest));
  }
}
