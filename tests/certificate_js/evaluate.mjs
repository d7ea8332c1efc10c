// Calls of the interval arithmetic from standard input, their results to standard output.

import { readFileSync } from "node:fs";
import { pathToFileURL } from "node:url";

const folder = pathToFileURL(`${process.argv[2]}/`);
const arithmetic = await import(new URL("interval.js", folder));
const { Rational } = await import(new URL("rational.js", folder));
const { Arm } = await import(new URL("arm.js", folder));
const { readCertificate } = await import(new URL("certificate.js", folder));

const ends = ({ l, h }) => [l, h];
const interval = ([l, h]) => arithmetic.interval(l, h);
const number = (text) => Rational.parse(text, "test");
const calls = {
  sum: (a, b) => ends(arithmetic.sum(interval(a), interval(b))),
  difference: (a, b) => ends(arithmetic.difference(interval(a), interval(b))),
  product: (a, b) => ends(arithmetic.product(interval(a), interval(b))),
  quotient: (a, b) => ends(arithmetic.quotient(interval(a), interval(b))),
  sineAndCosine: (a) => arithmetic.sineAndCosine(interval(a)).map(ends),
  sineAndCosineOf: (t, r) => arithmetic.sineAndCosineOf(number(t), number(r)).map(ends),
  enclosed: (x) => ends(arithmetic.enclosed(number(x))),
  rootOf: (a) => ends(arithmetic.rootOf(interval(a))),
  pi: () => [ends(arithmetic.PI), ...arithmetic.PI_BOUNDS.map(String)],
  determinant: (text, q, terms) => {
    const arm = new Arm(readCertificate(text).robot, terms);
    return arm.determinant(q.map((jet) => jet.map(interval))).map(ends);
  },
};
const asked = JSON.parse(readFileSync(0, "utf8"));
console.log(JSON.stringify(asked.map(([name, ...values]) => calls[name](...values))));
