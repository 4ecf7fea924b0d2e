// Several records in one picture, each in its colour, with their fits or without; and their numbers side by side.
import { Chart, thinned } from "./charts.js";
import { axisOf, element, make, nameLogSwitch, significant } from "./format.js";
import { rowsOf } from "./moduli.js";

const kColors = 6, kMostPoints = 9000;  // of all together

export const kMostCurves = 2 * kColors;  // the second half is dashed

const largestOf = (values) => values.reduce((most, y) => Math.max(most, Math.abs(y ?? 0)), 0);

// The key of curve k in a list or table.
export const keyOf = (k) => make("span", { class: `key series-${1 + (k % kColors)}${k < kColors ? "" : " dashed"}` });

// How the switches of a page stand: PREFIX-log-x, -log-y, -relative, -fit.
const isSet = (prefix, name) => element(`${prefix}-${name}`).checked;
export function startOverlay(prefix, draw) {
  for (const name of ["log-x", "log-y", "relative", "fit"]) element(`${prefix}-${name}`).addEventListener("change", draw);
}

// The chart in PREFIX-chart. curves: [{name, place, x, measured, fit_x, fitted}], the last two only of those with a fit, place:
// that of its colour, if not its own; of quantity against argument, which name their units. file(): as a chart has it. With its
// fit a record is points, otherwise a line.
export function overlay(prefix, curves, { argument, quantity, xlabel, file }) {
  const logs = () => ({ x: isSet(prefix, "log-x"), y: isSet(prefix, "log-y") });
  const isRelative = isSet(prefix, "relative"), withFit = isSet(prefix, "fit");
  nameLogSwitch(`${prefix}-log-x-name`, argument);
  const axis = isRelative ? { factor: 1, unit: "", label: "relative value" } : axisOf(quantity, largestOf(curves.flatMap((one) => one.fitted ?? one.measured)));
  const parts = curves.flatMap((one, i) => {
    const k = one.place ?? i, factor = isRelative ? 1 / largestOf(one.fitted ?? one.measured) : axis.factor, hasFit = withFit && one.fitted;
    const part = (label, x, y, isPoints) => ({ label, k, isPoints, rows: thinned(x.map((at, j) => [at, y[j] === null ? null : y[j] * factor])
      .filter(([at, value]) => value !== null && (!logs().x || at > 0) && (!logs().y || value > 0)), Math.max(200, kMostPoints / curves.length)) });
    return [part(`${one.name} data`, one.x, one.measured, Boolean(hasFit)), ...(hasFit ? [part(`${one.name} fit`, one.fit_x, one.fitted, false)] : [])];
  });
  const rows = parts.flatMap((part, j) => part.rows.map(([x, y]) => {
    const row = new Array(1 + parts.length).fill(null);
    [row[0], row[j + 1]] = [x, y];
    return row;
  })).sort((a, b) => a[0] - b[0]);
  const { unit } = axisOf(argument);
  const chart = new Chart(element(`${prefix}-chart`), {
    labels: [argument, ...parts.map((part) => part.label)], colors: parts.map((part) => `series-${1 + (part.k % kColors)}`),
    points: parts.filter((part) => part.isPoints).map((part) => part.label), logs, file,
    dashes: Object.fromEntries(parts.filter((part) => part.k >= kColors).map((part) => [part.label, [7, 4]])),
    units: [unit, ...parts.map(() => axis.unit)],
    titles: { xlabel: xlabel ?? axisOf(argument).label, ylabel: axis.label },
    readout: (x) => { element(`${prefix}-readout`).textContent = x === null ? "" : `${significant(x, 4)} ${unit}`; },
  });
  chart.show(rows);
  return chart;
}

// One column of moduli for each: [{name, key, fit}].
export function showModuliBeside(table, columns) {
  const head = make("tr", {}, make("th", { scope: "col" }, "Quantity"),
                    ...columns.map(({ name, key }) => make("th", { scope: "col", class: "number" }, ...(key ? [key] : []), name)));
  const all = columns.map(({ fit }) => rowsOf(fit));
  const longest = all.reduce((most, rows) => (rows.length > most.length ? rows : most), []);
  const body = longest.map(([label], i) => make("tr", {}, make("th", { scope: "row" }, ...label.map((node) => node.cloneNode(true))),
    ...all.map((rows) => make("td", { class: "number" }, ...(rows[i] ? [rows[i][1], make("br"), make("small", {}, rows[i][2])] : [])))));
  table.tHead.replaceChildren(head);
  table.tBodies[0].replaceChildren(...body);
}
