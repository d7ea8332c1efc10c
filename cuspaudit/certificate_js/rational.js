// Rational numbers n / d on BigInt, d > 0, in lowest terms; and the refusal of a proof.

/** What stops a proof: the claim is false, or could not be proved. */
export class Refusal extends Error {}
export const demand = (holds, why) => { if (!holds) throw new Refusal(why); };

const LONGEST_NUMBER = 400;

export class Rational {
  constructor(n, d = 1n) {
    if (d < 0n) [n, d] = [-n, -d];
    const g = commonDivisor(n < 0n ? -n : n, d);
    [this.n, this.d] = [n / g, d / g];
  }

  /** The number that a text of the file denotes: an integer, a decimal or p/q. */
  static parse(text, where) {
    const found = /^(-?)([0-9]+)(?:\.([0-9]+)|\/([0-9]+))?$/.exec(text);
    demand(text.length <= LONGEST_NUMBER && found, `${where}: no number of a certificate`);
    const [, sign, whole, decimals, below] = found;
    const d = below !== undefined ? BigInt(below) : 10n ** BigInt((decimals ?? "").length);
    demand(d > 0n, `${where}: a denominator is 0`);
    const n = BigInt(whole + (decimals ?? ""));
    return new Rational(sign ? -n : n, d);
  }

  get isZero() { return this.n === 0n; }
  get sign() { return this.n > 0n ? 1 : this.n < 0n ? -1 : 0; }
  get negative() { return new Rational(-this.n, this.d); }
  plus(o) { return new Rational(this.n * o.d + o.n * this.d, this.d * o.d); }
  minus(o) { return new Rational(this.n * o.d - o.n * this.d, this.d * o.d); }
  times(o) { return new Rational(this.n * o.n, this.d * o.d); }
  over(o) { return new Rational(this.n * o.d, this.d * o.n); }
  equals(o) { return this.n === o.n && this.d === o.d; }
  lessThan(o) { return this.n * o.d < o.n * this.d; }

  /** The largest integer that is not larger. */
  get floor() { return this.n / this.d - (this.n % this.d < 0n ? 1n : 0n); }

  toString() { return this.d === 1n ? `${this.n}` : `${this.n}/${this.d}`; }
}

export const ZERO = new Rational(0n);
export const ONE = new Rational(1n);
export const ratio = (n, d = 1) => new Rational(BigInt(n), BigInt(d));

function commonDivisor(a, b) {
  while (b) [a, b] = [b, a % b];
  return a;
}

/** floor(sqrt(n)) of an integer n >= 0, by Newton's rule from above. */
export function integerRoot(n) {
  let [root, next] = [n, (n + 1n) >> 1n];
  while (next < root) [root, next] = [next, (next + n / next) >> 1n];
  return root;
}
