// Curves against a common x, in one plot or several above one another.

const drawnBy = {};

drawnBy.lines = (box, panel) => {
  const x = unpack(panel.x.values);
  const columns = panel.plots.map((one) => [x, ...one.curves.map((curve) => unpack(curve.values))]);
  return () => {
    box.replaceChildren();
    panel.plots.forEach((one, i) => {
      const last = i === panel.plots.length - 1;
      const value = (_, v) => (v == null ? "" : text(v, 5));
      plot(box, columns[i], {
        x: last ? panel.x.label : null,
        y: one.label,
        height: panel.plots.length > 2 ? 110 : panel.plots.length > 1 ? 150 : 260,
        series: [{ label: panel.x.label, value }, ...one.curves.map((curve) => ({ ...style(curve), label: curve.label, value }))],
        scales: { x: {}, y: one.log ? { distr: 3 } : {} },
        cursor: { sync: { key: panel.title }, points: { size: 6 } },
        hooks: { draw: [(u) => { for (const line of one.lines ?? []) level(u, line); for (const dot of one.marks ?? []) mark(u, dot, colour("text")); }] },
      });
    });
  };
};

// How curves are dashed, and how their legend shows it.
const DASHES = [[undefined, "solid"], [[6, 4], "dashed"], [[2, 3], "dotted"]];

function style({ colour: name, dash: number = 0, points = false, width = 1.25 }) {
  const [stroke, [dash, marker]] = [colour(name), DASHES[number % DASHES.length]];
  return { stroke, width, pxAlign: 0, dash, marker, points: { show: points, size: 4, fill: stroke, stroke } };
}

// A dashed line across the plane, at an x with its name or at a y.
function level(u, { x, y, label }) {
  clipped(u, (ctx) => {
    const { left, top, width, height } = u.bbox;
    const [X, Y] = [x !== undefined && u.valToPos(x, "x", true), y !== undefined && u.valToPos(y, "y", true)];
    ctx.strokeStyle = ctx.fillStyle = colour("muted");
    ctx.setLineDash([4 * uPlot.pxRatio, 4 * uPlot.pxRatio]);
    ctx.beginPath();
    if (x !== undefined) { ctx.moveTo(X, top); ctx.lineTo(X, top + height); } else { ctx.moveTo(left, Y); ctx.lineTo(left + width, Y); }
    ctx.stroke();
    ctx.font = FONT.replace("12px", `${12 * uPlot.pxRatio}px`);
    ctx.textAlign = "left";
    ctx.textBaseline = "top";
    if (label) ctx.fillText(label, X + 4 * uPlot.pxRatio, top + 2 * uPlot.pxRatio);
  });
}
