// What all plots by uPlot share.

const LEFT = 76, BOTTOM = 46, TOP = 10, RIGHT = 14;
const FONT = '12px system-ui, "Segoe UI", Roboto, "Helvetica Neue", Arial, sans-serif';

// A plot in `box`: labels of its axes (x: null where another plot stands below), `height` of its plane, uPlot's series, scales and hooks.
function plot(box, data, { x, y, width = box.clientWidth, height, series, scales, hooks = {}, cursor, live = true }) {
  const labels = { stroke: colour("muted"), font: FONT, labelFont: FONT, labelSize: 16, labelGap: 0 };
  const lines = { grid: { stroke: colour("grid"), width: 1 }, ticks: { stroke: colour("grid"), width: 1, size: 4 } };
  const across = { ...labels, ...lines, space: 64, size: BOTTOM - 16, label: x, values: (_, ticks) => ticks.map((v) => text(v, 6)) };
  const upward = { ...labels, ...lines, space: 28, size: LEFT - 16, label: y, values: (_, ticks) => ticks.map((v) => (v === null ? "" : text(v, 6))) };
  const below = x === null ? { ...across, label: undefined, size: 6, values: () => [] } : across;
  return new uPlot({
    width,
    height: height + TOP + (x === null ? 6 : BOTTOM),
    padding: [TOP, RIGHT, 0, 0],
    axes: [below, upward],
    series,
    scales: { x: { time: false, ...scales.x }, y: scales.y },
    cursor: cursor ?? { show: false },
    legend: { live, show: series.length > 2 || live, markers: { width: 3, dash: (_, i) => series[i].marker ?? "solid" } },
    hooks,
  }, data, box);
}

// A dot, and a word beside it, in the plane of a plot.
function mark(u, { x, y, label }, stroke) {
  const [X, Y, r] = [u.valToPos(x, "x", true), u.valToPos(y, "y", true), 4 * uPlot.pxRatio];
  u.ctx.fillStyle = stroke;
  u.ctx.beginPath();
  u.ctx.arc(X, Y, r, 0, 2 * Math.PI);
  u.ctx.fill();
  if (!label) return;
  const left = X > u.bbox.left + u.bbox.width / 2;
  u.ctx.font = FONT.replace("12px", `${12 * uPlot.pxRatio}px`);
  u.ctx.fillStyle = colour("text");
  u.ctx.textAlign = left ? "right" : "left";
  u.ctx.textBaseline = Y < u.bbox.top + 3 * r ? "top" : "middle";
  u.ctx.fillText(label, X + (left ? -2 : 2) * r, Y);
}

// Draws within the plane of a plot only.
function clipped(u, draw) {
  u.ctx.save();
  u.ctx.beginPath();
  u.ctx.rect(u.bbox.left, u.bbox.top, u.bbox.width, u.bbox.height);
  u.ctx.clip();
  draw(u.ctx);
  u.ctx.restore();
}
