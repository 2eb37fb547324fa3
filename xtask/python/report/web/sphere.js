// The tip of the axis on its sphere: its whole way, pale where it is behind, and where it is at the moment.

drawnBy.sphere = (box, _, moment) => {
  const canvas = box.appendChild(document.createElement("canvas"));
  canvas.setAttribute("role", "img");
  canvas.setAttribute("aria-label", "The tip of the axis on its sphere");
  const way = moment.times.map((_, i) => ["x", "y", "z"].map((c) => moment.motion[`axis.${c}`][i]));
  const circle = (point) => [...Array(97).keys()].map((i) => point(Math.PI * i / 48));
  const grid = [
    circle((a) => [Math.cos(a), Math.sin(a), 0]),
    circle((a) => [Math.cos(a), 0, Math.sin(a)]),
    ...[-0.5, 0, 0.5].map((x) => circle((a) => [x, Math.sqrt(1 - x * x) * Math.cos(a), Math.sqrt(1 - x * x) * Math.sin(a)])),
  ];
  const space = new Space(canvas, 0.7, () => redraw());
  const redraw = () => {
    const ctx = space.begin([-1, 1].flatMap((s) => [0, 1, 2].map((i) => [0, 1, 2].map((j) => (i === j ? s : 0)))).concat(circle((a) => add([0, 0, 0], onEdge(space, a)))));
    for (const line of grid) pale(space, line, colour("grid"), 1);
    space.line(circle((a) => onEdge(space, a)), colour("muted"), 1);
    pale(space, way, colour("blue"), 1.25);
    space.line([[0, 0, 0], E], colour("muted"), 1, { dash: [5, 4] });
    ctx.fillStyle = colour("muted");
    ctx.fillText("e", ...space.at([1.06, 0, 0]));
    const tip = norm(moment.vector("axis"));
    space.line([[0, 0, 0], tip], colour("text"), 2);
    space.dot(tip, colour("orange"), 5);
  };
  moment.addEventListener("change", redraw);
  return redraw;
};

// The edge of the sphere as it is seen.
function onEdge({ yaw, pitch }, angle) {
  const right = [Math.cos(yaw), Math.sin(yaw), 0];
  const up = [-Math.sin(yaw) * Math.sin(pitch), Math.cos(yaw) * Math.sin(pitch), Math.cos(pitch)];
  return add(right.map((v) => v * Math.cos(angle)), up, Math.sin(angle));
}

// A line whose pieces behind the sphere's middle are pale.
function pale(space, points, stroke, width) {
  for (const behind of [true, false]) {
    let piece = [];
    space.ctx.globalAlpha = behind ? 0.3 : 1;
    points.forEach((point, i) => {
      if (space.depth(point) > 0 === behind) piece.push(point);
      if (space.depth(point) > 0 !== behind || i === points.length - 1) {
        if (piece.length > 1) space.line(piece, stroke, width);
        piece = [];
      }
    });
  }
  space.ctx.globalAlpha = 1;
}
