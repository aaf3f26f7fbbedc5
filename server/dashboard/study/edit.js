// Changes of a specification at a JSON pointer, and what is shown of it together with its defaults.

/** @param {string} pointer @returns {string[]} */
const keys_of = (pointer) => pointer.split("/").slice(1).map((key) => key.replaceAll("~1", "/").replaceAll("~0", "~"));

/** @param {any} value */
const is_object = (value) => value !== null && typeof value === "object" && !Array.isArray(value);

/**
 * The value at a pointer; undefined if there is none.
 * @param {any} document
 * @param {string} pointer
 * @returns {any}
 */
export function value_at(document, pointer) {
  return keys_of(pointer).reduce((at, key) => (at === null || typeof at !== "object" ? undefined : at[key]), document);
}

/**
 * A specification with another value at a pointer, or without one if that is undefined. Lists, and objects that must be complete,
 * are taken from what is shown where the specification does not contain them; other defaults stay defaults.
 * @param {any} spec
 * @param {any} shown
 * @param {import("./schema.js").Shape} shape
 * @param {string} pointer
 * @param {unknown} value
 * @returns {any}
 */
export function set_value(spec, shown, shape, pointer, value) {
  const keys = keys_of(pointer);
  const changed = structuredClone(spec);
  let [at, known] = [changed, shown];
  /** @type {import("./schema.js").Shape | null | undefined} */
  let of = shape;
  for (const key of keys.slice(0, -1)) {
    known = known?.[key];
    of = part(of, key);
    const is_whole = of?.items || (object_form(of)?.required.length ?? 0) > 0 || Array.isArray(known);
    if (at[key] === null || typeof at[key] !== "object") at[key] = is_whole && known != null ? whole(known) : of?.items ? [] : {};
    at = at[key];
  }
  const last = keys[keys.length - 1];
  for (const other of value === undefined ? [] : object_form(of)?.excluded_by(last) ?? []) delete at[other];
  if (value !== undefined) at[last] = value;
  else if (Array.isArray(at)) at.splice(Number(last), 1);
  else delete at[last];
  return changed;
}

/**
 * A copy of resolved values; a material of the library is its name.
 * @param {any} value
 * @returns {any}
 */
function whole(value) {
  if (Array.isArray(value)) return value.map(whole);
  if (!is_object(value)) return value;
  return Object.fromEntries(Object.entries(value).map(([key, item]) => [key, key === "material" && item?.name ? item.name : whole(item)]));
}

/**
 * The shape of a part.
 * @param {import("./schema.js").Shape | null | undefined} shape
 * @param {string} key
 */
function part(shape, key) {
  const object = object_form(shape);
  return object?.items ?? object?.fields?.[key];
}

/**
 * The form with fields of a value that may be a name or an object.
 * @param {import("./schema.js").Shape | null | undefined} shape
 */
function object_form(shape) {
  return shape?.forms.find((form) => form.fields) ?? shape;
}

/**
 * What is shown of a specification: its own values over its defaults, as far as those still apply.
 * @param {any} given
 * @param {any} known the resolved defaults
 * @param {import("./schema.js").Shape | null | undefined} shape
 * @returns {any}
 */
export function with_defaults(given, known, shape) {
  if (given === undefined) return known;
  if (typeof given === "string" && known?.name === given) return known;
  if (Array.isArray(given) && Array.isArray(known))
    return given.map((item, index) => (given.length === known.length ? with_defaults(item, known[index], part(shape, String(index))) : item));
  if (!is_object(given) || !is_object(known)) return given;
  const tag = shape?.tag;
  if (tag && given[tag] !== undefined && given[tag] !== known[tag]) return given;
  const replaced = Object.keys(given).flatMap((key) => object_form(shape)?.excluded_by(key) ?? []);
  const defaults = Object.entries(known).filter(([key]) => !replaced.includes(key));
  const names = [...new Set([...defaults.map(([key]) => key), ...Object.keys(given)])];
  return Object.fromEntries(names.map((key) => [key, with_defaults(given[key], Object.fromEntries(defaults)[key], part(shape, key))]));
}
