// kind "pairs": three joints, noncuspidal by a look at all pairs of postures of one position.
// The letters are those of docs/certificate.md.

import { Arm, less, sumOf } from "./arm.js";
import { cover } from "./boxes.js";
import { NOUGHT, PI, around, difference, enclosed, excludesZero, inner, interval, isPositive,
  middle, negated, product, quotient, rootOf, scaled, sineAndCosine, square, sum, total } from "./interval.js";
import { value } from "./jet.js";
import { withoutPlay } from "./play.js";
import { demand } from "./rational.js";
import { areSquare, checkRegular } from "./structure.js";

const MOST_BOXES = 200000;
const two = (x) => scaled(2, x);

export function provePairs({ robot, parting, regular }) {
  demand(robot.joints.every((joint) => joint.turns), "a joint slides");
  const tilted = robot.joints[1].before.some(({ play }) => play && !play[1].isZero);
  const onALine = !tilted && areSquare(withoutPlay(robot), [1, 2]);
  const circles = valueCircles(robot, onALine);
  checkCircles(circles, onALine);
  const parts = { 1: [], "-1": [] };
  for (const number of parting) parts[-onlySign(circles, enclosed(number))].push(enclosed(number));
  const whole = [interval(0, 6.5), interval(0, 1.625)]; // [0, 2 pi] and [0, pi / 2]
  const boxes = cover(whole, lieApart(circles, onALine, parts), MOST_BOXES);
  checkRegular(robot, regular);
  return `noncuspidal: no two postures of one position in one aspect, in ${boxes} boxes of pairs`;
}

/** c = x + y cos t + z sin t by y and z of both entries; N by five coefficients. */
function valueCircles(robot, onALine) {
  const arm = new Arm(robot, 1), dot = (u, v) => value(arm.dot(u, v));
  const before = (k) => arm.fixed(robot.joints[k].before), [one, second, third] = arm.joints;
  const e = one.axis.n, { R, p: o } = before(1), n = arm.turn(R, second.axis.n);
  const frame = arm.then(before(1), before(2)), m = arm.turn(frame.R, third.axis.n);
  const g = less(frame.p, o), h = less(arm.then(frame, arm.fixed(robot.tool)).p, frame.p);
  const still = arm.stretched(m, arm.dot(m, h));
  const base = sumOf(g, still), swing = less(h, still), side = arm.cross(m, h);
  const G = [sum(dot(base, base), dot(swing, swing)), two(dot(base, swing)), two(dot(base, side))];
  const [x, y, z] = [dot(n, base), dot(n, swing), dot(n, side)];
  const en = onALine ? NOUGHT : dot(e, n), on = dot(o, n);
  const across = difference(interval(1), square(en));       // |e'|^2
  const back = quotient(difference(dot(o, e), product(on, en)), across);
  const vn = difference(on, product(back, en));             // v . n, v = o - back e
  const v2 = total([dot(o, o), negated(two(product(back, dot(o, e)))), square(back)]);
  const beside = difference(v2, square(vn));                // |v'|^2
  demand(isPositive(across) && isPositive(beside), "axes 1 and 2 may meet or be parallel");
  const length = rootOf(beside), slope = quotient(vn, length), slant = quotient(en, rootOf(across));
  return {
    first: [y, z].map((w, k) => sum(quotient(G[k + 1], two(length)), product(slope, w))),
    second: onALine ? [NOUGHT, NOUGHT] : [product(slant, y), product(slant, z)],
    N: [difference(G[0], sum(square(x), scaled(0.5, sum(square(y), square(z))))),
      difference(G[1], two(product(x, y))), difference(G[2], two(product(x, z))),
      scaled(0.5, difference(square(z), square(y))), negated(product(y, z))],
  };
}

/** Twice the area of two vectors of a plane. */
const area = ([a, b], [x, y]) => difference(product(a, y), product(b, x));

