// The arm of a certificate: frames, screws and det J, entries of which are jets.
//
// A frame is {R, p}: R by rows. The screw of a joint is {w, m}: at unit speed the arm
// beyond turns with w, and the point that passes through the origin moves with m.

import { difference, enclosed, interval, product, quotient, rootOf, sineAndCosine, sineAndCosineOf }
  from "./interval.js";
import { UNIT, constant, minus, plus, times, trigonometric } from "./jet.js";
import { ONE, ZERO } from "./rational.js";

const AXES = [0, 1, 2], ONE_POINT = interval(1), HALF = interval(0.5);
export const STILL = { R: AXES.map((i) => AXES.map((j) => (i === j ? UNIT : []))), p: [[], [], []] };

export class Arm {
  /** @param robot as read; @param terms that a jet may have */
  constructor(robot, terms) {
    this.terms = terms;
    this.joints = robot.joints.map((joint) => {
      const before = this.fixed(joint.before);
      return { turns: joint.turns, axis: unit(joint.axis), before, undone: this.undo(before) };
    });
    this.tool = this.fixed(robot.tool);
    this.links = [...robot.joints.map((joint) => joint.before), robot.tool].map((motions) =>
      motions.map((each) => this.step(each)));
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
    const shift = this.turn(f.R, g.p);
    return { R: transposed(columns), p: AXES.map((i) => plus(f.p[i], shift[i])) };
  }

  undo(f) {
    const R = transposed(f.R);
    return { R, p: this.turn(R, f.p).map(minus) };
  }

  /** The product of the fixed motions of the file. */
  fixed(motions) {
    return motions.reduce((f, motion) => this.then(f, this.motion(motion)), STILL);
  }

  /** A fixed motion, or play with what it may be: {lengths, angles} and the axis of one number. */
  step(each) {
    const motion = this.motion(each), undone = this.undo(motion);
    if (!each.play) return { motion, undone };
    const [lengths, angles] = each.play.map((radius) => enclosed(radius).h);
    return { motion, undone, play: { lengths, angles, axis: each.axis && unit(each.axis).n } };
  }

  /** All motions of a play: a turn of at most a moves unit vectors by at most a. */
  loose({ play, axis }) {
    const [way, off] = play.map((radius) => { const { h } = enclosed(radius); return interval(-h, h); });
    const on = interval(difference(ONE_POINT, product(product(off, off), HALF)).l, 1);
    if (!axis)
      return { R: AXES.map((i) => AXES.map((j) => (i === j ? [on] : constant(off)))), p: AXES.map(() => constant(way)) };
    const { n } = unit(axis), [s, c] = sineAndCosine(off).map(constant);
    return { R: this.rotation(unit(axis), s, c), p: n.map((x) => times(x, constant(way), this.terms)) };
  }

  motion(motion) {
    if (motion.play) return this.loose(motion);
    if (motion.translate) return { R: STILL.R, p: motion.translate.map(number) };
    const [s, c] = sineAndCosineOf(motion.halfTurns, motion.radians).map(constant);
    return { R: this.rotation(unit(motion.rotate), s, c), p: STILL.p };
  }

  /** n n^T + cos (1 - n n^T) + sin [n]x */
  rotation({ n, along, across }, sine, cosine) {
    return AXES.map((i) => AXES.map((j) => {
      const k = 3 - i - j;
      const side = i === j ? [] : (j - i + 3) % 3 === 1 ? minus(n[k]) : n[k];
      const mixed = plus(times(across[i][j], cosine, this.terms), times(side, sine, this.terms));
      return plus(along[i][j], mixed);
    }));
  }

  /** The motion of a joint by the jet q, or by -q. */
  moved(joint, q, backwards) {
    if (!joint.turns) {
      const step = backwards ? minus(q) : q;
      return { R: STILL.R, p: joint.axis.n.map((x) => times(x, step, this.terms)) };
    }
    const [sine, cosine] = trigonometric(q, this.terms);
    return { R: this.rotation(joint.axis, backwards ? minus(sine) : sine, cosine), p: STILL.p };
  }

