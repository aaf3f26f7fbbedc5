// Links to files, which a browser follows without a token and which are fetched with one.

import { send } from "./client.js";
import { element } from "./element.js";

/** Time for the browser to take a file over, ms. */
const KEPT_MS = 60_000;

/**
 * Saves bytes as a file.
 * @param {Blob} blob
 * @param {string} name
 */
export function save(blob, name) {
  const url = URL.createObjectURL(blob);
  element("a", { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), KEPT_MS);
}

/**
 * A link that downloads a file of the service.
 * @param {string} path
 * @param {string} name
 * @param {string} text
 * @returns {HTMLElement}
 */
export function download_link(path, name, text) {
  return element("a", {
    href: path,
    download: name,
    click: async (/** @type {Event} */ event) => {
      if (!sessionStorage.getItem("token")) return;
      event.preventDefault();
      save(await (await send(path)).blob(), name);
    },
  }, text);
}
