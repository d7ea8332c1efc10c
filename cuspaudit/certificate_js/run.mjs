// node run.mjs FILE...: one JSON line a file; exit code 0 if all are accepted, else 1.

import { readFileSync } from "node:fs";

import { checkCertificate } from "./check.js";

let all = true;
for (const file of process.argv.slice(2)) {
  const started = performance.now();
  const { accepted, reason } = check(file);
  all &&= accepted;
  const milliseconds = Math.round(performance.now() - started);
  console.log(JSON.stringify({ file, accepted, reason, milliseconds }));
}
process.exitCode = all ? 0 : 1;

function check(file) {
  try {
    const decoder = new TextDecoder("utf-8", { fatal: true, ignoreBOM: true });
    return checkCertificate(decoder.decode(readFileSync(file)));
  } catch (error) {
    return { accepted: false, reason: `cannot be read: ${error.message}` };
  }
}
