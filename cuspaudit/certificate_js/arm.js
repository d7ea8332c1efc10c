// The arm of a certificate: frames, screws and det J, entries of which are jets.
// A frame is {R, p}: R by rows. The screw of a joint is {w, m}: at unit speed the arm
// beyond turns with w, and the point that passes through the origin moves with m.

import { transposed } from "./boxes.js";
import { around, difference, enclosed, interval, quotient, rootOf, scaled, sineAndCosine,
  sineAndCosineOf, square } from "./interval.js";
import { UNIT, constant, minus, plus, times, trigonometric } from "./jet.js";
import { ONE, ZERO } from "./rational.js";

const AXES = [0, 1, 2], NONE = [[], [], []];
export const STILL = { R: AXES.map((i) => AXES.map((j) => (i === j ? UNIT : []))), p: NONE };

export const sumOf = (u, v) => u.map((x, i) => plus(x, v[i]));
export const less = (u, v) => sumOf(u, v.map(minus));

export class Arm {
  /** @param robot as read; @param terms that a jet may have */
  constructor(robot, terms) {
    this.terms = terms;
    this.joints = robot.joints.map(({ turns, axis }) => ({ turns, axis: unit(axis) }));
    this.links = [...robot.joints.map((joint) => joint.before), robot.tool].map((motions) =>
      this.pieces(motions));
  }

  /** Motions in a row as fixed pieces and plays, each with its inverse. */
  pieces(motions) {
    const found = [];
    for (const each of motions) {
      const [motion, last] = [this.motion(each), found.at(-1)];
      if (each.play || !last || last.play) found.push({ motion, play: each.play && most(each) });
      else last.motion = this.then(last.motion, motion);
    }
    return found.map((piece) => ({ ...piece, undone: this.undo(piece.motion) }));
  }

  dot(u, v) {
    return AXES.reduce((total, i) => plus(total, times(u[i], v[i], this.terms)), []);
  }

  cross(u, v) {
    return AXES.map((i) => {
      const [j, k] = [(i + 1) % 3, (i + 2) % 3];
      return plus(times(u[j], v[k], this.terms), minus(times(u[k], v[j], this.terms)));
    });
  }

  turn(R, v) { return R.map((row) => this.dot(row, v)); }

  /** First the motion g in the frame f: the product f g. */
  then(f, g) {
    const columns = AXES.map((j) => this.turn(f.R, g.R.map((row) => row[j])));
    return { R: transposed(columns), p: sumOf(f.p, this.turn(f.R, g.p)) };
  }

  undo(f) {
    const R = transposed(f.R);
    return { R, p: this.turn(R, f.p).map(minus) };
  }

  /** The product of the fixed motions of the file. */
  fixed(motions) {
    return motions.reduce((f, motion) => this.then(f, this.motion(motion)), STILL);
  }

  /** All motions of a play: a turn of at most a moves unit vectors by at most a. */
  loose({ play, axis }) {
    const [way, off] = play.map((radius) => around(enclosed(radius).h));
    if (axis) {
      const { R } = this.rotated(unit(axis), ...sineAndCosine(off).map(constant));
      return { R, p: this.stretched(unit(axis).n, constant(way)) };
    }
    const on = interval(difference(interval(1), scaled(0.5, square(off))).l, 1);
    const R = AXES.map((i) => AXES.map((j) => constant(i === j ? on : off)));
    return { R, p: AXES.map(() => constant(way)) };
  }

  motion(motion) {
    if (motion.play) return this.loose(motion);
    if (motion.translate) return { R: STILL.R, p: motion.translate.map(number) };
    const { rotate, angle } = motion;
    return this.rotated(unit(rotate), ...sineAndCosineOf(angle.pi, angle.rad).map(constant));
  }

  /** R = n n^T + cos (1 - n n^T) + sin [n]x */
  rotated({ n, along, across }, sine, cosine) {
    const R = AXES.map((i) => AXES.map((j) => {
      const k = 3 - i - j;
      const side = i === j ? [] : (j - i + 3) % 3 === 1 ? minus(n[k]) : n[k];
      const cosines = plus(along[i][j], times(across[i][j], cosine, this.terms));
      return plus(cosines, times(side, sine, this.terms));
    }));
    return { R, p: NONE };
  }

  stretched(n, factor) { return n.map((x) => times(x, factor, this.terms)); }

  /** The motion of a joint by the jet q, or by -q. */
  moved({ turns, axis }, q, backwards) {
    if (!turns) return { R: STILL.R, p: this.stretched(axis.n, backwards ? minus(q) : q) };
    const [sine, cosine] = trigonometric(q, this.terms);
    return this.rotated(axis, backwards ? minus(sine) : sine, cosine);
  }

