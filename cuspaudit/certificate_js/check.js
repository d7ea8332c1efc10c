// The second checker: is the claim of a certificate proved by the certificate alone?
// Written from docs/certificate.md. It needs nothing but the language, in Node or a browser.

import { readCertificate } from "./certificate.js";
import { proveCusp } from "./cusp.js";
import { isLoose } from "./play.js";
import { provePairs } from "./pairs.js";
import { provePath } from "./path.js";
import { Refusal, demand } from "./rational.js";
import { proveStructure } from "./structure.js";

/** Checks the text of a certificate: {accepted, reason}, the reason a sentence. */
export function checkCertificate(text) {
  try {
    return { accepted: true, reason: prove(readCertificate(text)) };
  } catch (error) {
    if (error instanceof Refusal) return { accepted: false, reason: error.message };
    if (error instanceof SyntaxError) return { accepted: false, reason: `not JSON (${error.message})` };
    if (error instanceof RangeError) return { accepted: false, reason: "too large to be checked" };
    throw error;
  }
}

function prove(certificate) {
  // a noncuspidal robot is noncuspidal within any limits: only yes has to be inside
  const { kind, robot } = certificate, loose = isLoose(robot);
  demand(!loose || kind !== "structure", "relations hold for one robot, not for every one");
  const proofs = { path: provePath, cusp: proveCusp, pairs: provePairs, structure: proveStructure };
  return `${proofs[kind](certificate)}, for ${loose ? "every robot of the play" : "these numbers"}`;
}
