// What a report says of itself in a browser; browser.py puts both parts into a copy of it.

const faults = [];
addEventListener("error", (event) => faults.push(String(event.message)));
addEventListener("unhandledrejection", (event) => faults.push(String(event.reason)));
for (const level of ["error", "warn"]) console[level] = (...words) => faults.push(words.join(" "));
// Without a window, frames come when they like; timers do not.
window.requestAnimationFrame = (draw) => setTimeout(() => draw(performance.now()), 16);

// After the page's own scripts.

const pixels = (canvas) => canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data;
// How many pixels have a colour: axes, their lines and their words have none.
const coloured = (canvas) => {
  const all = pixels(canvas);
  let count = 0;
  for (let i = 0; i < all.length; i += 4) {
    const rgb = all.slice(i, i + 3);
    count += all[i + 3] > 0 && Math.max(...rgb) - Math.min(...rgb) > 40;
  }
  return count;
};
const changed = (before, after) => before.reduce((count, byte, i) => count + (byte !== after[i]), 0);

const rotor = document.querySelector(".rotor canvas"), sphere = document.querySelector(".sphere canvas");
const set = (slider, value) => {
  slider.value = value;
  slider.dispatchEvent(new Event("input", { bubbles: true }));
};
// How many bytes of the drawings change with a slider, which then goes back.
const moved = (selector, fraction) => {
  const slider = document.querySelector(selector), own = slider.value;
  const before = [rotor, sphere].map((canvas) => canvas && pixels(canvas));
  set(slider, Number(slider.min) + fraction * (slider.max - slider.min));
  const counts = [rotor, sphere].map((canvas, i) => canvas && changed(before[i], pixels(canvas)));
  set(slider, own);
  return counts;
};

// uPlot draws when the scripts rest.
const rest = () => new Promise((resume) => setTimeout(resume, 50));

async function check() {
  await rest();
  const found = {
    width: innerWidth,
    scrolls: document.documentElement.scrollWidth,
    titles: [...document.querySelectorAll("main figure h2")].map((title) => title.textContent),
    canvases: [...document.querySelectorAll("main figure")].map((figure) => [...figure.querySelectorAll("canvas")].map(coloured)),
    time: moved(".rotor .time", 0.37),
    exaggeration: moved(".rotor .exaggeration", 0.9)[0],
  };
  const button = document.querySelector(".rotor button"), told = () => document.querySelector(".rotor output").textContent;
  button.click();
  const before = told();
  for (let i = 0; i < 100 && told() === before; i += 1) await rest();
  button.click();
  found.plays = told() !== before && button.textContent === "Play";
  // Paper: the colours of light, and everything drawn anew.
  dispatchEvent(new Event("beforeprint"));
  await rest();
  found.paper = [getComputedStyle(document.body).backgroundColor, document.body.offsetWidth];
  found.printed = [...document.querySelectorAll("main figure canvas")].map(coloured);
  dispatchEvent(new Event("afterprint"));
  return { ...found, faults };
}

const found = await check().catch((fault) => ({ faults: [...faults, String(fault)] }));
parent.document.body.append(Object.assign(document.createElement("pre"), { id: "check", textContent: JSON.stringify(found) }));
