// Amplitudes over time and frequency as colours, from black to yellow: the same on paper and on any screen.

const MAP = [[0, 0, 4], [81, 18, 124], [183, 55, 121], [252, 137, 97], [252, 253, 191]];
const LOUDEST = 60; // [dB] above black

drawnBy.waterfall = (box, panel) => {
  const image = painted(panel.levels);
  const [time, turning] = [unpack(panel.time), unpack(panel.turning)];
  return () => {
    box.replaceChildren();
    plot(box, [panel.x, [null, null]], {
      x: "time [s]",
      y: "frequency [Hz]",
      height: 340,
      series: [{}, {}],
      scales: { x: { range: () => panel.x }, y: { range: () => [-panel.y, panel.y] } },
      live: false,
      hooks: {
        draw: [(u) => clipped(u, (ctx) => {
          ctx.drawImage(image, u.bbox.left, u.bbox.top, u.bbox.width, u.bbox.height);
          ctx.strokeStyle = "#ffffffb0";
          ctx.lineWidth = uPlot.pxRatio;
          ctx.setLineDash([2 * uPlot.pxRatio, 6 * uPlot.pxRatio]);
          for (const order of [1, 2]) {
            ctx.beginPath();
            time.forEach((t, i) => ctx[i ? "lineTo" : "moveTo"](u.valToPos(t, "x", true), u.valToPos(order * turning[i], "y", true)));
            ctx.stroke();
          }
        })],
      },
    });
    const scale = box.appendChild(Object.assign(document.createElement("div"), { className: "scale" }));
    const ramp = document.createElement("i");
    ramp.style.background = `linear-gradient(to right, ${MAP.map((rgb) => `rgb(${rgb})`)})`;
    scale.append(`−${LOUDEST} dB`, ramp, `0 dB: ${panel.loudest}`);
  };
};

// A pixel a level; rows from the lowest frequency up.
function painted(levels) {
  const canvas = Object.assign(document.createElement("canvas"), { width: levels[0].length, height: levels.length });
  const ctx = canvas.getContext("2d");
  const pixels = ctx.createImageData(canvas.width, canvas.height);
  levels.forEach((row, i) => row.forEach((level, j) => {
    const place = Math.min(level / LOUDEST, 0.999) * (MAP.length - 1);
    const [low, high] = [MAP[Math.floor(place)], MAP[Math.floor(place) + 1]];
    const rgb = low.map((from, c) => from + (high[c] - from) * (place % 1));
    pixels.data.set([...rgb, 255], 4 * ((levels.length - 1 - i) * canvas.width + j));
  }));
  ctx.putImageData(pixels, 0, 0);
  return canvas;
}
