// Drawing in space: x to the right, z up, seen from a little above and beside; dragging turns the view.

class Space {
  constructor(canvas, aspect, redraw) {
    Object.assign(this, { canvas, aspect, yaw: 0.55, pitch: 0.3 });
    canvas.addEventListener("pointermove", (event) => {
      if (!event.buttons) return;
      this.yaw += 0.01 * event.movementX;
      this.pitch = Math.max(-1.5, Math.min(1.5, this.pitch + 0.01 * event.movementY));
      redraw();
    });
  }

  // A cleared canvas as wide as its place, whose scale takes in all of `points`; sizes in CSS pixels.
  begin(points) {
    const [width, height] = [this.canvas.parentElement.clientWidth, this.canvas.parentElement.clientWidth * this.aspect];
    Object.assign(this.canvas, { width: width * devicePixelRatio, height: height * devicePixelRatio });
    const ctx = this.canvas.getContext("2d");
    ctx.scale(devicePixelRatio, devicePixelRatio);
    Object.assign(this, { scale: 1, centre: [0, 0], middle: [0, 0] });
    const seen = points.map((point) => this.at(point));
    const [xs, ys] = [0, 1].map((i) => extent(seen.map((point) => point[i])));
    this.scale = 0.88 * Math.min(width / (xs[1] - xs[0]), height / (ys[1] - ys[0]));
    this.centre = [(xs[0] + xs[1]) / 2, -(ys[0] + ys[1]) / 2];
    this.middle = [width / 2, height / 2];
    ctx.lineJoin = ctx.lineCap = "round";
    ctx.font = FONT;
    return (this.ctx = ctx);
  }

  // How far behind the picture a direction leads.
  depth([x, y, z]) {
    return (y * Math.cos(this.yaw) - x * Math.sin(this.yaw)) * Math.cos(this.pitch) - z * Math.sin(this.pitch);
  }

  // A point's place on the canvas.
  at([x, y, z]) {
    const right = x * Math.cos(this.yaw) + y * Math.sin(this.yaw);
    const behind = y * Math.cos(this.yaw) - x * Math.sin(this.yaw);
    const up = z * Math.cos(this.pitch) + behind * Math.sin(this.pitch);
    return [this.middle[0] + this.scale * (right - this.centre[0]), this.middle[1] - this.scale * (up - this.centre[1])];
  }

  line(points, stroke, width = 1, { dash = [], fill, closed = false } = {}) {
    const { ctx } = this;
    ctx.beginPath();
    points.forEach((point, i) => ctx[i ? "lineTo" : "moveTo"](...this.at(point)));
    if (closed) ctx.closePath();
    if (fill) { ctx.fillStyle = fill; ctx.fill(); }
    ctx.setLineDash(dash);
    ctx.lineWidth = width;
    ctx.strokeStyle = stroke;
    if (width) ctx.stroke();
  }

  dot(point, fill, radius = 4) {
    this.ctx.beginPath();
    this.ctx.arc(...this.at(point), radius, 0, 2 * Math.PI);
    this.ctx.fillStyle = fill;
    this.ctx.fill();
  }
}

const add = (a, b, factor = 1) => a.map((v, i) => v + factor * b[i]);
const cross = ([a, b, c], [d, e, f]) => [b * f - c * e, c * d - a * f, a * e - b * d];
const norm = (a) => a.map((v) => v / Math.hypot(...a));