  screw(joint, frame) {
    const n = this.turn(frame.R, joint.axis.n);
    return joint.turns ? { w: n, m: this.cross(frame.p, n) } : { w: [[], [], []], m: n };
  }

  /** Screws of the joints after link `from` and the tip, in the coordinates of that link. */
  outward(from, q) {
    let frame = STILL;
    const screws = this.joints.slice(from).map((joint, k) => {
      frame = this.then(frame, joint.before);
      const screw = this.screw(joint, frame);
      frame = this.then(frame, this.moved(joint, q[from + k], false));
      return screw;
    });
    return { screws, tip: this.then(frame, this.tool) };
  }

  /** Screws of the joints up to link `to`, in the coordinates of that link. */
  inward(to, q) {
    let frame = STILL;
    const screws = [];
    for (let k = to - 1; k >= 0; k--) {
      const joint = this.joints[k];
      screws.unshift(this.screw(joint, frame));
      if (k) frame = this.then(this.then(frame, this.moved(joint, q[k], true)), joint.undone);
    }
    return screws;
  }

  /** Velocity m + w x p of the point of a screw that passes through p. */
  velocity({ w, m }, p) {
    const swing = this.cross(w, p);
    return AXES.map((i) => plus(m[i], swing[i]));
  }

  determinant(q) { return this.det(this.columns(q)); }

  /** The columns of J: of 3 joints (position), 4 (position and angle) or 6 (pose). */
  columns(q) {
    const count = this.joints.length;
    const link = count === 6 ? 3 : count === 3 ? 1 : 0;
    const { screws, tip } = this.outward(link, q);
    const all = [...this.inward(link, q), ...screws];
    if (count === 6) return all.map(({ w, m }) => [...m, ...w]);
    const columns = all.map((screw) => this.velocity(screw, tip.p));
    if (count === 4) {
      const last = all[this.joints.map((joint) => joint.turns).lastIndexOf(true)];
      columns.forEach((column, k) => column.push(last ? this.dot(all[k].w, last.w) : []));
    }
    return columns;
  }

  /** Determinant of a matrix by columns, by Laplace: minors of the two halves of the columns. */
  det(columns) {
    const half = columns.length >> 1, every = (1 << columns.length) - 1;
    const [first, last] = [this.minors(columns.slice(0, half)), this.minors(columns.slice(half))];
    return [...first].reduce((total, [rows, minor]) => {
      const term = times(minor, last.get(every ^ rows) ?? [], this.terms);
      return plus(total, inversions(rows) % 2 ? minus(term) : term);
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
          const passed = bits(rows >> (i + 1));
          const term = times(minor, entry, this.terms);
          const key = rows | (1 << i);
          next.set(key, plus(next.get(key) ?? [], passed % 2 ? minus(term) : term));
        });
      return next;
    }, new Map([[0, UNIT]]));
  }
}

/** How many rows outside the set stand before rows of it. */
const inversions = (rows) => {
  let [before, total] = [0, 0];
  for (let set = rows; set; set >>= 1) if (set & 1) total += before; else before++;
  return total;
};
const bits = (set) => { let n = 0; for (; set; set &= set - 1) n++; return n; };
const number = (x) => constant(enclosed(x));
const transposed = (R) => AXES.map((j) => R.map((row) => row[j]));

/** The unit vector n along v with n n^T and 1 - n n^T, the last two exact before rounding. */
function unit(v) {
  const square = v.reduce((total, x) => total.plus(x.times(x)), ZERO);
  const single = v.filter((x) => !x.isZero).length === 1;
  const length = single ? null : rootOf(enclosed(square));
  const n = v.map((x) => constant(single ? interval(x.sign) : quotient(enclosed(x), length)));
  const along = v.map((x) => v.map((y) => x.times(y).over(square)));
  const across = along.map((row, i) => row.map((x, j) => number(
    i === j ? ONE.minus(x) : x.negative)));
  return { n, along: along.map((row) => row.map(number)), across };
}
