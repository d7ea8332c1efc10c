// Jets: [f0, f1, ...], f = f0 + f1 t + ... cut off after a number of terms, each term an
// interval. Terms at the end that are exactly 0 are left out; the jet 0 is [].
// An operation on jets gives jets that hold each result on members of its operands.

import { NOUGHT, inner, interval, isZero, negated, product, quotient, scaled, sineAndCosine, sum }
  from "./interval.js";

export const constant = (a) => (isZero(a) ? [] : [a]);
export const term = (jet, k) => jet[k] ?? NOUGHT;
export const value = (jet) => term(jet, 0);
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
    let total = NOUGHT;
    for (let i = Math.max(0, k - g.length + 1); i <= Math.min(k, f.length - 1); i++)
      total = sum(total, product(f[i], g[k - i]));
    found.push(total);
  }
  return found;
}

/** Sine and cosine of a jet, from s' = c q' and c' = -s q', term by term. */
export function trigonometric(q, terms) {
  const [[s, c], slopes] = [sineAndCosine(value(q)), q.slice(1).map((x, j) => scaled(j + 1, x))];
  const [sine, cosine] = [[s], [c]];
  for (let k = 1; k < terms && slopes.length; k++) {
    const first = slopes.slice(0, k), divisor = interval(k);
    const next = (other) => quotient(inner(first, other.slice(k - first.length).reverse()), divisor);
    const both = [next(cosine), negated(next(sine))];
    sine.push(both[0]);
    cosine.push(both[1]);
  }
  return [sine, cosine];
}
