"use strict";
(() => {
  const link = document.getElementById("certificate");
  const place = document.getElementById("checked");
  const bytes = Uint8Array.from(atob(link.href.split(",")[1]), (c) => c.charCodeAt(0));
  const say = (word, text, kind) => {
    const badge = document.createElement("span");
    badge.className = "badge " + kind;
    badge.textContent = word;
    place.replaceChildren(badge, " " + text);
    place.dataset.checked = kind;
  };
  // after the first picture: the page need not wait for the proof
  setTimeout(() => {
    const started = performance.now();
    let answer;
    try {
      const text = new TextDecoder("utf-8", { fatal: true, ignoreBOM: true }).decode(bytes);
      answer = cuspauditCertificate.checkCertificate(text);
    } catch (error) {
      answer = { accepted: false, reason: String(error) };
    }
    const took = Math.max(1, Math.round(performance.now() - started)) + " ms";
    if (answer.accepted) say("accepted", `checked in your browser just now, ${took}.`, "yes");
    else
      say("REJECTED", `in your browser, ${took}: ${answer.reason}. The certificate proves ` +
        "nothing; do not rely on the verdict.", "no");
  }, 50);
})();
