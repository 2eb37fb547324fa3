// The rotor to scale at a moment, its motion exaggerated, with the controls of both.

drawnBy.rotor = (box, { machine }, moment) => {
  const canvas = document.createElement("canvas");
  const { slider, exaggeration } = controls(box, canvas, machine, moment);
  const redraw = () => draw(space, machine, moment, exaggeration());
  const space = new Space(canvas, 0.62, redraw);
  moment.addEventListener("change", () => { slider.value = moment.time; redraw(); });
  return redraw;
};

// 1, 2, 5, 10, … by their number.
const step = (n) => [1, 2, 5][n % 3] * 10 ** Math.floor(n / 3);

function controls(box, canvas, machine, moment) {
  const [from, to] = [moment.times[0], moment.times.at(-1)];
  const most = Math.max(9, 3 + [...Array(24).keys()].find((n) => step(n) >= machine.exaggeration));
  const panel = Object.assign(document.createElement("div"), { className: "controls" });
  panel.innerHTML = `
    <button type="button">Play</button>
    <input type="range" class="time" aria-label="time" min="${from}" max="${to}" step="any" value="${to}">
    <label for="pace">pace</label>
    <select id="pace"><option value="turn">a turn in 2 s</option><option value="run">the run in 20 s</option></select>
    <label for="exaggeration">motion ×</label>
    <input type="range" class="exaggeration" id="exaggeration" min="0" max="${most}">
    <output></output>`;
  box.replaceChildren(canvas, panel);
  canvas.setAttribute("role", "img");
  canvas.setAttribute("aria-label", "The rotor at the moment of the slider");
  const [slider, exaggerate] = [panel.querySelector(".time"), panel.querySelector(".exaggeration")];
  exaggerate.value = [...Array(most + 1).keys()].find((n) => step(n) >= machine.exaggeration);
  const exaggeration = () => step(Number(exaggerate.value));
  const tell = () => {
    const [, y, z] = moment.vector("r_c");
    const [length, unit] = [[1, "m"], [1e-3, "mm"], [1e-6, "µm"], [1e-9, "nm"]].find(([size]) => Math.hypot(y, z) >= size) ?? [1, "m"];
    panel.querySelector("output").textContent =
      `t = ${text(moment.time)} s, ${text(Number((moment.value("omega_phi") * 30 / Math.PI).toFixed(6)))} rpm, c ${text(Math.hypot(y, z) / length, 3)} ${unit} off the x axis; motion × ${exaggeration()}`;
  };
  slider.addEventListener("input", () => moment.show(Number(slider.value)));
  exaggerate.addEventListener("input", () => moment.show(moment.time));
  moment.addEventListener("change", tell);
  play(panel.querySelector("button"), panel.querySelector("select"), moment);
  tell();
  return { slider, exaggeration };
}

// Moves on while the button is down: by the turn, which takes the same time at every speed, or through the run.
function play(button, pace, moment) {
  let before = null;
  const go = (now) => {
    if (before === null) return;
    const seconds = Math.max(0, Math.min(0.1, (now - before) / 1000));
    before = now;
    const [from, to] = [moment.times[0], moment.times.at(-1)];
    const turn = 2 * Math.PI / Math.max(Math.abs(moment.value("omega_phi")), 2 * Math.PI / (to - from));
    moment.show(moment.time >= to ? from : moment.time + seconds * (pace.value === "turn" ? turn / 2 : (to - from) / 20));
    requestAnimationFrame(go);
  };
  button.addEventListener("click", () => {
    before = before === null ? performance.now() : null;
    // From the end on, all of it once more.
    if (before !== null && moment.time >= moment.times.at(-2)) moment.show(moment.times[0]);
    button.textContent = before === null ? "Play" : "Pause";
    requestAnimationFrame(go);
  });
}

const E = [1, 0, 0];

// The rotor as it stands at a time, its motion `times` as large: `place(p)` on its axis, `normal`, and `turned(angle)` across it.
function stand(machine, moment, times, time = moment.time) {
  const [c, t] = [moment.vector("r_c", time), norm(moment.vector("axis", time))];
  const rest = (p) => [machine.rest + p, 0, 0];
  const place = (p) => add(rest(p), add(add(c, t, p), rest(p), -1), times);
  const normal = norm(add(E, add(t, E, -1), times));
  const phi = moment.value("phi", time);
  // The least rotation that takes e to the normal, of a vector across e: at −e it has no direction.
  const tilted = (v) => add(v, add(E, normal), -(normal[1] * v[1] + normal[2] * v[2]) / Math.max(1 + normal[0], 1e-9));
  const turned = (y, z) => tilted([0, y * Math.cos(phi) - z * Math.sin(phi), y * Math.sin(phi) + z * Math.cos(phi)]);
  return { place, rest, normal, turned };
}

