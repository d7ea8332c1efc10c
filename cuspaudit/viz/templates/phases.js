"use strict";
const { command, files, audits } = JSON.parse(
  document.getElementById("members").textContent);

function choose(index) {
  if (audits[index]) {
    location.assign(audits[index]);
    return;
  }
  const link = document.getElementById("file");
  link.download = `member-${index}.yaml`;
  link.href = "data:text/yaml;charset=utf-8," + encodeURIComponent(files[index]);
  document.getElementById("name").textContent = `Member ${index}`;
  document.getElementById("command").textContent = `${command} --audit ${index}`;
  document.getElementById("text").textContent = files[index];
  document.getElementById("chosen").hidden = false;
}

for (const index of Object.keys(files)) {
  const dot = document.getElementById("member-" + index);
  dot.setAttribute("tabindex", "0");
  dot.setAttribute("role", audits[index] ? "link" : "button");
  dot.addEventListener("click", () => choose(index));
  dot.addEventListener("keydown", event => {
    if (event.key === "Enter") choose(index);
  });
}
document.documentElement.dataset.ready = "";
