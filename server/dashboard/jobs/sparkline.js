// Deepest wear against cycles in the size of a word.

const NAMESPACE = "http://www.w3.org/2000/svg";
const [WIDTH, HEIGHT] = [72, 18];

/**
 * A curve from zero to its largest values, without axes; nothing of fewer than two points.
 * @param {number[]} x
 * @param {number[]} y
 * @returns {Node | null}
 */
export function sparkline(x, y) {
  const [width, height] = [Math.max(...x), Math.max(...y)];
  if (x.length < 2 || !(width > 0) || !(height > 0)) return null;
  const points = x.map((value, index) => `${(1 + (WIDTH - 2) * value / width).toFixed(1)},${(1 + (HEIGHT - 2) * (1 - y[index] / height)).toFixed(1)}`);
  const node = document.createElementNS(NAMESPACE, "svg");
  for (const [name, value] of Object.entries({ class: "sparkline", viewBox: `0 0 ${WIDTH} ${HEIGHT}`, width: WIDTH, height: HEIGHT, "aria-hidden": "true" }))
    node.setAttribute(name, String(value));
  const line = document.createElementNS(NAMESPACE, "polyline");
  line.setAttribute("points", points.join(" "));
  node.append(line);
  return node;
}
