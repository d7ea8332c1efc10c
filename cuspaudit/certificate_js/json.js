// JSON, strictly: JSON.parse would keep the second of two equal keys in silence, and two
// readers could then read two robots. Objects become Maps; numbers must be integers.

import { Refusal } from "./rational.js";

const DEEPEST = 64;
const STRING = /"(?:[^"\\\u0000-\u001f]|\\(?:["\\/bfnrt]|u[0-9a-fA-F]{4}))*"/y;
const WORD = /null|-?(?:0|[1-9][0-9]{0,8})(?![0-9.eE])/y;

export function parseJson(text) {
  let at = 0;
  const fail = (why) => { throw new Refusal(`not JSON (${why} at character ${at})`); };
  const space = () => { while (" \t\n\r".includes(text[at] ?? "x")) at++; };
  const take = (pattern) => {
    pattern.lastIndex = at;
    const found = pattern.exec(text) ?? fail("no value of a certificate");
    at = pattern.lastIndex;
    return JSON.parse(found[0]);
  };
  const mark = (sign) => {
    space();
    if (text[at] !== sign) return false;
    at++;
    return true;
  };
  const entries = (close, read) => {
    if (mark(close)) return;
    do read(); while (mark(","));
    if (!mark(close)) fail(`no ${close}`);
  };
  const value = (depth) => {
    if (depth > DEEPEST) fail("nested too deeply");
    if (mark("{")) {
      const found = new Map();
      entries("}", () => {
        space();
        const key = take(STRING);
        if (found.has(key)) fail("a key comes twice");
        if (!mark(":")) fail("no :");
        found.set(key, value(depth + 1));
      });
      return found;
    }
    if (mark("[")) {
      const found = [];
      entries("]", () => found.push(value(depth + 1)));
      return found;
    }
    space();
    return take(text[at] === '"' ? STRING : WORD);
  };
  const found = value(0);
  space();
  if (at < text.length) fail("more text after the object");
  return found;
}
