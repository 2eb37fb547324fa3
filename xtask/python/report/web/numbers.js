// Numbers as the page gets them, and as people read them.

// Curves come as whole steps from the least value (pack.py).
const unpack = ({ from, step, whole }) => whole.map((n) => (n === null ? null : from + step * n));

const text = (value, digits = 4) => String(Number(value.toPrecision(digits))).replace("-", "−");

const extent = (values) => values.reduce(([low, high], v) => (v === null ? [low, high] : [Math.min(low, v), Math.max(high, v)]), [Infinity, -Infinity]);
