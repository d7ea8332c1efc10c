// From JSON to a certificate: each key where the format has it, and no other.

import { parseJson } from "./json.js";
import { isLoose } from "./play.js";
import { Rational, Refusal, ZERO } from "./rational.js";

const JOINTS = { position: 3, "position-and-angle": 4, "position-and-axis": 6, pose: 6 };
const FIRST = "cuspaudit/certificate/1";
const SECOND = "cuspaudit/certificate/2";
const OPTIONAL = ["numbers", "limits", "tolerance"];
const KINDS = {
  path: ["sign", "postures", "path"],
  cusp: ["posture"],
  pairs: ["parting", "regular"],
  structure: ["theorem", "relations", "regular"],
};

/** The certificate that a text holds, well formed; throws a Refusal otherwise. */
export function readCertificate(text) {
  const json = parseJson(text);
  if (!(json instanceof Map)) refuse("certificate", "no object");
  const first = json.get("schema") === FIRST;
  if (!first && json.get("schema") !== SECOND) refuse("schema", "not one that is read here");
  const kind = first ? "path" : string(json.get("kind"), "kind");
  if (!Object.hasOwn(KINDS, kind)) refuse("kind", "not one that is proved here");
  const frame = first ? [] : ["kind"];
  const keys = ["schema", "robot", "made_by", ...frame, ...KINDS[kind]];
  const top = table(json, "certificate", keys, first ? [] : OPTIONAL);
  string(top.made_by, "made_by");
  const robot = readRobot(top.robot);
  const count = robot.joints.length;
  const { limits, tolerance } = readOptions(top, count);
  if (first && isLoose(robot)) refuse("robot", "version 1 has no loose numbers");
  const found = { kind, robot: tolerance ? withPlay(robot, tolerance) : robot, limits };
  if (kind === "path") return { ...found, ...readPath(top, robot) };
  if (kind === "cusp") return { ...found, posture: row(top.posture, count, "posture") };
  if (kind === "pairs") return { ...found, ...readPairs(top, robot) };
  return { ...found, ...readStructure(top, count) };
}

function readRobot(json) {
  const top = table(json, "robot", ["name", "task", "unit", "joints", "tool"]);
  if (!Object.hasOwn(JOINTS, string(top.task, "robot.task"))) refuse("robot.task", "unknown");
  const joints = list(top.joints, "robot.joints", readJoint);
  const tool = list(top.tool, "robot.tool", readMotion);
  if (joints.length !== JOINTS[top.task]) refuse("robot.joints", "not as many as the task takes");
  if (top.task === "position-and-axis" && (!joints.at(-1).turns || tool.length))
    refuse("robot", "the virtual joint turns, and the tip lies on it");
  const name = string(top.name, "robot.name");
  return { name, task: top.task, unit: string(top.unit, "robot.unit"), joints, tool };
}

function readJoint(json, where) {
  const top = table(json, where, ["name", "type", "axis", "before"]);
  if (top.type !== "revolute" && top.type !== "prismatic") refuse(`${where}.type`, "unknown");
  return {
    name: string(top.name, `${where}.name`),
    turns: top.type === "revolute",
    axis: direction(top.axis, `${where}.axis`),
    before: list(top.before, `${where}.before`, readMotion),
  };
}

function readMotion(json, where) {
  if (json instanceof Map && json.has("translate")) {
    const { translate } = table(json, where, ["translate"]);
    return { translate: row(translate, 3, `${where}.translate`) };
  }
  if (json instanceof Map && json.has("within")) {
    const kind = json.has("turn") ? "turn" : "slide";
    const top = table(json, where, [kind, "within"]), radius = number(top.within, `${where}.within`);
    if (radius.sign < 0) refuse(`${where}.within`, "negative");
    const play = kind === "turn" ? [ZERO, radius] : [radius, ZERO];
    return { play, axis: direction(top[kind], `${where}.${kind}`) };
  }
  const top = table(json, where, ["rotate", "angle"]);
  const angle = table(top.angle, `${where}.angle`, ["pi", "rad"]);
  return {
    rotate: direction(top.rotate, `${where}.rotate`),
    halfTurns: number(angle.pi, `${where}.angle.pi`),
    radians: number(angle.rad, `${where}.angle.rad`),
  };
}