function draw(space, machine, moment, times) {
  const { body, held, probes, span, support, unbalances } = machine;
  const [low, high] = span.map((p) => p + Math.sign(p - (span[0] + span[1]) / 2) * 0.06 * (span[1] - span[0]));
  const size = Math.max(high - low, 2 * body.radius);
  const reach = Math.max(0.3 * size, 1.25 * body.radius);
  const now = stand(machine, moment, times);
  const ctx = space.begin(bounds(machine, moment, times, [low, high], held.length + probes.length ? reach : 0));
  const ground = colour("muted");
  space.line([[machine.rest + low, 0, 0], [machine.rest + high, 0, 0]], ground, 1, { dash: [5, 4] });
  for (const one of held.filter((one) => one.ring === null)) {
    for (const side of [-1, 1]) spring(space, add(now.rest(one.position), [0, 0, side * reach]), now.place(one.position), 0.05 * size, ground);
  }
  const ends = [low, -body.length / 2, body.length / 2, high].map(now.place);
  const [shaft, near] = [colour("text"), space.depth(now.normal) < 0];
  space.line(ends, shaft, 4);
  prism(space, body, now, near);
  space.line(near ? ends.slice(2) : ends.slice(0, 2), shaft, 4);
  for (const one of held.filter((one) => one.ring !== null)) ring(space, now.rest(one.position), one.ring * times, ground);
  for (const { position, radius, angle } of unbalances) {
    space.dot(add(now.place(position), now.turned(radius * Math.cos(angle), radius * Math.sin(angle))), colour("orange"), 5);
  }
  if (support !== null) {
    space.dot([0, 0, 0], ground, 3);
    space.line([[0, 0, 0], now.place(support)], ground, 1);
    space.dot(now.place(support), colour("green"), 4);
  }
  for (const { position } of [...held, ...probes, { position: 0 }]) trail(space, machine, moment, times, position);
  for (const { position } of probes) space.dot(now.place(position), colour("purple"), 4);
  words(space, [...held, ...probes].map(({ name, position }) => [name, add(now.rest(position), [0, 0, -reach])]));
}

// Points that the drawing must take in, through the whole run: the same scale at every moment.
function bounds(machine, moment, times, ends, reach) {
  // Below, room for names.
  const points = [-1.3 * reach, reach].flatMap((z) => ends.map((p) => [machine.rest + p, 0, z]));
  const { outline, length } = machine.body;
  const corners = [0, 1, 2, 3].map((i) => outline[Math.floor(i * outline.length / 4)]);
  const every = Math.max(1, Math.floor(moment.times.length / 200));
  for (let i = 0; i < moment.times.length - 1; i += every) {
    const then = stand(machine, moment, times, moment.times[i]);
    points.push(...ends.map(then.place));
    for (const half of [-length / 2, length / 2]) points.push(...corners.map(([y, z]) => add(then.place(half), then.turned(y, z))));
  }
  return points;
}

// The body, through which one sees its shaft: its silhouette, the cap that is nearer, and a line on it that turns.
function prism(space, { outline, length }, now, near) {
  const edge = colour("blue");
  const cap = (half) => outline.map(([y, z]) => add(now.place(half), now.turned(y, z)));
  const [front, back] = near ? [cap(length / 2), cap(-length / 2)] : [cap(-length / 2), cap(length / 2)];
  space.line(hull(space, [...front, ...back]), edge, 1, { closed: true, fill: colour("body") });
  if (front.length === 4) front.forEach((point, i) => space.line([point, back[i], back[(i + 1) % 4]], edge, 0.5));
  space.line(front, edge, 1.25, { closed: true, fill: colour("body") });
  const middle = now.place((near ? 1 : -1) * length / 2);
  space.line([middle, add(middle, now.turned(0.9 * outline[0][0], 0.9 * outline[0][1]))], edge, 2);
}

// Those of the points that are outermost on the canvas, in their order around it.
function hull(space, points) {
  const seen = points.map((point) => [space.at(point), point]).sort(([a], [b]) => a[0] - b[0] || a[1] - b[1]);
  const half = (all) => all.reduce((kept, one) => {
    while (kept.length > 1 && bend(kept.at(-2)[0], kept.at(-1)[0], one[0]) <= 0) kept.pop();
    return [...kept, one];
  }, []);
  return [...half(seen).slice(0, -1), ...half(seen.reverse()).slice(0, -1)].map(([, point]) => point);
}

const bend = (a, b, c) => (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);

function spring(space, from, to, width, stroke) {
  const way = add(to, from, -1), turns = 7;
  const zigzag = [...Array(2 * turns).keys()].map((i) => add(add(from, way, 0.15 + 0.7 * (i + 0.5) / (2 * turns)), [i % 2 ? width / 2 : -width / 2, 0, 0]));
  space.line([from, add(from, way, 0.15), ...zigzag, add(from, way, 0.85), to], stroke, 1);
  space.line([add(from, [-width, 0, 0]), add(from, [width, 0, 0])], stroke, 3);
}

// Names below their places, one below another where they are near.
function words(space, all) {
  const written = [];
  space.ctx.fillStyle = colour("muted");
  space.ctx.textAlign = "center";
  for (const [name, point] of all) {
    const [X, Y] = space.at(point);
    const near = written.filter((x) => Math.abs(x - X) < 70).length;
    space.ctx.fillText(name, X, Y + 14 * (1 + near));
    written.push(X);
  }
}

function ring(space, [x], radius, stroke) {
  const angles = [...Array(48).keys()].map((i) => 2 * Math.PI * i / 48);
  space.line(angles.map((a) => [x, radius * Math.cos(a), radius * Math.sin(a)]), stroke, 1.5, { closed: true });
}

// Where a place of the axis was during the last turn.
function trail(space, machine, moment, times, position) {
  const last = moment.frame(), full = moment.motion.phi[last];
  let first = last;
  while (first > 0 && last - first < 400 && Math.abs(full - moment.motion.phi[first]) < 2 * Math.PI) first -= 1;
  const count = Math.max(100, last - first), [from, to] = [moment.times[first], moment.time];
  const before = [...Array(count + 1).keys()].map((i) => from + (to - from) * i / count);
  space.line(before.map((time) => stand(machine, moment, times, time).place(position)), colour("orange"), 1.25);
}