  screw({ turns, axis }, frame) {
    const n = this.turn(frame.R, axis.n);
    return turns ? { w: n, m: this.cross(frame.p, n) } : { w: NONE, m: n };
  }

  /** From the link before joint k both ways, in its coordinates: the screws, the places of play,
   *  and the frames of the base (beyond what comes before joint 0), of the last link, of the tip. */
  walk(k, q) {
    const count = this.joints.length, screws = [], places = [];
    let frame = STILL, hand = STILL;
    const pass = (i, backwards) => {
      screws[i] = this.screw(this.joints[i], frame);
      frame = this.then(frame, this.moved(this.joints[i], q[i], backwards));
    };
    const passOn = (link, at, backwards) => {
      const { play, motion, undone } = this.links[link][at], near = frame;
      frame = this.then(frame, backwards ? undone : motion);
      const [R, o] = backwards ? [frame.R, near.p] : [near.R, frame.p];
      if (play) places.push({ play, key: `${link} ${at}`, link, R, o });
    };
    for (let i = k - 1; i >= 0; i--) {
      pass(i, true);
      for (let at = this.links[i].length - 1; i && at >= 0; at--) passOn(i, at, true);
    }
    const base = frame;
    frame = STILL;
    for (let i = k; i <= count; i++) {
      if (i === count) hand = frame;
      for (let at = 0; i && at < this.links[i].length; at++) passOn(i, at, false);
      if (i < count) pass(i, false);
    }
    return { screws, places, base, hand, tip: frame };
  }

  /** Velocity m + w x p of the point of a screw that passes through p. */
  velocity({ w, m }, p) { return sumOf(m, this.cross(w, p)); }

  /** The walk from the link in whose coordinates det J is short. */
  fromHome(q) { return this.walk({ 3: 1, 4: 0, 6: 3 }[q.length], q); }

  determinant(q) { return this.det(this.columns(q)); }

  /** The columns of J: of 3 joints (position), 4 (position and angle) or 6 (pose). */
  columns(q, { screws, tip } = this.fromHome(q)) {
    if (screws.length === 6) return screws.map(({ w, m }) => [...m, ...w]);
    const columns = screws.map((screw) => this.velocity(screw, tip.p));
    if (screws.length === 3) return columns;
    const last = screws[this.joints.findLastIndex((joint) => joint.turns)];
    return columns.map((column, k) => [...column, last ? this.dot(screws[k].w, last.w) : []]);
  }

  /** Determinant of a matrix by columns, by Laplace: minors of the two halves of the columns. */
  det(columns) {
    const half = columns.length >> 1, every = (1 << columns.length) - 1, upper = (1 << half) - 1;
    const [first, last] = [this.minors(columns.slice(0, half)), this.minors(columns.slice(half))];
    return [...first].reduce((total, [rows, minor]) => {
      const term = times(minor, last.get(every ^ rows) ?? [], this.terms);
      // the sign is that of the sum of the rows' numbers, less that of the upper rows
      return plus(total, bits((rows ^ upper) & 0b101010) % 2 ? minus(term) : term);
    }, []);
  }

  /** Minors of all these columns, by sets of as many rows. */
  minors(columns) {
    return columns.reduce((minors, column) => {
      const next = new Map();
      for (const [rows, minor] of minors)
        column.forEach((entry, i) => {
          if (rows & (1 << i) || !entry.length) return;
          // the entry moves past the rows of the set that come after its own
          const term = times(minor, entry, this.terms), key = rows | (1 << i);
          next.set(key, plus(next.get(key) ?? [], bits(rows >> (i + 1)) % 2 ? minus(term) : term));
        });
      return next;
    }, new Map([[0, UNIT]]));
  }
}

const bits = (set) => { let n = 0; for (; set; set &= set - 1) n++; return n; };
const number = (x) => constant(enclosed(x));

/** The most that a play moves and turns, and the axis of one that has one. */
const most = ({ play: [lengths, angles], axis }) =>
  ({ lengths: enclosed(lengths).h, angles: enclosed(angles).h, axis: axis && unit(axis).n });

/** The unit vector n along v with n n^T and 1 - n n^T, the last two exact before rounding. */
function unit(v) {
  const square = v.reduce((total, x) => total.plus(x.times(x)), ZERO);
  const single = v.filter((x) => !x.isZero).length === 1;
  const length = single ? null : rootOf(enclosed(square));
  const n = v.map((x) => constant(single ? interval(x.sign) : quotient(enclosed(x), length)));
  const along = v.map((x) => v.map((y) => x.times(y).over(square)));
  const across = along.map((row, i) => row.map((x, j) => number(i === j ? ONE.minus(x) : x.negative)));
  return { n, along: along.map((row) => row.map(number)), across };
}
