// Line charts as SVG elements.

const SIZE = { width: 640, height: 240, left: 70, right: 15, top: 15, bottom: 40 };

function svg_element(name, attributes, text) {
  const node = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
  if (text !== undefined) node.textContent = text;
  return node;
}

function format_tick(value) {
  return Number(value.toPrecision(3)).toString();
}

/** Draws a chart of series `{ name, x, y }`; both axes start at zero. */
export function chart(x_title, y_title, series) {
  const { width, height, left, right, top, bottom } = SIZE;
  const svg = svg_element("svg", { viewBox: `0 0 ${width} ${height}`, class: "chart", role: "img" });
  const maximum = (values) => values.reduce((max, value) => Math.max(max, value), 0) || 1;
  const x_max = maximum(series.flatMap(({ x }) => x));
  const y_max = maximum(series.flatMap(({ y }) => y));
  const x_at = (x) => left + ((width - left - right) * x) / x_max;
  const y_at = (y) => height - bottom - ((height - top - bottom) * y) / y_max;
  for (const fraction of [0, 0.5, 1]) {
    const [x, y] = [x_at(fraction * x_max), y_at(fraction * y_max)];
    svg.append(svg_element("line", { x1: left, x2: width - right, y1: y, y2: y, class: "grid" }),
      svg_element("text", { x: left - 8, y: y + 4, "text-anchor": "end" }, format_tick(fraction * y_max)),
      svg_element("text", { x, y: height - bottom + 16, "text-anchor": "middle" }, format_tick(fraction * x_max)));
  }
  svg.append(svg_element("text", { x: (left + width) / 2, y: height - 6, "text-anchor": "middle" }, x_title),
    svg_element("text", { x: 14, y: height / 2, "text-anchor": "middle", transform: `rotate(-90 14 ${height / 2})` }, y_title));
  series.forEach(({ name, x, y }, index) => {
    const points = x.map((value, at) => `${x_at(value)},${y_at(y[at])}`).join(" ");
    svg.append(svg_element("polyline", { points, class: `curve-${index}` }),
      svg_element("text", { x: left + 10, y: top + 14 * (index + 1), class: `curve-${index}` }, name));
  });
  return svg;
}
