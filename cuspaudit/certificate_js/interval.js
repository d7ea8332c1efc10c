// Intervals [l, h] of floating-point numbers, every result rounded outwards.
// ECMAScript fixes + - * / on numbers as those of IEEE 754, rounded to nearest. The next
// number above a result x is at most x + ulp(x), and ulp(x) <= |x| 2^-52 or the smallest
// positive number; rounding keeps order. So `up` of a rounded result is an upper bound of
// the exact one, `down` a lower. Math.sqrt, Math.sin, ** are not fixed: no proof uses one.
// Overflow gives infinities and NaN. Every test below is written so that NaN fails it.

import { Rational, demand, ratio } from "./rational.js";

const up = (x) => x + (Math.abs(x) * Number.EPSILON + Number.MIN_VALUE); // 2^-52, smallest
const down = (x) => -up(-x);

export const interval = (l, h = l) => ({ l, h });
export const NOUGHT = interval(0);
export const around = (r) => interval(-r, r);
const isPoint = (a, x) => a.l === x && a.h === x;
export const isZero = (a) => a.l === 0 && a.h === 0;
export const isPositive = (a) => a.l > 0 && a.h >= a.l;
export const excludesZero = (a) => isPositive(a) || (a.h < 0 && a.l <= a.h);
export const middle = (a) => (a.l + a.h) / 2;

/** The largest absolute value, an upper bound. */
export const magnitude = (a) => Math.max(Math.abs(a.l), Math.abs(a.h));

export const negated = (a) => interval(-a.h, -a.l);

export function sum(a, b) {
  if (isZero(a)) return b;
  if (isZero(b)) return a;
  return interval(down(a.l + b.l), up(a.h + b.h));
}

export const difference = (a, b) => sum(a, negated(b));

export function product(a, b) {
  if (isPoint(b, 1) || isPoint(b, -1)) [a, b] = [b, a];
  if (isPoint(a, 1) || isPoint(a, -1)) return a.l > 0 ? b : negated(b);
  if (isZero(a) || isZero(b)) return NOUGHT;
  const [p, q, r, s] = [a.l * b.l, a.l * b.h, a.h * b.l, a.h * b.h];
  return interval(down(Math.min(p, q, r, s)), up(Math.max(p, q, r, s)));
}

/** a / b, b without 0. */
export function quotient(a, b) {
  if (!excludesZero(b)) return interval(-Infinity, Infinity);
  return product(a, interval(down(1 / b.h), up(1 / b.l)));
}

/** The sum of many, k times an interval, and the sum of products of two rows. */
export const total = (terms) => terms.reduce(sum, NOUGHT);
export const scaled = (k, a) => product(interval(k), a);
export const inner = (u, v) => total(u.map((x, i) => product(x, v[i])));

/** The squares of the members. */
export function square(a) {
  const r = interval(magnitude(a));
  return interval(Math.max(product(a, a).l, 0), product(r, r).h);
}

/** The interval with ends moved outwards by r >= 0. */
export const widened = (a, r) => interval(down(a.l - r), up(a.h + r));

/** The smallest interval with floating-point ends that holds a rational number. */
export function enclosed(number) {
  if (number.isZero) return NOUGHT;
  if (number.n < 0n) return negated(enclosed(number.negative));
  const { n, d } = number;
  let shift = 52 - (length(n) - length(d));
  demand(Math.abs(shift) <= 900, "a number is out of all proportion");
  const scaled = (k) => (k > 0 ? [n << BigInt(k), d] : [n, d << BigInt(-k)]);
  let [a, b] = scaled(shift);
  if (a < b << 52n) [a, b] = scaled(++shift);
  const below = a / b; // 53 bits: exact as a number, and so is its successor
  const above = below * b === a ? below : below + 1n;
  const scale = powerOfTwo(-shift);
  return interval(Number(below) * scale, Number(above) * scale);
}

