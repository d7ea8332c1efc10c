// Intervals [l, h] of floating-point numbers, every result rounded outwards.
//
// ECMAScript fixes + - * / on numbers as those of IEEE 754, rounded to nearest. The next
// number above a result x is at most x + ulp(x), and ulp(x) <= |x| 2^-52 or the smallest
// positive number: x + (|x| 2^-52 + smallest), rounded, is not below it, as rounding keeps
// order. So `up` of a rounded result is an upper bound of the exact one, `down` a lower.
// Math.sqrt, Math.sin, ** and their like are not fixed by the standard: no proof uses one.
//
// Overflow gives infinities and NaN. Every test below is written so that NaN fails it.

import { Rational, Refusal, ratio } from "./rational.js";

const RELATIVE = Number.EPSILON; // 2^-52
const SMALLEST = Number.MIN_VALUE;

const up = (x) => x + (Math.abs(x) * RELATIVE + SMALLEST);
const down = (x) => x - (Math.abs(x) * RELATIVE + SMALLEST);

export const interval = (l, h = l) => ({ l, h });
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
  if (isPoint(a, 1)) return b;
  if (isPoint(b, 1)) return a;
  if (isPoint(a, -1)) return negated(b);
  if (isPoint(b, -1)) return negated(a);
  if (isZero(a) || isZero(b)) return interval(0);
  const [p, q, r, s] = [a.l * b.l, a.l * b.h, a.h * b.l, a.h * b.h];
  return interval(down(Math.min(p, q, r, s)), up(Math.max(p, q, r, s)));
}

/** a / b, b without 0. */
export function quotient(a, b) {
  if (!excludesZero(b)) return interval(-Infinity, Infinity);
  return product(a, interval(down(1 / b.h), up(1 / b.l)));
}

/** The interval with ends moved outwards by r >= 0. */
export const widened = (a, r) => interval(down(a.l - r), up(a.h + r));

/** The smallest interval with floating-point ends that holds a rational number. */
export function enclosed(number) {
  if (number.isZero) return interval(0);
  if (number.n < 0n) return negated(enclosed(number.negative));
  const { n, d } = number;
  let shift = 52 - (length(n) - length(d));
  if (Math.abs(shift) > 900) throw new Refusal("a number is out of all proportion");
  const scaled = (k) => (k > 0 ? [n << BigInt(k), d] : [n, d << BigInt(-k)]);
  let [a, b] = scaled(shift);
  if (a < b << 52n) [a, b] = scaled(++shift);
  const below = a / b; // 53 bits: exact as a number, and so is its successor
  const above = below * b === a ? below : below + 1n;
  const scale = powerOfTwo(-shift);
  return interval(Number(below) * scale, Number(above) * scale);
}

/** 2^k for |k| <= 1022, exactly. */
export function powerOfTwo(k) {
  let [value, base] = [1, k < 0 ? 0.5 : 2];
  for (let rest = Math.abs(k); rest > 0; rest = Math.floor(rest / 2)) {
    if (rest % 2 === 1) value *= base;
    base *= base;
  }
  return value;
}

const length = (n) => n.toString(2).length;

/** The roots of the members of an interval that have one; NaN if that is not found. */
export function rootOf({ l, h }) {
  if (h <= 0) return interval(0);
  let [low, high] = [l > 0 ? Math.sqrt(l) : 0, Math.sqrt(h)]; // proposals, proved below
  for (let tries = 0; tries < 9 && l > 0 && !(up(low * low) <= l); tries++) low = down(low);
  for (let tries = 0; tries < 9 && !(down(high * high) >= h); tries++) high = up(high);
  const holds = (low === 0 || up(low * low) <= l) && down(high * high) >= h;
  return holds ? interval(low, high) : interval(NaN);
}

/** Rational bounds of pi, by Machin: pi = 16 atan(1/5) - 4 atan(1/239). */
function boundsOfPi() {
  const one = 1n << 160n;
  let error = 0n; // in units of 1 / one; each floor division is off by less than one
  const arctangent = (m) => {
    let total = 0n, power = one / m, k = 1n;
    for (; power > 0n; k += 2n, power /= m * m) {
      total += k % 4n === 1n ? power / k : -(power / k);
      error += 3n;
    }
    error += 3n; // the alternating rest is less than its first term
    return total;
  };
  const pi = 16n * arctangent(5n) - 4n * arctangent(239n);
  return [new Rational(pi - 16n * error, one), new Rational(pi + 16n * error, one)];
}

export const PI_BOUNDS = boundsOfPi();
export const PI = interval(enclosed(PI_BOUNDS[0]).l, enclosed(PI_BOUNDS[1]).h);
const HALF_PI = product(PI, interval(0.5));
const WHOLE = interval(-1, 1);

/** 1/k! for k = 0, ..., 20, enclosed. */
const INVERSE_FACTORIALS = [ratio(1)];
for (let k = 1; k <= 21; k++)
  INVERSE_FACTORIALS.push(INVERSE_FACTORIALS[k - 1].over(ratio(k)));
const COEFFICIENTS = INVERSE_FACTORIALS.map(enclosed);

/** Sine and cosine of every angle in an interval of radians. */
export function sineAndCosine(x) {
  const quarter = Math.round(middle(x) / 1.57);
  if (!(Math.abs(quarter) < 1048576)) return [WHOLE, WHOLE];
  const y = difference(x, product(interval(quarter), HALF_PI));
  return turnedByQuarters(nearZero(y), quarter);
}

/** Sine and cosine of an interval whose middle is within [-1, 1]; else all of [-1, 1]. */
function nearZero(y) {
  if (isZero(y)) return [interval(0), interval(1)];
  const c = middle(y);
  const r = up(Math.max(up(y.h - c), up(c - y.l)));
  if (!(Math.abs(c) <= 1 && r <= 1)) return [WHOLE, WHOLE];
  const [sine, cosine] = atPoint(c);
  // |sin(c + e) - sin c| <= |e cos c| + e^2 / 2, and likewise for the cosine
  const rest = up(up(r * r) / 2);
  const reach = (slope) => up(up(r * magnitude(slope)) + rest);
  return [clamped(widened(sine, reach(cosine))), clamped(widened(cosine, reach(sine)))];
}

const clamped = (a) => interval(Math.max(a.l, -1), Math.min(a.h, 1));

/** At one number |c| <= 1: Taylor polynomials of degree 20, remainder at most 1/21!. */
function atPoint(c) {
  const x = interval(c), square = product(x, x), minus = negated(square);
  let [odd, even] = [interval(0), COEFFICIENTS[20]];
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
  const rest = halfTurns.minus(new Rational(quarters, 2n));
  let angle = product(PI, enclosed(rest));
  if (!radians.isZero) angle = sum(angle, enclosed(radians));
  return turnedByQuarters(sineAndCosine(angle), Number(quarters % 4n));
}
