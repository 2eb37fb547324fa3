// The moment of the run that all drawings show, and the motion at it.

class Moment extends EventTarget {
  constructor(motion) {
    super();
    this.motion = Object.fromEntries(Object.entries(motion).map(([name, packed]) => [name, unpack(packed)]));
    this.times = this.motion.time;
    this.time = this.times.at(-1);
  }

  show(time) {
    this.time = Math.max(this.times[0], Math.min(this.times.at(-1), time));
    this.dispatchEvent(new Event("change"));
  }

  // The frame at or before a time.
  frame(time = this.time) {
    let [low, high] = [0, this.times.length - 1];
    while (high - low > 1) {
      const half = (low + high) >> 1;
      if (this.times[half] <= time) low = half; else high = half;
    }
    return low;
  }

  // A column between its frames, by the cubic through the two about it with the slopes of their neighbours (Catmull and Rom).
  value(name, time = this.time) {
    const i = this.frame(time), column = this.motion[name], [a, b] = [column[i], column[i + 1]];
    // At an end, what the parabola through the other three has there.
    const p = column[i - 1] ?? 3 * (a - b) + (column[i + 2] ?? 2 * b - a);
    const q = column[i + 2] ?? 3 * (b - a) + p;
    const x = (time - this.times[i]) / (this.times[i + 1] - this.times[i]);
    return a + x / 2 * (b - p + x * (2 * p - 5 * a + 4 * b - q + x * (3 * (a - b) + q - p)));
  }

  vector(name, time = this.time) {
    return ["x", "y", "z"].map((c) => this.value(`${name}.${c}`, time));
  }
}