/** 2^k for |k| <= 1022: all factors and products are powers of two, so exact. */
export function powerOfTwo(k) {
  if (k === 0) return 1;
  const half = powerOfTwo(Math.trunc(k / 2));
  return half * half * (k % 2 === 0 ? 1 : k < 0 ? 0.5 : 2);
}

const length = (n) => n.toString(2).length;

/** The roots of the members of an interval that have one; NaN if that is not found. */
export function rootOf({ l, h }) {
  if (h <= 0) return NOUGHT;
  const low = l > 0 ? down(down(Math.sqrt(l))) : 0, high = up(up(Math.sqrt(h))); // proved now
  return (low === 0 || up(low * low) <= l) && down(high * high) >= h ? interval(low, high) : interval(NaN);
}

/** Pi lies between these two: 3.14159 26535 89793 23846 26433 83279 50288 41971 69399 ... */
export const PI_BOUNDS = ["69", "70"].map((last) =>
  Rational.parse(`3.1415926535897932384626433832795028841971${last}`, "pi"));
export const PI = interval(enclosed(PI_BOUNDS[0]).l, enclosed(PI_BOUNDS[1]).h);
const HALF_PI = scaled(0.5, PI), WHOLE = around(1);

/** 1/k! for k = 0, ..., 21, enclosed. */
const inverseFactorial = (k) => (k ? inverseFactorial(k - 1).over(ratio(k)) : ratio(1));
const COEFFICIENTS = Array.from({ length: 22 }, (_, k) => enclosed(inverseFactorial(k)));

/** Sine and cosine of every angle in an interval of radians. */
export function sineAndCosine(x) {
  const quarter = Math.round(middle(x) / 1.57);
  if (!(Math.abs(quarter) < 1048576)) return [WHOLE, WHOLE];
  return turnedByQuarters(nearZero(difference(x, scaled(quarter, HALF_PI))), quarter);
}

/** Sine and cosine of an interval whose middle is within [-1, 1]; else all of [-1, 1]. */
function nearZero(y) {
  if (isZero(y)) return [NOUGHT, interval(1)];
  const c = middle(y);
  const r = up(Math.max(up(y.h - c), up(c - y.l)));
  if (!(Math.abs(c) <= 1 && r <= 1)) return [WHOLE, WHOLE];
  const [sine, cosine] = atPoint(c);
  // |sin(c + e) - sin c| <= |e cos c| + e^2 / 2, and likewise for the cosine
  const reach = (slope) => up(up(r * magnitude(slope)) + up(up(r * r) / 2));
  return [clamped(widened(sine, reach(cosine))), clamped(widened(cosine, reach(sine)))];
}

const clamped = (a) => interval(Math.max(a.l, -1), Math.min(a.h, 1));

/** At one number |c| <= 1: Taylor polynomials of degree 20, remainder at most 1/21!. */
function atPoint(c) {
  const x = interval(c), square = product(x, x), minus = negated(square);
  let [odd, even] = [NOUGHT, COEFFICIENTS[20]];
  for (let k = 19; k >= 1; k -= 2) {
    odd = sum(COEFFICIENTS[k], product(minus, odd));
    even = sum(COEFFICIENTS[k - 1], product(minus, even));
  }
  const remainder = COEFFICIENTS[21].h;
  return [widened(product(x, odd), remainder), widened(even, remainder)];
}

function turnedByQuarters([sine, cosine], quarters) {
  const cycle = [sine, cosine, negated(sine), negated(cosine)], k = ((quarters % 4) + 4) % 4;
  return [cycle[k], cycle[(k + 1) % 4]];
}

/** Sine and cosine of halfTurns pi + radians; exact at right angles. */
export function sineAndCosineOf(halfTurns, radians) {
  const quarters = halfTurns.times(ratio(2)).plus(ratio(1, 2)).floor; // nearest
  const rest = enclosed(halfTurns.minus(new Rational(quarters, 2n)));
  const angle = sum(product(PI, rest), enclosed(radians));
  return turnedByQuarters(sineAndCosine(angle), Number(quarters % 4n));
}
