// From JSON to a certificate: each key where the format has it, and no other.
// A reader takes JSON and the name of its place, and returns what it means or refuses.

import { parseJson } from "./json.js";
import { isLoose } from "./play.js";
import { Rational, Refusal, ZERO } from "./rational.js";

const refuse = (where, why) => { throw new Refusal(`${where}: ${why}`); };
const given = (json) => json;
const checked = (read, fits, why) => (json, where) => {
  const found = read(json, where);
  return fits(found) ? found : refuse(where, why);
};
const among = (...values) => checked(given, (found) => values.includes(found), "unknown");
const isObject = (json) => json !== null && typeof json === "object" && !Array.isArray(json);
const object = checked(given, isObject, "no object");
const text = checked(given, (found) => typeof found === "string", "no string");
const number = (json, where) => Rational.parse(text(json, where), where);
const listOf = (read) => (json, where) =>
  checked(given, Array.isArray, "no list")(json, where).map((each, k) => read(each, `${where}[${k}]`));
const row = (count, read = number) =>
  checked(listOf(read), (found) => found.length === count, `not ${count} entries`);
const record = (fields, optional = {}) => (json, where) => {
  for (const key of Object.keys(fields))
    if (!Object.hasOwn(object(json, where), key)) refuse(where, `the key ${key} is missing`);
  const known = { ...fields, ...optional };
  return Object.fromEntries(Object.entries(json).map(([key, each]) => {
    if (!Object.hasOwn(known, key)) refuse(where, "an unknown key");
    return [key, known[key](each, `${where}.${key}`)];
  }));
};

const direction = checked(row(3), (v) => v.some((x) => !x.isZero), "a zero axis");
const radius = checked(number, (x) => x.sign >= 0, "negative");
const MOTIONS = {
  translate: record({ translate: row(3) }),
  rotate: record({ rotate: direction, angle: record({ pi: number, rad: number }) }),
  turn: record({ turn: direction, within: radius }),
  slide: record({ slide: direction, within: radius }),
};

function motion(json, where) {
  const kind = Object.keys(MOTIONS).find((key) => Object.hasOwn(object(json, where), key));
  const found = (MOTIONS[kind] ?? refuse(where, "no motion"))(json, where);
  if (kind === "turn") return { play: [ZERO, found.within], axis: found.turn };
  return kind === "slide" ? { play: [found.within, ZERO], axis: found.slide } : found;
}

const joint = record({
  name: text, type: among("revolute", "prismatic"), axis: direction, before: listOf(motion) });
const JOINTS = { position: 3, "position-and-angle": 4, "position-and-axis": 6, pose: 6 };
const ROBOT = record({
  name: text, task: among(...Object.keys(JOINTS)), unit: text, joints: listOf(joint), tool: listOf(motion) });

function readRobot(json) {
  const robot = ROBOT(json, "robot");
  const joints = robot.joints.map((each) => ({ ...each, turns: each.type === "revolute" }));
  if (joints.length !== JOINTS[robot.task]) refuse("robot.joints", "not as many as the task takes");
  if (robot.task === "position-and-axis" && (!joints.at(-1).turns || robot.tool.length))
    refuse("robot", "the virtual joint turns, and the tip lies on it");
  return { ...robot, joints };
}

const areAxes = (count) => (found) => found.length > 0 && found.every((k, i) =>
  Number.isInteger(k) && k <= count && k > (i ? found[i - 1] : 0));
const relation = (count) => record({ are: among("parallel", "square", "meeting", "level"),
  axes: checked(listOf(given), areAxes(count), "numbers of axes, increasing") });
const PATHS = ["position", "pose", "position-and-axis"];

/** By kind: the tasks, and the keys for so many joints. */
const KINDS = {
  path: [PATHS, (count) => ({
    sign: among(1, -1), postures: row(2, row(count)),
    path: checked(listOf(row(count)), (found) => found.length > 1, "fewer than two way points") })],
  cusp: [PATHS, (count) => ({ posture: row(count) })],
  pairs: [["position"], (count) => ({ parting: listOf(number), regular: row(count) })],
  structure: [Object.keys(JOINTS), (count) => ({
    theorem: text, relations: listOf(relation(count)), regular: row(count) })],
};

const range = checked(row(2), ([lower, upper]) => lower.lessThan(upper), "an empty interval");
const options = (count) => ({
  numbers: among("literal", "snapped"),
  limits: row(count, (json, where) => (json === null ? null : range(json, where))),
  tolerance: record({ lengths: radius, angles: radius }),
});

/** The certificate that a text holds, well formed; throws as parseJson otherwise. */
export function readCertificate(source) {
  const json = object(parseJson(source), "certificate");
  const first = json.schema === "cuspaudit/certificate/1", kind = first ? "path" : json.kind;
  if (!first && json.schema !== "cuspaudit/certificate/2") refuse("schema", "not one that is read here");
  if (!Object.hasOwn(KINDS, kind)) refuse("kind", "not one that is proved here");
  const robot = readRobot(json.robot), count = robot.joints.length, [tasks, keys] = KINDS[kind];
  if (!tasks.includes(robot.task)) refuse("robot.task", `a ${kind} is of another task`);
  if (first && isLoose(robot)) refuse("robot", "version 1 has no loose numbers");
  const every = { schema: text, robot: () => robot, made_by: text, ...keys(count) };
  const read = first ? record(every) : record({ ...every, kind: text }, options(count));
  const found = read(json, "certificate");
  if (found.limits?.at(-1) && robot.task === "position-and-axis")
    refuse("limits", "the virtual joint has none");
  return { ...found, kind, robot: found.tolerance ? withPlay(robot, found.tolerance) : robot };
}

/** Both axes of each link are off: a play at both ends. */
function withPlay(robot, { lengths, angles }) {
  const both = (motions) => [{ play: [lengths, angles] }, ...motions, { play: [lengths, angles] }];
  const joints = robot.joints.map((each) => ({ ...each, before: both(each.before) }));
  return { ...robot, joints, tool: both(robot.tool) };
}
