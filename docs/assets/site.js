// A table that scrolls can be reached by the keyboard.
document.addEventListener("DOMContentLoaded", () => {
  for (const part of document.querySelectorAll(".md-typeset__scrollwrap")) {
    part.tabIndex = 0;
  }
});
