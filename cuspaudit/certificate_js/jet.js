// Jets: [f0, f1, ...], f = f0 + f1 t + ... cut off after a number of terms, each term an
// interval. Terms at the end that are exactly 0 are left out; the jet 0 is [].
// An operation on jets gives jets that hold each result on members of its operands.

import { isZero, interval, negated, product, quotient, sineAndCosine, sum }
  from "./interval.js";

export const constant = (a) => (isZero(a) ? [] : [a]);
export const UNIT = [interval(1)];

export function plus(f, g) {
  const [long, short] = f.length < g.length ? [g, f] : [f, g];
  return long.map((a, k) => (k < short.length ? sum(a, short[k]) : a));
}

export const minus = (f) => f.map(negated);

export function times(f, g, terms) {
  if (!f.length || !g.length) return [];
  const found = [];
  for (let k = 0; k < Math.min(terms, f.length + g.length - 1); k++) {
    let total = interval(0);
    for (let i = Math.max(0, k - g.length + 1); i <= Math.min(k, f.length - 1); i++)
      total = sum(total, product(f[i], g[k - i]));
    found.push(total);
  }
  return found;
}

/** Sine and cosine of a + b t: their k-th derivatives are known, over k!. */
export function trigonometric(jet, terms) {
  const [a, b] = [jet[0] ?? interval(0), jet[1] ?? interval(0)];
  const [s, c] = sineAndCosine(a);
  if (jet.length > 2) return toSecondOrder(s, c, b, jet[2]);
  const cycle = [s, c, negated(s), negated(c)];
  const [sine, cosine] = [[], []];
  let factor = interval(1);
  for (let k = 0; k < terms && !isZero(factor); k++) {
    sine.push(product(cycle[k % 4], factor));
    cosine.push(product(cycle[(k + 1) % 4], factor));
    factor = quotient(product(factor, b), interval(k + 1));
  }
  return [sine, cosine];
}

/** Sine and cosine of a + b t + d t^2, three terms each. */
function toSecondOrder(s, c, b, d) {
  const half = product(product(b, b), interval(0.5));
  return [
    [s, product(c, b), sum(product(c, d), negated(product(s, half)))],
    [c, negated(product(s, b)), negated(sum(product(s, d), product(c, half)))],
  ];
}
