// A plane section of both bodies with a stress at its nodes: its outline, and its values on a regular grid.

const UM = 1e3;
/** Cells of VTK that are swept from a section: hexahedra, whose first four nodes lie in one section and the others in the next. */
const HEXAHEDRON = 12;

/**
 * @typedef {object} Section
 * @property {number} at place across the motion, mm, or angle around a ring, °; 0 of a plane contact
 * @property {Float64Array} x µm, where the nodes are under load
 * @property {Float64Array} y µm
 * @property {Float64Array} values MPa
 * @property {number[][]} faces numbers of nodes of triangles and quadrangles
 */

/**
 * The sections of a file of fields, in the order of their places.
 * @param {Record<string, Float64Array>} file
 * @param {boolean} is_ring
 * @returns {Section[]}
 */
export function sections(file, is_ring) {
  const { Points: points, displacement_mm: moved, von_mises_mpa: values, connectivity, offsets, types } = file;
  const count = points.length / 3;
  const across = (/** @type {number} */ node) => (is_ring ? (Math.atan2(points[3 * node + 2], points[3 * node]) * 180) / Math.PI : points[3 * node + 2]);
  const place = (/** @type {number} */ node, /** @type {number} */ axis) => points[3 * node + axis] + moved[3 * node + axis];
  const x = Float64Array.from({ length: count }, (_, node) => UM * (is_ring ? Math.hypot(place(node, 0), place(node, 2)) : place(node, 0)));
  const y = Float64Array.from({ length: count }, (_, node) => UM * place(node, 1));
  /** @type {Map<string, Section>} */
  const found = new Map();
  const add = (/** @type {number[]} */ face) => {
    const key = across(face[0]).toPrecision(5);
    const section = found.get(key) ?? { at: Number(key), x, y, values, faces: [] };
    section.faces.push(face);
    found.set(key, section);
  };
  let from = 0;
  offsets.forEach((to, cell) => {
    const nodes = Array.from(connectivity.slice(from, to));
    from = to;
    if (types[cell] !== HEXAHEDRON) return add(nodes);
    add(nodes.slice(0, 4));
    add(nodes.slice(4));
  });
  for (const section of found.values()) section.faces = distinct(section.faces);
  return [...found.values()].sort((one, other) => one.at - other.at);
}

/** Faces without those of the other cell at the same section. @param {number[][]} faces */
function distinct(faces) {
  return [...new Map(faces.map((face) => [[...face].sort((a, b) => a - b).join(), face])).values()];
}

/**
 * The edges of a section that only one face has, as a broken line.
 * @param {Section} section
 */
export function outline({ faces, x, y }) {
  /** @type {Map<string, [number, number]>} */
  const edges = new Map();
  for (const face of faces)
    for (const [index, node] of face.entries()) {
      const next = face[(index + 1) % face.length];
      const key = `${Math.min(node, next)},${Math.max(node, next)}`;
      if (edges.has(key)) edges.delete(key);
      else edges.set(key, [node, next]);
    }
  const ends = [...edges.values()];
  return { x: ends.flatMap(([a, b]) => [x[a], x[b], null]), y: ends.flatMap(([a, b]) => [y[a], y[b], null]) };
}

/**
 * Values of a section at the points of a regular grid, linear within triangles; null outside of the bodies.
 * @param {Section} section
 * @param {{x: [number, number], y: [number, number]}} range
 * @param {number} columns
 * @param {number} rows
 */
export function on_grid({ faces, x, y, values }, range, columns, rows) {
  const [dx, dy] = [(range.x[1] - range.x[0]) / (columns - 1), (range.y[1] - range.y[0]) / (rows - 1)];
  const z = Array.from({ length: rows }, () => /** @type {(number | null)[]} */ (new Array(columns).fill(null)));
  const column = (/** @type {number} */ node) => (x[node] - range.x[0]) / dx;
  const row = (/** @type {number} */ node) => (y[node] - range.y[0]) / dy;
  for (const [first, ...others] of faces)
    for (let index = 1; index < others.length; index += 1) {
      const nodes = [first, others[index - 1], others[index]];
      fill(z, nodes.map(column), nodes.map(row), nodes.map((node) => values[node]));
    }
  return { x0: range.x[0], dx, y0: range.y[0], dy, z };
}

/**
 * Fills a triangle.
 * @param {(number | null)[][]} z
 * @param {number[]} u columns of its corners
 * @param {number[]} v rows
 * @param {number[]} values
 */
function fill(z, u, v, values) {
  const area = (u[1] - u[0]) * (v[2] - v[0]) - (u[2] - u[0]) * (v[1] - v[0]);
  if (area === 0) return;
  const [first, last] = [Math.max(0, Math.ceil(Math.min(...v))), Math.min(z.length - 1, Math.floor(Math.max(...v)))];
  const [left, right] = [Math.max(0, Math.ceil(Math.min(...u))), Math.min(z[0].length - 1, Math.floor(Math.max(...u)))];
  for (let row = first; row <= last; row += 1)
    for (let column = left; column <= right; column += 1) {
      const one = ((u[1] - column) * (v[2] - row) - (u[2] - column) * (v[1] - row)) / area;
      const two = ((u[2] - column) * (v[0] - row) - (u[0] - column) * (v[2] - row)) / area;
      const three = 1 - one - two;
      // Round-off at shared edges would leave gaps.
      if (Math.min(one, two, three) > -1e-9) z[row][column] = one * values[0] + two * values[1] + three * values[2];
    }
}
