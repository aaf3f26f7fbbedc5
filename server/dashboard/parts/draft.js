// Drafts of forms, kept while the tab is open: over reloads, and for each step of the browser's history.

const PREFIX = "draft ";

/** The draft of the present step of the history; another step has another one. */
export class Draft {
  #key;

  constructor() {
    const name = history.state?.draft ?? `${Date.now()} ${Math.random()}`;
    history.replaceState({ ...history.state, draft: name }, "");
    this.#key = PREFIX + name;
  }

  /** What was typed before; null where nothing was. @returns {any} */
  get typed() {
    return JSON.parse(sessionStorage.getItem(this.#key) ?? "null");
  }

  /** @param {any} typed */
  keep(typed) {
    const text = JSON.stringify(typed);
    try {
      sessionStorage.setItem(this.#key, text);
    } catch {
      // No space is left: those of other steps give way.
      for (const key of Object.keys(sessionStorage)) if (key.startsWith(PREFIX)) sessionStorage.removeItem(key);
      try {
        sessionStorage.setItem(this.#key, text);
      } catch {
        // It is larger than what a browser keeps.
      }
    }
  }
}
