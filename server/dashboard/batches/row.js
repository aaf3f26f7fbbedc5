// A batch in the list.

import { link } from "../parts/address.js";
import { element } from "../parts/element.js";
import { duration, seconds_between, time } from "../parts/format.js";
import { end_button } from "./actions.js";
import { counts_line, counts_with_later, progress_line, state, state_badge } from "./counts.js";
import { KINDS, name_of } from "./kinds.js";

/** A row of the table, which follows its batch. */
export class Row {
  #state = element("td");
  #counts = element("td");
  #progress = element("td");
  #age;
  #end = element("td");
  #shown = "";
  #then;
  #batch;

  /**
   * @param {any} batch
   * @param {import("./kinds.js").Kind} kind
   * @param {Parameters<typeof end_button>[2]} then
   */
  constructor(batch, kind, then) {
    this.#then = then;
    this.#batch = batch;
    this.kind = kind;
    this.#age = element("td", { class: "number", title: time(batch.created_at) });
    this.node = element("tr", { "data-batch": batch.id },
      element("td", { class: "name" }, element("a", { href: link(KINDS[kind].page, batch.id) }, name_of(batch, kind))),
      element("td", {}, KINDS[kind].name), this.#state, this.#counts, this.#progress, this.#age, this.#end);
    this.update(batch);
  }

  /** @param {any} batch */
  update(batch) {
    this.show_age();
    const counts = counts_with_later(batch);
    const shown = JSON.stringify(counts);
    if (shown === this.#shown) return;
    this.#shown = shown;
    this.node.className = state(counts);
    this.#state.replaceChildren(state_badge(counts));
    this.#counts.replaceChildren(counts_line(counts));
    this.#progress.replaceChildren(progress_line(counts, name_of(batch, this.kind)));
    this.#end.replaceChildren(end_button(batch, this.kind, this.#then));
  }

  show_age() {
    this.#age.textContent = duration(Math.round(seconds_between(this.#batch.created_at)));
  }
}
