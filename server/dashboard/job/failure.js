// Why a job has failed, and what can be done.

import { link } from "../parts/address.js";
import { element } from "../parts/element.js";
import { words } from "../parts/format.js";

/** What to do, by outcome. @type {Record<string, string>} */
const ADVICE = {
  not_converged: "The same input fails again. Clone the job and change what the message names: a lower load or friction, smaller increments (accuracy / overrides / increments per cycle) or another accuracy.",
  worker_lost: "The process that solved it was lost, which is no fault of the specification. Run it again: it continues from its last checkpoint.",
  out_of_memory: "It needed more memory than a job may have. Clone it with a coarser accuracy or a smaller model, or start the service with a higher --job-memory-mb.",
  deadline_exceeded: "It was not done by its deadline. Run it again, which sets the deadline anew and continues from the last checkpoint, or submit it with a longer one.",
};

/**
 * @param {any} job
 * @returns {HTMLElement | null}
 */
export function failure_card(job) {
  if (job.status !== "failed") return null;
  return element("section", { class: "card failure", role: "alert", "aria-label": "Failure" },
    element("h2", {}, `Failed: ${words(job.outcome ?? "unknown outcome")}`),
    element("p", {}, job.status_reason ?? ""),
    element("p", {}, ADVICE[job.outcome] ?? "Clone the job, change its specification, and submit it again.", " ",
      element("a", { href: link("study", null, { from: job.id }) }, "Clone and change")),
    element("p", { class: "muted" }, job.progress.cycle > 0 ? "The results below are those up to the failure." : "It failed before its first cycle: there are no results."));
}
