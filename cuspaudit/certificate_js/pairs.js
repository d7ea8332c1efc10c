// kind "pairs": three joints, noncuspidal by a look at all pairs of postures of one position.
// The letters are those of docs/certificate.md.

import { Arm } from "./arm.js";
import { PI, difference, enclosed, excludesZero, interval, isPositive, magnitude, negated,
  product, quotient, rootOf, sineAndCosine, sum } from "./interval.js";
import { withoutPlay } from "./play.js";
import { Refusal } from "./rational.js";
import { areSquare, checkRegular } from "./structure.js";

const MOST_BOXES = 200000;
const NOUGHT = interval(0);
const two = (x) => product(x, interval(2));
function square(x) {
  const r = interval(magnitude(x));
  return interval(Math.max(product(x, x).l, 0), product(r, r).h);
}
const total = (...terms) => terms.reduce(sum, NOUGHT);

export function provePairs({ robot, parting, regular }) {
  if (!robot.joints.every((joint) => joint.turns)) throw new Refusal("a joint slides");
  const tilted = robot.joints[1].before.some(({ play }) => play && !play[1].isZero);
  const onALine = !tilted && areSquare(withoutPlay(robot), [1, 2]);
  const circles = valueCircles(robot, onALine);
  checkCircles(circles, onALine);
  const parts = { 1: [], "-1": [] };
  for (const number of parting) parts[-onlySign(circles, enclosed(number))].push(enclosed(number));
  const boxes = cover(circles, onALine, parts);
  checkRegular(robot, regular);
  return `noncuspidal: no two postures of one position in one aspect, in ${boxes} boxes of pairs`;
}

/** c = x + y cos t + z sin t by y and z of both entries; N by five coefficients. */
function valueCircles(robot, onALine) {
  const arm = new Arm(robot, 1), value = (jet) => jet[0] ?? NOUGHT;
  const dot = (u, v) => value(arm.dot(u, v)), less = (u, v) => u.map((x, i) => lessJet(x, v[i]));
  const [one, second, third] = arm.joints;
  const e = one.axis.n, n = arm.turn(second.before.R, second.axis.n), o = second.before.p;
  const frame = arm.then(second.before, third.before);
  const m = arm.turn(frame.R, third.axis.n);
  const g = less(frame.p, o), h = less(arm.then(frame, arm.tool).p, frame.p);
  const share = dot(m, h), still = m.map((x) => x.map((y) => product(y, share)));
  const base = g.map((x, i) => lessJet(x, still[i].map(negated))), swing = less(h, still);
  const side = arm.cross(m, h);
  const G = [sum(dot(base, base), dot(swing, swing)), two(dot(base, swing)), two(dot(base, side))];
  const A = [dot(n, base), dot(n, swing), dot(n, side)];
  const en = onALine ? NOUGHT : dot(e, n), on = dot(o, n);
  const across = difference(interval(1), square(en));       // |e'|^2
  const back = quotient(difference(dot(o, e), product(on, en)), across);
  const vn = difference(on, product(back, en));             // v . n, v = o - back e
  const v2 = total(dot(o, o), negated(two(product(back, dot(o, e)))), square(back));
  const beside = difference(v2, square(vn));                // |v'|^2
  if (!isPositive(across) || !isPositive(beside)) throw new Refusal("axes 1 and 2 may meet or be parallel");
  const length = rootOf(beside), slope = quotient(vn, length);
  const slant = quotient(en, rootOf(across));
  const [x, y, z] = A;
  return {
    first: [1, 2].map((k) => sum(quotient(G[k], two(length)), product(slope, A[k]))),
    second: onALine ? [NOUGHT, NOUGHT] : [product(slant, y), product(slant, z)],
    N: [total(G[0], negated(square(x)), negated(product(sum(square(y), square(z)), interval(0.5)))),
      difference(G[1], two(product(x, y))), difference(G[2], two(product(x, z))),
      product(difference(square(z), square(y)), interval(0.5)), negated(product(y, z))],
  };
}

const lessJet = (a, b) => (!b.length ? a : [difference(a[0] ?? NOUGHT, b[0])]);

function checkCircles({ first: [a, b], second: [x, y], N }, onALine) {
  if (!onALine) {
    if (!excludesZero(difference(product(a, y), product(b, x)))) throw new Refusal("d may be 0");
    return;
  }
  const still = difference(product(b, N[1]), product(a, N[2]));
  const moving = difference(two(product(product(a, b), N[3])), product(difference(square(a), square(b)), N[4]));
  if (!isPositive(sum(square(a), square(b)))) throw new Refusal("c may stand still");
  if (!excludesZero(still) && !excludesZero(moving)) throw new Refusal("r may be 0 for all h");
}

