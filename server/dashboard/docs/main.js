// Renders /openapi.json: operations by tag, then the schemas of their documents.

import { fetch_json } from "../parts/client.js";
import { element } from "../parts/element.js";

// Order of the tags on the page.
const TAGS = ["jobs", "results", "sweeps", "studies", "plans", "systems", "operation", "pages"];
const METHODS = ["get", "post", "put", "patch", "delete"];

/**
 * Summarizes a schema; named schemas are links.
 * @param {any} schema
 * @returns {(Node | string)[]}
 */
function summarize(schema) {
  if (schema === undefined || schema === true) return ["anything"];
  if (schema.$ref) {
    const name = schema.$ref.split("/").pop();
    return [element("a", { href: `#schema-${name}` }, name)];
  }
  const choices = schema.oneOf ?? schema.anyOf ?? schema.allOf;
  if (choices) return choices.flatMap((/** @type {any} */ choice, /** @type {number} */ index) => (index ? [" or ", ...summarize(choice)] : summarize(choice)));
  if (schema.enum) return [schema.enum.map((/** @type {unknown} */ value) => JSON.stringify(value)).join(", ")];
  if (schema.const !== undefined) return [JSON.stringify(schema.const)];
  const types = [schema.type ?? "anything"].flat();
  if (types.includes("array")) return ["list of ", ...summarize(schema.items)];
  if (types.includes("object") && typeof schema.additionalProperties === "object")
    return ["map to ", ...summarize(schema.additionalProperties)];
  return [types.join(" or "), ...(schema.format ? [` (${schema.format})`] : [])];
}

/** @param {any} content by media type */
function render_bodies(content) {
  return Object.entries(content ?? {}).map(([media, { schema }]) =>
    element("div", { class: "muted" }, `${media}: `, ...summarize(schema)));
}

/** @param {any[][]} entries */
function render_table(entries) {
  return element("table", {}, element("tbody", {}, ...entries.map((cells) =>
    element("tr", {}, ...cells.map((cell) => element("td", {}, ...[cell].flat()))))));
}

/**
 * @param {string} path
 * @param {string} method
 * @param {any} operation
 */
function render_operation(path, method, operation) {
  const parts = [];
  if (operation.description) parts.push(element("p", {}, operation.description));
  if (operation.parameters?.length)
    parts.push(render_table(operation.parameters.map((/** @type {any} */ parameter) => [
      element("code", {}, parameter.name),
      `${parameter.in}${parameter.required ? ", required" : ""}`,
      summarize(parameter.schema),
      parameter.description ?? "",
    ])));
  if (operation.requestBody) parts.push(element("p", {}, "Body"), ...render_bodies(operation.requestBody.content));
  parts.push(render_table(/** @type {[string, any][]} */ (Object.entries(operation.responses)).map(([status, response]) => [
    element("code", {}, status), [response.description, ...render_bodies(response.content)],
  ])));
  const head = element("summary", {}, element("span", { class: "method mono" }, method.toUpperCase()),
    element("code", {}, path), element("span", { class: "muted" }, `  ${operation.summary ?? ""}`));
  return element("details", {}, head, element("div", {}, ...parts));
}

/**
 * @param {string} name
 * @param {any} schema
 */
function render_schema(name, schema) {
  const required = new Set(schema.required ?? []);
  const fields = /** @type {[string, any][]} */ (Object.entries(schema.properties ?? {})).map(([field, value]) => [
    element("code", {}, field), summarize(value), required.has(field) ? "always" : "", value.description ?? "",
  ]);
  return element("details", { id: `schema-${name}` }, element("summary", {}, element("code", {}, name)),
    element("div", {}, element("p", {}, schema.description ?? ""),
      fields.length ? render_table(fields) : element("p", {}, ...summarize(schema))));
}

/** Opens the schema in the URL. */
function open_target() {
  const target = document.getElementById(location.hash.slice(1));
  if (target instanceof HTMLDetailsElement) {
    target.open = true;
    target.scrollIntoView();
  }
}

/** @param {string} id */
function part(id) {
  return /** @type {HTMLElement} */ (document.getElementById(id));
}

try {
  const api = await fetch_json("/openapi.json");
  const by_tag = new Map();
  for (const [path, methods] of Object.entries(api.paths))
    for (const method of METHODS.filter((method) => methods[method])) {
      const tag = methods[method].tags?.[0] ?? "other";
      by_tag.set(tag, [...(by_tag.get(tag) ?? []), render_operation(path, method, methods[method])]);
    }
  const rank = (/** @type {string} */ tag) => (TAGS.indexOf(tag) + TAGS.length + 1) % (TAGS.length + 1);
  for (const [tag, operations] of [...by_tag].sort(([one], [other]) => rank(one) - rank(other)))
    part("paths").append(element("h2", {}, tag), ...operations);
  for (const [name, schema] of Object.entries(api.components.schemas))
    part("schemas").append(render_schema(name, schema));
  addEventListener("hashchange", open_target);
  open_target();
} catch (error) {
  part("message").textContent = error instanceof Error ? error.message : String(error);
}
