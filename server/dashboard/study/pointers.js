// What the schema of a specification says of the values at a pointer: choices and kinds of numbers, for fields that a sweep varies.

import { fetch_json } from "../parts/client.js";

/** @type {Map<string, Promise<any>>} */
const schemas = new Map();

/**
 * The JSON schema of a system.
 * @param {string} kind
 * @param {AbortSignal} signal
 * @returns {Promise<any>}
 */
export function schema_of(kind, signal) {
  const known = schemas.get(kind) ?? fetch_json(`/v1/systems/${encodeURIComponent(kind)}`, { signal }).then(({ schema }) => schema);
  known.catch(() => schemas.delete(kind));
  schemas.set(kind, known);
  return known;
}

/**
 * The forms that a value can have, references followed.
 * @param {any} schema
 * @param {any} form
 * @returns {any[]}
 */
function forms(schema, form) {
  const { $ref, oneOf, anyOf } = form;
  const parts = oneOf ?? anyOf ?? ($ref ? [schema.$defs?.[$ref.split("/").pop()] ?? {}] : null);
  return parts ? parts.flatMap((/** @type {any} */ part) => forms(schema, part)) : [form];
}

/**
 * The forms that the value at a pointer can have.
 * @param {any} schema
 * @param {string} pointer
 * @returns {any[]}
 */
function forms_at(schema, pointer) {
  const step = (/** @type {any} */ form, /** @type {string} */ key) => form.properties?.[key] ?? (/^\d+$/.test(key) ? form.items : null) ?? form.additionalProperties;
  return pointer.split("/").slice(1).reduce((found, key) => found.flatMap((form) => {
    const next = step(form, key);
    return next && typeof next === "object" ? forms(schema, next) : [];
  }), [schema]);
}

/**
 * The words that a field can be; none where it is no choice.
 * @param {any} schema
 * @param {string} pointer
 * @returns {string[]}
 */
export function choices_of(schema, pointer) {
  const found = forms_at(schema, pointer).flatMap((form) => form.enum ?? (form.const === undefined ? [] : [form.const]));
  return [...new Set(found)].filter((choice) => typeof choice === "string");
}

/**
 * Whether a field is a whole number.
 * @param {any} schema
 * @param {string} pointer
 * @returns {boolean}
 */
export function is_count(schema, pointer) {
  const types = forms_at(schema, pointer).flatMap(({ type }) => type ?? []).filter((type) => type !== "null");
  return types.length > 0 && types.every((type) => type === "integer");
}
