// node run.mjs FILE...: one JSON line a file; exit code 0 if all are accepted, else 1,
// and 2 if no file is named: nothing was proved.
// The milliseconds are those of the processor, as far as the file took them.

import { readFileSync } from "node:fs";

import { checkCertificate } from "./check.js";

const files = process.argv.slice(2);
if (!files.length) console.error("no certificate is named: node run.mjs FILE...");
let all = true;
for (const file of files) {
  const started = process.cpuUsage();
  const { accepted, reason } = check(file);
  all &&= accepted;
  const { user, system } = process.cpuUsage(started);
  const milliseconds = Math.round((user + system) / 1000);
  console.log(JSON.stringify({ file, accepted, reason, milliseconds }));
}
process.exitCode = files.length ? (all ? 0 : 1) : 2;

function check(file) {
  try {
    const decoder = new TextDecoder("utf-8", { fatal: true, ignoreBOM: true });
    return checkCertificate(decoder.decode(readFileSync(file)));
  } catch (error) {
    return { accepted: false, reason: `cannot be read: ${error.message}` };
  }
}
