// The numbers of a fit as rows of a table, for both pages.
import { make, modulusUnit, range, significant } from "./format.js";

const sub = (letter, index) => [make("i", {}, letter), make("sub", {}, index)];

// Moduli, stiffnesses or forces, whichever this fit has: letter, unit and how they are shown.
function scaleOf(fit) {
  if ("E0_Pa" in fit) return { stem: "E", suffix: "_Pa", ...modulusUnit(fit.E0_Pa) };
  if ("K0_N_m" in fit) return { stem: "K", suffix: "_N_m", factor: 1, unit: "N/m" };
  return { stem: "F", suffix: "_N", factor: 1, unit: "N" };
}

// [nodes of the name, estimate, interval] of each.
export function rowsOf(fit) {
  const { stem, suffix, factor, unit } = scaleOf(fit);
  const rows = ["0", "_inf"].map((which) => [
    sub(stem, which === "0" ? "0" : "∞"),
    `${significant(fit[`${stem}${which}${suffix}`] * factor, 5)} ${unit}`,
    `${range(fit[`${stem}${which}_interval_95`], factor, 5)} ${unit}`]);
  fit.terms.forEach((term, i) => {
    rows.push([sub("g", String(i + 1)), significant(term.g, 4), range(term.interval_95.g)]);
    rows.push([sub("τ", String(i + 1)), `${significant(term.tau_s, 4)} s`, `${range(term.interval_95.tau_s)} s`]);
  });
  return rows;
}

export function showModuli(table, fit) {
  table.tBodies[0].replaceChildren(...rowsOf(fit).map(([name, value, interval]) =>
    make("tr", {}, make("th", { scope: "row" }, ...name), make("td", { class: "number" }, value),
         make("td", { class: "number" }, interval))));
}
