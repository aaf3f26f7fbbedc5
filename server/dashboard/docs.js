// Shows /openapi.json: operations by tag, then the documents they send and receive.

import { document_at, element } from "/assets/page.js";

// What is looked for most comes first.
const TAGS = ["jobs", "results", "sweeps", "studies", "plans", "systems", "operation", "pages"];
const METHODS = ["get", "post", "put", "patch", "delete"];

/** A schema in a few words; documents are links. */
function words(schema) {
  if (schema === undefined || schema === true) return ["anything"];
  if (schema.$ref) {
    const name = schema.$ref.split("/").pop();
    return [element("a", { href: `#schema-${name}` }, name)];
  }
  const choices = schema.oneOf ?? schema.anyOf ?? schema.allOf;
  if (choices) return choices.flatMap((choice, index) => (index ? [" or ", ...words(choice)] : words(choice)));
  if (schema.enum) return [schema.enum.map((value) => JSON.stringify(value)).join(", ")];
  if (schema.const !== undefined) return [JSON.stringify(schema.const)];
  const types = [schema.type ?? "anything"].flat();
  if (types.includes("array")) return ["list of ", ...words(schema.items)];
  if (types.includes("object") && typeof schema.additionalProperties === "object")
    return ["map to ", ...words(schema.additionalProperties)];
  return [types.join(" or "), ...(schema.format ? [` (${schema.format})`] : [])];
}

function bodies(content) {
  return Object.entries(content ?? {}).map(([media, { schema }]) =>
    element("div", { class: "soft" }, `${media}: `, ...words(schema)));
}

function rows(entries) {
  return element("table", {}, element("tbody", {}, ...entries.map((cells) =>
    element("tr", {}, ...cells.map((cell) => element("td", {}, ...[cell].flat()))))));
}

function operation(path, method, described) {
  const parts = [];
  if (described.description) parts.push(element("p", {}, described.description));
  if (described.parameters?.length)
    parts.push(rows(described.parameters.map((parameter) => [
      element("code", {}, parameter.name),
      `${parameter.in}${parameter.required ? ", required" : ""}`,
      words(parameter.schema),
      parameter.description ?? "",
    ])));
  if (described.requestBody) parts.push(element("p", {}, "Body"), ...bodies(described.requestBody.content));
  parts.push(rows(Object.entries(described.responses).map(([status, response]) => [
    element("code", {}, status), [response.description, ...bodies(response.content)],
  ])));
  const head = element("summary", {}, element("span", { class: "method mono" }, method.toUpperCase()),
    element("code", {}, path), element("span", { class: "soft" }, `  ${described.summary ?? ""}`));
  return element("details", {}, head, element("div", {}, ...parts));
}

function schema(name, described) {
  const required = new Set(described.required ?? []);
  const fields = Object.entries(described.properties ?? {}).map(([field, value]) => [
    element("code", {}, field), words(value), required.has(field) ? "always" : "", value.description ?? "",
  ]);
  return element("details", { id: `schema-${name}` }, element("summary", {}, element("code", {}, name)),
    element("div", {}, element("p", {}, described.description ?? ""),
      fields.length ? rows(fields) : element("p", {}, ...words(described))));
}

/** Opens the document that the address names. */
function opened() {
  const target = document.getElementById(location.hash.slice(1));
  if (target instanceof HTMLDetailsElement) {
    target.open = true;
    target.scrollIntoView();
  }
}

try {
  const api = await document_at("/openapi.json");
  const byTag = new Map();
  for (const [path, methods] of Object.entries(api.paths))
    for (const method of METHODS.filter((method) => methods[method])) {
      const tag = methods[method].tags?.[0] ?? "other";
      byTag.set(tag, [...(byTag.get(tag) ?? []), operation(path, method, methods[method])]);
    }
  const rank = (tag) => (TAGS.indexOf(tag) + TAGS.length + 1) % (TAGS.length + 1);
  for (const [tag, operations] of [...byTag].sort(([one], [other]) => rank(one) - rank(other)))
    document.getElementById("paths").append(element("h2", {}, tag), ...operations);
  for (const [name, described] of Object.entries(api.components.schemas))
    document.getElementById("schemas").append(schema(name, described));
  addEventListener("hashchange", opened);
  opened();
} catch (error) {
  document.getElementById("trouble").textContent = error.message;
}
