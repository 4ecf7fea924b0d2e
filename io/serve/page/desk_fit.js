// The fit of a table: data with curve, residuals, moduli, flags, number of terms.
import { Chart, thinned } from "./charts.js";
import { axisOf, element, make, nameLogSwitch, sentence, show, showText, significant } from "./format.js";
import { showParts, withCurves } from "./desk_tests.js";
import { showModuli } from "./moduli.js";

const kMostPoints = 3000;
const isLog = (id) => element(id).checked;
const logs = () => ({ x: isLog("log-x"), y: isLog("log-y") });

let fit = null, fitChart = null, residualChart = null, window_s = null;

// Less is shown than was fitted.
const isZoomed = () => Boolean(fitChart?.graph?.isZoomed("x"));

// The part of the time that the chart shows, as values of --from and --to.
export const shownRange = () => window_s.map((t) => `${Number(Math.max(t, 0).toPrecision(4))} s`);

// Charts know their columns from the beginning, so each fit has new ones.
function drawCharts() {
  if (element("fit-chart").clientHeight === 0) return;  // hidden: a chart would take a size of its own
  for (const chart of [fitChart, residualChart]) if (chart) chart.close();
  const { argument, values, columns } = fit.curves;
  nameLogSwitch("log-x-name", argument);
  const several = columns.length > 1;
  const names = columns.flatMap(({ name }) => (several ? [`${name} data`, `${name} fit`] : ["data", "fit"]));
  const unit = argument === "time_s" ? "s" : "Hz";
  const fits = (x) => !isLog("log-x") || x > 0;
  const largest = columns.flatMap((one) => one.fitted).reduce((most, y) => Math.max(most, Math.abs(y)), 0);
  const axis = axisOf(columns[0].name, largest);
  const rows = values.map((x, i) => [x, ...columns.flatMap((one) => [axis.factor * one.measured[i], axis.factor * one.fitted[i]])])
    .filter((row) => fits(row[0]) && (!isLog("log-y") || row.slice(1).every((y) => y > 0)));
  fitChart = new Chart(element("fit-chart"), {
    labels: [argument, ...names], colors: names.map((name) => (name.endsWith("data") ? "measured" : "fit")),
    points: names.filter((name) => name.endsWith("data")), logs,
    units: [unit, ...names.map(() => axis.unit)], file: () => `${element("table-name").textContent.replace(/\.[^.]*$/, "")} fit`,
    titles: { xlabel: axisOf(argument).label, ylabel: several ? `modulus (${axis.unit})` : axis.label },
    onWindow: (range) => { residualChart?.showWindow(range); window_s = range; element("fit-range").disabled = argument !== "time_s" || !isZoomed(); },
    readout: (x, i) => {
      const row = x === null ? null : fitChart.data[i];
      element("fit-readout").textContent = !row ? ""
        : `${significant(row[0], 4)} ${unit}: ${row.slice(1).map((y, k) => `${names[k]} ${significant(y, 5)}`).join(", ")} ${axis.unit}`;
    },
  });
  const residuals = values.map((x, i) => [x, ...columns.map((one) => (one.measured[i] - one.fitted[i]) / (one.sigma[i] || 1))])
    .filter((row) => fits(row[0]));
  const labels = columns.map(({ name }) => `residual of ${name}`);
  residualChart = new Chart(element("residual-chart"), {
    labels: [argument, ...labels], colors: ["depth", "force"].slice(0, labels.length), points: labels, band: [-2, 2],
    logs: () => ({ x: isLog("log-x"), y: false }),
    titles: { ylabel: "residual" },
    onWindow: (range) => fitChart && fitChart.showWindow(range),
    range: () => {
      const largest = Math.max(3, ...residualChart.data.flatMap((row) => row.slice(1).map(Math.abs)));
      return [-1.1 * largest, 1.1 * largest];
    },
  });
  residualChart.show(thinned(residuals, kMostPoints));
  fitChart.show(thinned(rows, kMostPoints));
}

// One view shows fits of several kinds.
export function showBody(id) {
  for (const body of ["fit-body", "ratio-body", "rubber-body"]) show(element(body), body === id);
}

export function showJudgement({ trustworthy, flags }) {
  const status = element("fit-status");
  status.className = !trustworthy ? "alert" : flags.length > 0 ? "note" : "good";
  showText(status, !trustworthy ? "Do not trust this fit before you have opened the words beside the numbers."
    : flags.length > 0 ? "The fit may be used; the words beside the numbers open what to keep in mind." : "The fit describes the data.");
}

export function showFlags(node, flags) {
  const seen = [...new Set(flags.map((flag) => flag.name))];
  node.replaceChildren(...seen.map((name) => {
    const texts = flags.filter((flag) => flag.name === name).map((flag) => sentence(flag.text));
    return make("details", {}, make("summary", {}, name.replaceAll("-", " ")), ...texts.map((text) => make("p", {}, text)));
  }));
}

// onTerms(number as text, or undefined: the data choose).
function showOrders(chosen, onTerms) {
  const button = (text, value, title) => {
    const one = make("button", { type: "button", title, "aria-pressed": String(chosen === value) }, text);
    one.addEventListener("click", () => onTerms(value));
    return one;
  };
  const best = Math.min(...fit.orders.map((row) => row.bic));
  const rows = fit.orders.slice(0, 16);
  element("orders").replaceChildren("Terms:", button(`chosen by the data (${chosen ? "…" : fit.terms.length})`, undefined, ""),
    ...rows.map((row) => button(String(row.n_terms), String(row.n_terms),
                                `BIC ${significant(row.bic - best, 3)} above the least, squares ${significant(row.rss, 4)}`)));
}

let orders = [];

export function showFit(result, chosenTerms, onTerms) {
  fit = withCurves(result);
  // With a number of terms given the ladder has that row alone; the earlier one stays.
  if (chosenTerms === undefined || orders.length === 0) orders = fit.orders;
  fit = { ...fit, orders };
  showJudgement(fit);
  showModuli(element("moduli"), fit);
  showParts(fit);
  element("fit-note").textContent = `${fit.n_samples} samples, ${fit.n_left_out ?? 0} rows left out. Intervals cover the scatter`
    + (fit.systematic_relative ? `; geometry and frame add ${significant(100 * fit.systematic_relative, 2)} % to E0.` : ".");
  showFlags(element("flags"), fit.flags);
  showOrders(chosenTerms, onTerms);
  showBody("fit-body");
  drawCharts();
}

export function forgetOrders() {
  orders = [];
}

export function showFitState(text, kind) {
  const status = element("fit-status");
  status.className = kind;
  showText(status, text);
  if (kind === "alert") showBody(null);
}

// The charts have no size while their view is hidden.
export function redrawFit() {
  if (fit && !element("fit-body").hidden) drawCharts();
}

for (const id of ["log-x", "log-y"]) element(id).addEventListener("change", redrawFit);