function checkCircles({ first, second, N }, onALine) {
  if (!onALine) return demand(excludesZero(area(first, second)), "d may be 0");
  const [a, b] = first.map(square), moving = [two(product(...first)), difference(a, b)];
  demand(isPositive(sum(a, b)), "c may stand still");
  const parts = [area(first, N.slice(1, 3)), area(moving, [N[4], N[3]])];
  return demand(parts.some(excludesZero), "r may be 0 for all u");
}

/** f = y cos + z sin at an angle t with this sine and cosine, f' and f''. */
const wave = ([y, z], [s, c]) => {
  const f = inner([y, z], [c, s]);
  return [f, inner([z, negated(y)], [c, s]), negated(f)];
};

/** The two parts of N at t, each with two derivatives. */
function wavesOf(N, t) {
  const [f, slope, bend] = wave(N.slice(3), sineAndCosine(two(t)));
  return [wave(N.slice(1, 3), sineAndCosine(t)), [f, two(slope), scaled(4, bend)]];
}

function onlySign({ first, second, N }, t) {
  const [one, double] = wavesOf(N, t), slope = sum(one[1], double[1]);
  const L = total([first, second].map((entry) => square(wave(entry, sineAndCosine(t))[1])));
  const room = difference(square(slope), scaled(4, product(total([N[0], one[0], double[0]]), L)));
  demand(isPositive(room), "a value of joint 3 is not proved to part aspects");
  return slope.l > 0 ? 1 : -1;
}

/** The signs that h may have at both ends of a pair with (m, u) in the box. */
function commonSigns({ first, second, N }, onALine, m, u) {
  const [one, double] = wavesOf(N, m), [sine, cos] = sineAndCosine(u), [, cos2] = sineAndCosine(two(u));
  const S = two(total([N[0], product(one[0], cos), product(double[0], cos2)])); // N(t) + N(w)
  const [r, A] = [1, 2].map((k) => sum(one[k], product(cos, double[k])));
  const [[, a, k], [, b, j]] = [first, second].map((entry) => wave(entry, sineAndCosine(m)));
  const L = sum(square(a), square(b)), along = inner([a, b], [k, j]);
  const B = difference(product(two(S), L), sum(square(r), square(two(product(sine, L)))));
  if (B.h < 0) return [];
  const turn = sum(two(along), double[1]);
  if (onALine) {
    const reach = rootOf(two(S)).h, share = excludesZero(a) ? quotient(r, a) : around(reach);
    const even = difference(inner([two(cos), share], [L, k]), A);
    return signs(even, product(sine, turn));
  }
  const even = difference(inner([two(cos), r], [square(L), along]), product(L, A));
  const odd = product(product(sine, L), turn), root = product(rootOf(B), area(first, second));
  return [...signs(difference(even, root), odd), ...signs(sum(even, root), odd)];
}

function signs(even, odd) {
  const [t, w] = [difference(even, odd), negated(sum(even, odd))];
  return [1, -1].filter((sign) => !(sign > 0 ? t.h <= 0 || w.h <= 0 : t.l >= 0 || w.l >= 0));
}

/** Whether in a box of (m, u) no pair of postures is in one aspect. */
function lieApart(circles, onALine, parts) {
  const turns = [-2, -1, 0, 1, 2].map((k) => scaled(2 * k, PI));
  const apart = (m, u, sign) => {
    const [t, w] = [difference(m, u), sum(m, u)];
    const values = parts[sign].flatMap((v) => turns.map((turn) => sum(v, turn)));
    return values.some((v) => t.h < v.l && v.h < w.l)
      && values.some((v) => w.h < v.l && v.h < sum(t, scaled(2, PI)).l);
  };
  const proved = ([m, u]) => commonSigns(circles, onALine, m, u).every((sign) => apart(m, u, sign));
  return (box) => {
    if (proved(box)) return true;
    const [m, u] = box.map(middle);
    const hope = box[0].h - box[0].l >= 0.05 || proved([interval(m), interval(u)]);
    demand(hope, `postures near ${m - u} and ${m + u} of joint 3 are not proved to lie apart`);
    return false;
  };
}
