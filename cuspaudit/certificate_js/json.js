// JSON, strictly: JSON.parse keeps the second of two equal keys in silence, and two readers
// could then read two robots. So what was read, written again, has to be the text, but for
// blanks and the escapes of strings. Numbers must be plain integers.

import { demand } from "./rational.js";

const STRING_OR_BLANKS = /"[^"\\]*(?:\\.[^"\\]*)*"|[ \t\n\r]+/g;

/** What the text says; throws a SyntaxError or a Refusal where it is not strict JSON. */
export function parseJson(text) {
  const found = JSON.parse(text);
  const plain = text.replace(STRING_OR_BLANKS, (part) =>
    (part[0] === '"' ? JSON.stringify(JSON.parse(part)) : ""));
  demand(plain === JSON.stringify(found), "not JSON (a key twice, or a number that is no integer)");
  return found;
}