/** f = y cos + z sin and its derivative, at an angle with this sine and cosine. */
const wave = ([y, z], s, c) => sum(product(y, c), product(z, s));
const slopeOf = ([y, z], s, c) => difference(product(z, c), product(y, s));

function onlySign({ first, second, N }, t) {
  const [s, c] = sineAndCosine(t), [s2, c2] = sineAndCosine(two(t));
  const slope = sum(slopeOf(N.slice(1, 3), s, c), two(slopeOf(N.slice(3), s2, c2)));
  const radius = total(N[0], wave(N.slice(1, 3), s, c), wave(N.slice(3), s2, c2));
  const L = sum(square(slopeOf(first, s, c)), square(slopeOf(second, s, c)));
  if (!isPositive(difference(square(slope), product(interval(4), product(radius, L)))))
    throw new Refusal("a value of joint 3 is not proved to part aspects");
  return slope.l > 0 ? 1 : -1;
}

/** The signs that h may have at both ends of a pair with (m, h) in the box. */
function commonSigns({ first, second, N }, onALine, m, h) {
  const [s, c] = sineAndCosine(m), [s2, c2] = sineAndCosine(two(m));
  const [sigma, cos] = sineAndCosine(h), cos2 = sineAndCosine(two(h))[1];
  const S = two(total(N[0], product(wave(N.slice(1, 3), s, c), cos), product(wave(N.slice(3), s2, c2), cos2)));
  const turn = two(slopeOf(N.slice(3), s2, c2));            // N2'(m)
  const r = sum(slopeOf(N.slice(1, 3), s, c), product(cos, turn));
  const A = negated(sum(wave(N.slice(1, 3), s, c), product(interval(4), product(cos, wave(N.slice(3), s2, c2)))));
  const [a, k] = [slopeOf(first, s, c), negated(wave(first, s, c))];
  const [b, j] = [slopeOf(second, s, c), negated(wave(second, s, c))];
  const L = sum(square(a), square(b));
  const B = total(product(two(S), L), negated(square(r)), negated(square(two(product(sigma, L)))));
  if (B.h < 0) return [];
  if (onALine) {
    const reach = rootOf(two(S)).h;
    const share = excludesZero(a) ? quotient(r, a) : interval(-reach, reach);
    const even = difference(sum(two(product(cos, L)), product(share, k)), A);
    return signs(even, product(sigma, sum(two(product(k, a)), turn)));
  }
  const along = sum(product(a, k), product(b, j));
  const even = total(two(product(cos, square(L))), product(r, along), negated(product(L, A)));
  const odd = product(product(sigma, L), sum(two(along), turn));
  const d = difference(product(first[0], second[1]), product(first[1], second[0]));
  const root = product(rootOf(B), d);
  return [...signs(difference(even, root), odd), ...signs(sum(even, root), odd)];
}

function signs(even, odd) {
  const [t, w] = [difference(even, odd), negated(sum(even, odd))];
  return [1, -1].filter((sign) => !(sign > 0 ? t.h <= 0 || w.h <= 0 : t.l >= 0 || w.l >= 0));
}

/** Every box is proved, or halved; returns how many there were. */
function cover(circles, onALine, parts) {
  const turns = [-2, -1, 0, 1, 2].map((k) => two(product(PI, interval(k))));
  const apart = (m, h, sign) => {
    const [t, w, back] = [difference(m, h), sum(m, h), two(PI)];
    const values = parts[sign].flatMap((v) => turns.map((turn) => sum(v, turn)));
    return values.some((v) => t.h < v.l && v.h < w.l)
      && values.some((v) => w.h < v.l && v.h < sum(t, back).l);
  };
  const proved = (m, h) => commonSigns(circles, onALine, m, h).every((sign) => apart(m, h, sign));
  const open = [[0, 6.5, 0, 1.625]];
  for (let count = 0; open.length; ) {
    const [m0, m1, h0, h1] = open.pop();
    if (++count > MOST_BOXES) throw new Refusal("too many boxes of pairs");
    if (proved(interval(m0, m1), interval(h0, h1))) { if (!open.length) return count; continue; }
    const [m, h] = [(m0 + m1) / 2, (h0 + h1) / 2];
    if (m1 - m0 < 0.05 && !proved(interval(m), interval(h)))
      throw new Refusal(`postures near ${m - h} and ${m + h} of joint 3 are not proved to lie apart`);
    if (m1 - m0 > h1 - h0) open.push([m0, m, h0, h1], [m, m1, h0, h1]);
    else open.push([m0, m1, h0, h], [m0, m1, h, h1]);
  }
}
