// JSON, strictly: JSON.parse would keep the second of two equal keys in silence, and two
// readers could then read two robots. Objects become Maps; numbers must be integers.

import { Refusal } from "./rational.js";

const DEEPEST = 64;

export function parseJson(text) {
  const reader = new Reader(text);
  const value = reader.value(0);
  reader.space();
  if (reader.at < text.length) reader.fail("more text after the object");
  return value;
}

class Reader {
  constructor(text) { [this.text, this.at] = [text, 0]; }

  fail(why) { throw new Refusal(`not JSON (${why} at character ${this.at})`); }

  space() { while (" \t\n\r".includes(this.text[this.at] ?? "x")) this.at++; }

  take(pattern) {
    pattern.lastIndex = this.at;
    const found = pattern.exec(this.text);
    if (found) this.at = pattern.lastIndex;
    return found?.[0];
  }

  expect(mark) {
    this.space();
    if (this.text[this.at] !== mark) this.fail(`no ${mark}`);
    this.at++;
  }

  value(depth) {
    if (depth > DEEPEST) this.fail("nested too deeply");
    this.space();
    switch (this.text[this.at]) {
      case "{": return this.object(depth);
      case "[": return this.list(depth);
      case '"': return this.string();
      default: return this.word();
    }
  }

  object(depth) {
    const found = new Map();
    this.entries("{", "}", () => {
      this.space();
      const key = this.string();
      if (found.has(key)) this.fail("a key comes twice");
      this.expect(":");
      found.set(key, this.value(depth + 1));
    });
    return found;
  }

  list(depth) {
    const found = [];
    this.entries("[", "]", () => found.push(this.value(depth + 1)));
    return found;
  }

  entries(open, close, read) {
    this.expect(open);
    this.space();
    if (this.text[this.at] === close) { this.at++; return; }
    for (;;) {
      read();
      this.space();
      if (this.text[this.at] === close) { this.at++; return; }
      this.expect(",");
    }
  }

  string() {
    const token = this.take(/"(?:[^"\\\u0000-\u001f]|\\(?:["\\/bfnrt]|u[0-9a-fA-F]{4}))*"/y);
    if (token === undefined) this.fail("no string");
    return JSON.parse(token);
  }

  word() {
    const token = this.take(/null|-?(?:0|[1-9][0-9]{0,8})(?![0-9.eE])/y);
    if (token === undefined) this.fail("no value of a certificate");
    return token === "null" ? null : Number(token);
  }
}
