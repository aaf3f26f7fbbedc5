// The list of sweeps and accuracy studies, live.

import { address, change, link } from "../parts/address.js";
import { element } from "../parts/element.js";
import { follow } from "../parts/feed.js";
import { throttled } from "../parts/throttled.js";
import { batches } from "./list.js";
import { Row } from "./row.js";

/** Least time between loads of the list, and time between updates of the ages, ms. */
const RELOAD_MS = 500;
const AGE_MS = 10_000;
const HEAD = ["name", "kind", "state", "jobs", "progress", "age", ""];
const KIND_CHOICES = [["", "sweeps and accuracy studies"], ["sweep", "sweeps"], ["accuracy", "accuracy studies"]];

/** @type {import("../main.js").Page} */
export async function batches_page(content, _address, signal) {
  document.title = "Sweeps · fretwear";
  /** @type {Map<string, Row>} */
  const rows = new Map();
  const said = element("span", { role: "status" });
  const body = element("tbody");
  const more = element("p", { class: "more" });
  const kind = /** @type {HTMLSelectElement} */ (element("select", { id: "kind" }, ...KIND_CHOICES.map(([value, text]) => element("option", { value }, text))));
  kind.addEventListener("change", () => change({ kind: kind.value, page: null }));
  content.append(element("h1", {}, "Sweeps and accuracy studies"),
    element("p", { class: "line" }, element("label", { for: "kind" }, "Show "), kind, element("a", { href: link("study", null, { as: "sweep" }) }, "New sweep"), element("a", { href: link("study", null, { as: "accuracy" }) }, "New accuracy study"), said),
    element("div", { class: "scroll" }, element("table", { class: "batches" },
      element("thead", {}, element("tr", {}, ...HEAD.map((text, column) => element("th", { scope: "col", class: column === 5 && "number" }, text)))), body)), more);

  const reload = throttled(() => load(), RELOAD_MS, signal);
  const then = { said, cancelled: reload, deleted: reload };
  let asked = 0;
  async function load() {
    const call = ++asked;
    const values = address().values;
    kind.value = values.get("kind") ?? "";
    const page = await batches(values, signal);
    // An older answer may come later.
    if (call !== asked) return;
    const listed = page.batches.map(({ batch, kind }) => {
      const row = rows.get(batch.id) ?? new Row(batch, kind, then);
      row.update(batch);
      return /** @type {[string, Row]} */ ([batch.id, row]);
    });
    rows.clear();
    for (const [id, row] of listed) rows.set(id, row);
    place(body, listed.map(([, row]) => row.node));
    more.replaceChildren(...paging(page.next, listed.length, values));
  }
  await load();

  /** Last known status of each job. @type {Map<string, string>} */
  const statuses = new Map();
  follow({
    changed: ({ id, status }) => {
      if (statuses.get(id) !== status) reload();
      statuses.set(id, status);
    },
    deleted: reload,
    reset: reload,
    started: reload,
  }, signal);
  const timer = setInterval(() => rows.forEach((row) => row.show_age()), AGE_MS);
  signal.addEventListener("abort", () => clearInterval(timer));
  return load;
}

/**
 * Shows rows in an order; those that stay where they are keep the focus.
 * @param {HTMLElement} body
 * @param {HTMLElement[]} nodes
 */
function place(body, nodes) {
  for (const child of [...body.children]) if (!nodes.includes(/** @type {HTMLElement} */ (child))) child.remove();
  nodes.forEach((node, index) => body.children[index] !== node && body.insertBefore(node, body.children[index] ?? null));
}

/**
 * @param {string | null} next
 * @param {number} shown
 * @param {URLSearchParams} values
 * @returns {(Node | string)[]}
 */
function paging(next, shown, values) {
  const links = [];
  if (values.get("page")) links.push(element("a", { href: link("sweeps", null, { kind: values.get("kind") }) }, "newest"));
  if (next) links.push(element("button", { type: "button", click: () => change({ page: next }) }, "older"));
  if (shown === 0) links.push("None here yet: a sweep solves many variations of one specification, an accuracy study one specification at many accuracies.");
  return links;
}
