// Curves over one axis, drawn as SVG elements.

const SIZE = { width: 640, height: 240, left: 70, right: 15, top: 15, bottom: 40 };

function shape(name, attributes, text) {
  const made = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  if (text !== undefined) made.textContent = text;
  return made;
}

function short(value) {
  return Number(value.toPrecision(3)).toString();
}

/** A chart of series `{ name, x, y }`. */
export function chart(x_title, y_title, series) {
  const { width, height, left, right, top, bottom } = SIZE;
  const svg = shape("svg", { viewBox: `0 0 ${width} ${height}`, class: "chart", role: "img" });
  const most = (values) => values.reduce((most, value) => Math.max(most, value), 0) || 1;
  const x_most = most(series.flatMap(({ x }) => x));
  const y_most = most(series.flatMap(({ y }) => y));
  const x_at = (x) => left + ((width - left - right) * x) / x_most;
  const y_at = (y) => height - bottom - ((height - top - bottom) * y) / y_most;
  for (const part of [0, 0.5, 1]) {
    const [x, y] = [x_at(part * x_most), y_at(part * y_most)];
    svg.append(shape("line", { x1: left, x2: width - right, y1: y, y2: y, class: "grid" }),
      shape("text", { x: left - 8, y: y + 4, "text-anchor": "end" }, short(part * y_most)),
      shape("text", { x, y: height - bottom + 16, "text-anchor": "middle" }, short(part * x_most)));
  }
  svg.append(shape("text", { x: (left + width) / 2, y: height - 6, "text-anchor": "middle" }, x_title),
    shape("text", { x: 14, y: height / 2, "text-anchor": "middle", transform: `rotate(-90 14 ${height / 2})` }, y_title));
  series.forEach(({ name, x, y }, index) => {
    const points = x.map((value, at) => `${x_at(value)},${y_at(y[at])}`).join(" ");
    svg.append(shape("polyline", { points, class: `curve-${index}` }),
      shape("text", { x: left + 10, y: top + 14 * (index + 1), class: `curve-${index}` }, name));
  });
  return svg;
}
