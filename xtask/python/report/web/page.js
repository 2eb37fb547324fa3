// Draws every panel, and again where the width, the colours or the paper change.

const shown = JSON.parse(document.getElementById("panels").textContent);
const moment = new Moment(shown.find((panel) => panel.kind === "rotor").machine.motion);
const boxes = document.querySelectorAll("main .picture");
const redraws = shown.map((panel, i) => drawnBy[panel.kind](boxes[i], panel, moment));
const redrawAll = () => redraws.forEach((redraw) => redraw());
const onPaper = (is) => { document.documentElement.classList.toggle("print", is); redrawAll(); };

redrawAll();
let width = innerWidth;
addEventListener("resize", () => { if (innerWidth !== width) { width = innerWidth; redrawAll(); } });
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redrawAll);
addEventListener("beforeprint", () => onPaper(true));
addEventListener("afterprint", () => onPaper(false));
