// Elements of the document. Text is never parsed as markup.

/** @typedef {Node | string | number | null | undefined | false} Child */

/**
 * An element with attributes and children; attributes that are null or false and children that are empty are left out,
 * functions are listeners.
 * @param {string} name
 * @param {Record<string, any>} [attributes]
 * @param {...(Child | Child[])} children
 * @returns {HTMLElement}
 */
export function element(name, attributes = {}, ...children) {
  const node = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (typeof value === "function") node.addEventListener(key, value);
    else if (value === true) node.setAttribute(key, "");
    else if (value != null && value !== false) node.setAttribute(key, String(value));
  }
  append(node, children);
  return node;
}

/**
 * Appends children to an element.
 * @param {Element} node
 * @param {(Child | Child[])[]} children
 */
function append(node, children) {
  for (const child of children.flat())
    if (child != null && child !== false) node.append(child instanceof Node ? child : String(child));
}

/**
 * A list of names and values, without those that have none.
 * @param {[string, Child][]} entries
 * @returns {HTMLElement}
 */
export function definitions(entries) {
  const present = entries.filter(([, value]) => value != null && value !== "");
  return element("dl", {}, ...present.flatMap(([name, value]) => [element("dt", {}, name), element("dd", {}, value)]));
}

/**
 * A table; cells that are numbers stand at the right.
 * @param {{head: string[], rows: Child[][], numbers?: number[]}} content
 * @returns {HTMLElement}
 */
export function table({ head, rows, numbers = [] }) {
  const cell = (/** @type {string} */ name) => (/** @type {Child} */ content, /** @type {number} */ column) =>
    element(name, { class: numbers.includes(column) && "number", scope: name === "th" && "col" }, content);
  return element("div", { class: "scroll", tabindex: "0" },
    element("table", {},
      element("thead", {}, element("tr", {}, ...head.map(cell("th")))),
      element("tbody", {}, ...rows.map((row) => element("tr", {}, ...row.map(cell("td")))))));
}

/**
 * A part of a page with its heading.
 * @param {string} title
 * @param {...Child} children
 * @returns {HTMLElement}
 */
export function card(title, ...children) {
  return element("section", { class: "card", "aria-label": title }, element("h2", {}, title), ...children);
}
