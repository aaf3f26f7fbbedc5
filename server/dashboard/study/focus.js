// The focus of the fields over a change of them.

/** The field that has the focus, with what is typed into it, over a change of the fields. */
export class Focus {
  #input;
  #id;
  #typed;

  /** @param {HTMLElement} within */
  constructor(within) {
    this.#input = within.contains(document.activeElement) ? document.activeElement : null;
    this.#id = this.#input?.id;
    this.#typed = this.#input instanceof HTMLInputElement && this.#input.value !== this.#input.defaultValue ? this.#input.value : null;
  }

  restore() {
    const again = this.#id ? document.getElementById(this.#id) : null;
    again?.focus();
    if (again instanceof HTMLInputElement && this.#typed !== null && this.#input instanceof HTMLInputElement) again.value = this.#typed;
  }
}
