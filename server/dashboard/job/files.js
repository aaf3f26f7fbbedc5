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
    button.addEventListener("click", async () => {
      await navigator.clipboard.writeText(new URL(path, location.href).href);
      button.textContent = "copied";
    });
    return button;
  };
  const rows = files.map((/** @type {any} */ { name, bytes }) => [download_link(links[name], name, name), size(bytes), copy(links[name])]);
  return card("Files", element("details", {}, element("summary", {}, `${files.length} files`), table({ head: ["name", "size", ""], rows, numbers: [1] })));
}
