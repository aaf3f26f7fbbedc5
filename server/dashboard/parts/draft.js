// Drafts of forms, kept while the tab is open: over reloads, and for each step of the browser's history.

import { store, stored } from "./tab_storage.js";

/** The draft of the present step of the history; another step has another one. */
export class Draft {
  #key;

  constructor() {
    const name = history.state?.draft ?? `${Date.now()} ${Math.random()}`;
    history.replaceState({ ...history.state, draft: name }, "");
    this.#key = `draft ${name}`;
  }

  /** What was typed before; null where nothing was. @returns {any} */
  get typed() {
    return stored(this.#key);
  }

  /** @param {any} typed */
  keep(typed) {
    store(this.#key, typed);
  }
}
