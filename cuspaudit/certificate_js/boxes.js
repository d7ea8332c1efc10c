// Boxes, lists of intervals: cut into halves, and with a zero of a system of equations.

import { around, difference, inner, interval, magnitude, middle, sum, widened } from "./interval.js";
import { demand } from "./rational.js";

/** The halves of a box, cut across its widest side of those that may be cut. */
export function halves(box, mayBeCut = () => true) {
  const sizes = box.map((x, i) => (mayBeCut(i) ? x.h - x.l : 0));
  const widest = sizes.indexOf(Math.max(...sizes)), { l, h } = box[widest], m = middle(box[widest]);
  demand(l < m && m < h, "a box is too small to be cut");
  return [interval(m, h), interval(l, m)].map((half) => box.map((x, i) => (i === widest ? half : x)));
}

/** Every part of a box is proved, or halved; returns how many parts were looked at. */
export function cover(whole, isProved, most) {
  const open = [whole];
  for (let count = 1; ; count++) {
    demand(count <= most, "not covered: too many parts");
    const box = open.pop();
    if (!isProved(box)) open.push(...halves(box));
    if (!open.length) return count;
  }
}

/** An approximate inverse of the middles, as points; null if there is none. Nothing depends
 *  on how good it is but whether a proof is found. */
export function inverse(matrix) {
  const size = matrix.length;
  const rows = matrix.map((row, i) => [...row.map(middle), ...row.map((_, j) => (i === j ? 1 : 0))]);
  for (let k = 0; k < size; k++) {
    const candidates = rows.slice(k).map((row) => Math.abs(row[k]));
    const pivot = k + candidates.indexOf(Math.max(...candidates));
    if (!(Math.abs(rows[pivot]?.[k]) > 0)) return null;
    [rows[k], rows[pivot]] = [rows[pivot], rows[k]];
    rows[k] = rows[k].map((x, _, row) => x / row[k]);
    rows.forEach((row, i) => {
      if (i !== k) rows[i] = row.map((x, j) => x - row[k] * rows[k][j]);
    });
  }
  return rows.map((row) => row.slice(size).map((x) => interval(x)));
}

export const transposed = (matrix) => matrix[0].map((_, j) => matrix.map((row) => row[j]));

/** 1 - Y A */
export const defect = (Y, A) => Y.map((row, i) => transposed(A).map((column, j) =>
  difference(interval(i === j ? 1 : 0), inner(row, column))));

/** Krawczyk's test: a box round the claimed values in which a system has exactly one zero.
 *  @param system (box) => {values, rows, holds}: the functions, their derivatives by rows, and
 *    whether what else is needed holds; @param least, most radii to be tried */
export function boxWithZero(name, claimed, system, least, most) {
  const centre = claimed.map((x) => interval(middle(x))), at = system(centre);
  const Y = inverse(at.rows);
  demand(Y, `J is singular next to the ${name}`);
  const newton = Y.map((row) => inner(row, at.values));
  for (let radius = 2 * Math.max(...newton.map(magnitude), least); radius <= most; radius *= 2) {
    const box = centre.map((x) => widened(x, radius)), { rows, holds } = system(box);
    const steps = box.map(() => around(radius));
    const inside = defect(Y, rows).every((row, i) =>
      magnitude(sum(newton[i], inner(row, steps))) < radius);
    const near = claimed.every((x, i) => box[i].l < x.l && x.h < box[i].h);
    if (inside && near && holds) return box;
  }
  return demand(false, `no ${name} is proved next to the posture`);
}
