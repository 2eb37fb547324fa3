// Paths whose x may turn back: orbits, the way of a point, a run-up. uPlot draws the axes and the legend.

drawnBy.paths = (box, panel) => {
  const plots = panel.plots.map((one) => ({ ...one, paths: one.paths.map((path) => ({ ...path, x: unpack(path.x), y: unpack(path.y) })) }));
  const all = (axis, paths) => extent(paths.flatMap((path) => [...path[axis], ...path.marks.map((dot) => dot[axis])]));
  const xs = all("x", plots.flatMap((one) => one.paths));
  return () => {
    box.replaceChildren();
    plots.forEach((one, i) => {
      const ys = all("y", one.paths);
      const width = panel.equal ? Math.min(box.clientWidth, 460) : box.clientWidth;
      const half = Math.max(xs[1] - xs[0], ys[1] - ys[0]) / 2;
      const range = ([low, high], air) => [low - air * (high - low || 1), high + air * (high - low || 1)];
      const around = ([low, high]) => range([(low + high) / 2 - half, (low + high) / 2 + half], 0.05);
      plot(box, [xs, ...one.paths.map(() => [null, null])], {
        x: i === plots.length - 1 ? panel.x : null,
        y: one.label,
        width,
        height: panel.equal ? width - LEFT - RIGHT : 190,
        series: [{}, ...one.paths.map((path) => ({ label: path.label, stroke: colour(path.colour), width: 2 }))],
        scales: { x: { range: () => (panel.equal ? around(xs) : range(xs, 0.01)) }, y: { range: () => (panel.equal ? around(ys) : range(ys, 0.06)) } },
        live: false,
        hooks: { draw: [(u) => one.paths.forEach((path) => trace(u, path))] },
      });
    });
  };
};

function trace(u, { x, y, colour: name, marks }) {
  clipped(u, (ctx) => {
    ctx.strokeStyle = colour(name);
    ctx.lineWidth = 1.25 * uPlot.pxRatio;
    ctx.lineJoin = "round";
    ctx.beginPath();
    let down = false;
    x.forEach((at, i) => {
      if (y[i] === null) { down = false; return; }
      ctx[down ? "lineTo" : "moveTo"](u.valToPos(at, "x", true), u.valToPos(y[i], "y", true));
      down = true;
    });
    ctx.stroke();
  });
  for (const dot of marks) mark(u, dot, colour(name));
}
