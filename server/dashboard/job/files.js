// The files of a job, each with its link to copy.

import { download_link } from "../parts/download.js";
import { card, element, table } from "../parts/element.js";
import { size } from "../parts/format.js";

/**
 * @param {any} listed manifest of the results
 * @returns {HTMLElement | null}
 */
export function files_card({ files, links }) {
  if (files.length === 0) return null;
  const copy = (/** @type {string} */ path) => {
    const button = element("button", { type: "button", class: "quiet", "aria-label": `copy the link of ${path}` }, "copy link");
    button.addEventListener("click", () => show_link(button, new URL(path, location.href).href));
    return button;
  };
  const archive = [download_link(links.archive, "results.zip", "all of them (zip)"), "", copy(links.archive)];
  const rows = files.map((/** @type {any} */ { name, bytes }) => [download_link(links[name], name, name), size(bytes), copy(links[name])]);
  return card("Files", element("details", {}, element("summary", {}, `${files.length} files`), table({ head: ["name", "size", ""], rows: [archive, ...rows], numbers: [1] })));
}

/**
 * Copies a link; where the browser forbids it, as on pages without encryption, the link is shown to be copied by hand.
 * @param {HTMLElement} button
 * @param {string} link
 */
async function show_link(button, link) {
  try {
    await navigator.clipboard.writeText(link);
    button.textContent = "copied";
  } catch {
    const shown = /** @type {HTMLInputElement} */ (element("input", { type: "text", readonly: true, value: link, "aria-label": "link to copy" }));
    button.replaceWith(shown);
    shown.select();
  }
}
