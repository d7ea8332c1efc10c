// node run.mjs FILE...: one JSON line a file; exit code 0 if all are accepted, else 1.
// The milliseconds are those of the processor, as far as the file took them.

import { readFileSync } from "node:fs";

import { checkCertificate } from "./check.js";

let all = true;
for (const file of process.argv.slice(2)) {
  const started = process.cpuUsage();
  const { accepted, reason } = check(file);
  all &&= accepted;
  const { user, system } = process.cpuUsage(started);
  const milliseconds = Math.round((user + system) / 1000);
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
