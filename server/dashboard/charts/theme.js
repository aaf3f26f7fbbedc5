// Colours of charts: those of the style sheet, which follow the reader's choice of light or dark.

/** Whether the reader has chosen dark pages. */
const DARK = matchMedia("(prefers-color-scheme: dark)");

/**
 * Colours that readers with any colour vision tell apart (Okabe and Ito 2008), lighter on dark pages.
 * @returns {string[]}
 */
export function colours() {
  return DARK.matches
    ? ["#56b4e9", "#e69f00", "#2fc99b", "#f08cc0", "#ff8a50", "#f0e442", "#a9b7ff", "#bbbbbb"]
    : ["#0072b2", "#b35900", "#00795a", "#a8437f", "#c23b00", "#7a6a00", "#4a50b8", "#555555"];
}

/**
 * A colour of the style sheet as it is shown now.
 * @param {string} name
 * @returns {string}
 */
export function colour(name) {
  document.body.style.setProperty("outline-color", `var(${name})`);
  const shown = getComputedStyle(document.body).outlineColor;
  document.body.style.removeProperty("outline-color");
  return shown;
}

/**
 * Layout that charts share.
 * @returns {any}
 */
export function layout() {
  return {
    paper_bgcolor: "transparent",
    plot_bgcolor: "transparent",
    font: { family: getComputedStyle(document.documentElement).fontFamily, size: 12, color: colour("--text") },
    margin: { l: 66, r: 14, t: 8, b: 46 },
    hovermode: "closest",
    hoverlabel: { bgcolor: colour("--surface"), bordercolor: colour("--line"), font: { color: colour("--text") } },
    modebar: { bgcolor: "transparent", color: colour("--muted"), activecolor: colour("--accent") },
    legend: { orientation: "h", y: 1.02, yanchor: "bottom", x: 0, font: { size: 11 } },
  };
}

/**
 * An axis of charts; cycles are whole numbers, and every tick of a logarithmic axis has its whole value.
 * @param {string} title
 * @param {boolean} log
 * @returns {any}
 */
export function axis(title, log) {
  const tickformat = title === "cycle" ? ",~r" : log ? "~g" : undefined;
  const line = colour("--line");
  return { title: { text: title, standoff: 8 }, type: log ? "log" : "linear", gridcolor: line, linecolor: line, zerolinecolor: line, automargin: true, exponentformat: "power", tickformat };
}

/**
 * Calls back when the reader changes between light and dark, until the signal.
 * @param {() => void} changed
 * @param {AbortSignal} signal
 */
export function on_theme(changed, signal) {
  DARK.addEventListener("change", changed, { signal });
}
