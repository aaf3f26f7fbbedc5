// Plotly.js, loaded when the first chart is drawn.

import { request } from "../parts/connection.js";

/** @type {Promise<any> | null} */
let loading = null;

/**
 * The library.
 * @returns {Promise<any>}
 */
export function plotly() {
  loading ??= new Promise((resolve, reject) => {
    const script = document.createElement("script");
    script.src = new URL("../plotly.js", import.meta.url).href;
    script.addEventListener("load", () => resolve(/** @type {any} */ (window).Plotly));
    script.addEventListener("error", () => {
      loading = null;
      // Says whether the service is away, or only that file.
      request(script.src).then((answer) => (answer.ok ? resolve(plotly()) : reject(new Error("the library of charts could not be loaded"))), reject);
    });
    document.head.append(script);
  });
  return loading;
}