function readOptions(top, count) {
  if (top.numbers !== undefined && !["literal", "snapped"].includes(top.numbers))
    refuse("numbers", "literal or snapped");
  const limits = top.limits === undefined ? null : list(top.limits, "limits", readInterval);
  if (limits && limits.length !== count) refuse("limits", "one a joint");
  if (limits?.at(-1) && top.robot.get("task") === "position-and-axis")
    refuse("limits", "the virtual joint has none");
  if (top.tolerance === undefined) return { limits, tolerance: null };
  const { lengths, angles } = table(top.tolerance, "tolerance", ["lengths", "angles"]);
  const radii = [number(lengths, "tolerance.lengths"), number(angles, "tolerance.angles")];
  if (radii.some((radius) => radius.sign < 0)) refuse("tolerance", "negative");
  return { limits, tolerance: radii };
}

/** Both axes of each link are off: a play at both ends. */
function withPlay(robot, play) {
  const both = (motions) => [{ play }, ...motions, { play }];
  const joints = robot.joints.map((joint) => ({ ...joint, before: both(joint.before) }));
  return { ...robot, joints, tool: both(robot.tool) };
}

function readInterval(json, where) {
  if (json === null) return null;
  const [lower, upper] = row(json, 2, where);
  if (!lower.lessThan(upper)) refuse(where, "an empty interval");
  return { lower, upper };
}

function readPath(top, robot) {
  const count = robot.joints.length;
  if (robot.task === "position-and-angle") refuse("robot.task", "a path is of another task");
  if (top.sign !== 1 && top.sign !== -1) refuse("sign", "1 or -1");
  const rows = (json, where) => list(json, where, (each, at) => row(each, count, at));
  const [postures, path] = [rows(top.postures, "postures"), rows(top.path, "path")];
  if (postures.length !== 2 || path.length < 2) refuse("path", "two postures, and way points");
  return { sign: top.sign, postures, path };
}

function readPairs(top, robot) {
  if (robot.task !== "position") refuse("robot.task", "pairs are of three joints");
  return { parting: list(top.parting, "parting", number), regular: row(top.regular, 3, "regular") };
}

function readStructure(top, count) {
  const relations = list(top.relations, "relations", (json, where) => {
    const { axes, are } = table(json, where, ["axes", "are"]);
    const numbers = list(axes, `${where}.axes`, (k) => k);
    const fit = numbers.every((k, i) => Number.isInteger(k) && k >= 1 && k <= count
      && (i === 0 || numbers[i - 1] < k));
    if (!numbers.length || !fit) refuse(`${where}.axes`, "numbers of axes, increasing");
    if (!["parallel", "square", "meeting", "level"].includes(are)) refuse(`${where}.are`, "unknown");
    return { axes: numbers, are };
  });
  const theorem = string(top.theorem, "theorem");
  return { theorem, relations, regular: row(top.regular, count, "regular") };
}

function refuse(where, why) { throw new Refusal(`${where}: ${why}`); }

function table(json, where, keys, optional = []) {
  if (!(json instanceof Map)) refuse(where, "no object");
  for (const key of keys) if (!json.has(key)) refuse(where, `the key ${key} is missing`);
  for (const key of json.keys())
    if (!keys.includes(key) && !optional.includes(key)) refuse(where, "an unknown key");
  return Object.fromEntries(json);
}

function list(json, where, read) {
  if (!Array.isArray(json)) refuse(where, "no list");
  return json.map((each, k) => read(each, `${where}[${k}]`));
}

function row(json, count, where) {
  const found = list(json, where, number);
  if (found.length !== count) refuse(where, `not ${count} numbers`);
  return found;
}

function direction(json, where) {
  const found = row(json, 3, where);
  if (found.every((x) => x.isZero)) refuse(where, "a zero axis");
  return found;
}

const number = (json, where) => Rational.parse(string(json, where), where);

function string(json, where) {
  if (typeof json !== "string") refuse(where, "no string");
  return json;
}
