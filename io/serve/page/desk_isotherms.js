// The isotherms of a master curve, each in its colour at its shift. They are dragged sideways, or moved with arrow keys, and
// the fit starts from there.
import { Chart } from "./charts.js";
import { axisOf, element, fixed, make, show, showText } from "./format.js";

const kColors = 6, kMostPoints = 3000, kMostDecades = 40, kMostMoves = 200;
const kReach_px = 28;  // from a point to the pointer that takes it
const kStep = 0.05, kLargeStep = 0.5;  // decades of an arrow key, and with Shift
const kSidewards = { ArrowRight: 1, ArrowLeft: -1 }, kUpwards = { ArrowUp: 1, ArrowDown: -1 };

let isotherms = [], shifts = [], levels = [], reference = 0, curve = [];
let chart = null, sliders = [], chosen = null, drag = null, waits = false;
let moves = [], hasEarlier = false, onFit = () => {}, onUndo = () => {};

const isSweep = () => isotherms.some((one) => one.loss_modulus_Pa.length > 0);
// Of log10 aT in the picture: reduced time t/aT, reduced frequency f aT.
const sign = () => (isSweep() ? 1 : -1);
const columns = () => (isSweep() ? ["modulus_Pa", "loss_modulus_Pa"] : ["modulus_Pa"]);
const nameOf = (k) => `${fixed(isotherms[k].temperature_C, 1).replace(/\.0$/, "")} °C`;
const labelOf = (k, c) => `${nameOf(k)}${c > 0 ? " loss" : ""}`;
const clamped = (shift) => Math.max(-kMostDecades, Math.min(kMostDecades, shift));
const argumentAt = (k, i) => isotherms[k].argument[i] * 10 ** (sign() * shifts[k]);
const valueAt = (k, c, i) => isotherms[k][columns()[c]][i] * Math.exp(-levels[k]);

// The isotherm at a temperature as an option states it, "20 degC"; none: -1.
function indexOf(temperature) {
  const number = parseFloat(temperature), celsius = /K\s*$/.test(temperature) ? number - 273.15 : number;
  return isotherms.findIndex((one) => Math.abs(one.temperature_C - celsius) <= 1);
}

// Of isotherms of many rows not every one is drawn.
function thinned(list) {
  const total = list.reduce((sum, one) => sum + one.argument.length, 0), every = Math.ceil(total / kMostPoints);
  const some = (values) => values.filter((_, i) => i % every === 0);
  return list.map((one) => ({ ...one, argument: some(one.argument), modulus_Pa: some(one.modulus_Pa), loss_modulus_Pa: some(one.loss_modulus_Pa) }));
}

function largest() {
  return isotherms.flatMap((one) => one.modulus_Pa).reduce((most, y) => Math.max(most, Math.abs(y)), 0);
}

// Rows of the chart: x, the fit, then each isotherm's columns. Both axes are logarithmic.
function rowsOfChart() {
  const n = columns().length, width = 1 + n + isotherms.length * n, { factor } = axisOf("modulus_Pa", largest());
  const rows = [];
  const add = (x, at, y) => {
    if (!(x > 0) || !(y > 0)) return;
    const row = new Array(width).fill(null);
    row[0] = x;
    row[at] = y * factor;
    rows.push(row);
  };
  for (const [x, ...values] of curve) values.forEach((y, c) => add(x, 1 + c, y));
  isotherms.forEach((one, k) => one.argument.forEach((_, i) => {
    for (let c = 0; c < n; ++c) add(argumentAt(k, i), 1 + n + k * n + c, valueAt(k, c, i));
  }));
  return rows.sort((a, b) => a[0] - b[0]);
}

// All that is drawn; while an isotherm is dragged, the picture stands still.
function shownWindow() {
  if (drag) return drag.window;
  const data = chart.data;
  return [data[0][0] / 1.5, data[data.length - 1][0] * 1.5];
}

const sizeOf = (label) => (chosen !== null && (label === labelOf(chosen, 0) || label === labelOf(chosen, 1)) ? 4 : 2.2);

function drawChart() {
  if (chart) chart.close();
  const n = columns().length, fits = columns().map((_, c) => (c > 0 ? "fit of the loss" : "fit"));
  const labels = isotherms.flatMap((_, k) => columns().map((__, c) => labelOf(k, c)));
  chart = new Chart(element("isotherm-chart"), {
    labels: ["x", ...fits, ...labels], points: labels, sizeOf, isStill: true, window: shownWindow,
    colors: [...fits.map(() => "soft-ink"), ...labels.map((_, j) => `series-${1 + (Math.floor(j / n) % kColors)}`)],
    logs: () => ({ x: true, y: true }),
    titles: { xlabel: `${isSweep() ? "frequency × aT (Hz)" : "time / aT (s)"}, ${nameOf(reference)}`, ylabel: axisOf("modulus_Pa", largest()).label },
  });
  chart.show(rowsOfChart());
  show(element("isotherm-curve"), curve.length > 0);
}

function showShift(k) {
  const text = fixed(shifts[k], 2);
  sliders[k].lastChild.textContent = k === reference ? "reference" : text;
  if (k === reference) return;
  sliders[k].setAttribute("aria-valuenow", String(Number(shifts[k].toFixed(3))));
  sliders[k].setAttribute("aria-valuetext", `log10 of the shift factor ${text}`);
}

function showUndo() {
  element("isotherm-undo").disabled = moves.length === 0 && !hasEarlier;
}

function redraw() {
  waits = false;
  if (chart) chart.show(rowsOfChart());
}

function moveTo(k, shift) {
  shifts[k] = clamped(shift);
  showShift(k);
  showText(element("isotherm-readout"), `${nameOf(k)}: log10 aT ${fixed(shifts[k], 2)}`);
  if (waits) return;
  waits = true;
  requestAnimationFrame(redraw);
}

function remember() {
  moves.push([...shifts]);
  if (moves.length > kMostMoves) moves.shift();
  showUndo();
}

function choose(k) {
  if (k === chosen) return;
  chosen = k;
  sliders.forEach((one, j) => one.classList.toggle("chosen", j === k));
  if (!chart?.graph) return;
  const series = {};
  for (const label of chart.options.points) series[label] = { pointSize: sizeOf(label) };
  chart.graph.updateOptions({ series });
}

function onKey(event, k) {
  const step = event.shiftKey ? kLargeStep : kStep;
  const decades = event.key in kSidewards ? sign() * kSidewards[event.key] * step : (kUpwards[event.key] ?? 0) * step;
  if (decades === 0 || event.ctrlKey || event.altKey || event.metaKey) return;
  event.preventDefault();
  remember();
  moveTo(k, shifts[k] + decades);
}

function showSliders() {
  sliders = isotherms.map((_, k) => {
    const key = make("span", { class: `key series-${1 + (k % kColors)}` });
    const parts = [key, nameOf(k), make("b")];
    if (k === reference) return make("div", { class: "isotherm" }, ...parts);
    const slider = make("div", { class: "isotherm", role: "slider", tabindex: "0", "aria-label": `Isotherm at ${nameOf(k)}`,
                                 "aria-valuemin": String(-kMostDecades), "aria-valuemax": String(kMostDecades) }, ...parts);
    slider.addEventListener("focus", () => choose(k));
    slider.addEventListener("keydown", (event) => onKey(event, k));
    return slider;
  });
  element("isotherm-list").replaceChildren(...sliders);
  isotherms.forEach((_, k) => showShift(k));
}

// Where the pointer is, in decades of the argument.
const decadesAt = (event) => Math.log10(chart.graph.toDataXCoord(event.clientX - element("isotherm-chart").getBoundingClientRect().left));

// The isotherm under the pointer, that which was chosen before others; null: none. The reference does not move.
function nearest(event) {
  const box = element("isotherm-chart").getBoundingClientRect(), { factor } = axisOf("modulus_Pa", largest());
  const area = chart.graph.getArea();
  let best = null, least = kReach_px;
  isotherms.forEach((one, k) => one.argument.forEach((_, i) => columns().forEach((__, c) => {
    const y = valueAt(k, c, i) * factor;
    if (!(y > 0) || k === reference) return;
    const x = area.x + area.w * chart.graph.toPercentXCoord(argumentAt(k, i));  // toDomXCoord() takes no logarithm
    const away = Math.hypot(x - event.clientX + box.left,
                            chart.graph.toDomYCoord(y) - event.clientY + box.top);
    const counted = k === chosen ? 0.5 * away : away;
    if (away < kReach_px && counted < least) [best, least] = [k, counted];
  })));
  return best;
}

function onDown(event) {
  if (!chart?.graph || event.button !== 0 || !event.isPrimary) return;
  const k = nearest(event);
  if (k === null) return;
  event.preventDefault();
  event.currentTarget.setPointerCapture(event.pointerId);
  drag = { k, from: decadesAt(event), shift: shifts[k], window: chart.graph.xAxisRange(), hasMoved: false };
  choose(k);
}

function onMove(event) {
  if (!drag) return;
  const shift = drag.shift + sign() * (decadesAt(event) - drag.from);
  if (!drag.hasMoved) remember();
  drag.hasMoved = true;
  moveTo(drag.k, Math.round(100 * shift) / 100);
}

// The keyboard goes on from there.
function onUp() {
  if (!drag) return;
  sliders[drag.k].focus({ preventScroll: true });
  drag = null;
  redraw();
}

// The finger scrolls the page.
function onCancel() {
  if (drag?.hasMoved) undoMove();
  drag = null;
}

// Takes back what was moved since the last fit; false: nothing was.
export function undoMove() {
  if (moves.length === 0) return false;
  shifts = moves.pop();
  isotherms.forEach((_, k) => showShift(k));
  showText(element("isotherm-readout"), "");
  redraw();
  showUndo();
  return true;
}

// The options of a fit that starts from here.
function optionsFromHere() {
  const temperature = (k) => String(Number(isotherms[k].temperature_C.toFixed(1)));
  const others = isotherms.map((_, k) => k).filter((k) => k !== reference);
  return { "reference-temperature": `${temperature(reference)} degC`,
           "start-shift": others.map((k) => `${temperature(k)}=${Number(shifts[k].toFixed(3))}`) };
}

export function startIsotherms(handlers) {
  ({ onFit, onUndo } = handlers);
  const node = element("isotherm-chart");
  for (const [name, handler] of [["pointerdown", onDown], ["pointermove", onMove], ["pointerup", onUp], ["pointercancel", onCancel]])
    node.addEventListener(name, handler);
  element("isotherm-fit").addEventListener("click", () => onFit(optionsFromHere()));
  element("isotherm-undo").addEventListener("click", () => onUndo());
  element("isotherm-zero").addEventListener("click", () => {
    remember();
    isotherms.forEach((_, k) => moveTo(k, 0));
    showText(element("isotherm-readout"), "");
  });
}

// Before a fit: where its options begin, or as they were measured. options: those of the table.
export function showIsotherms(list, options) {
  isotherms = thinned(list);
  [chosen, drag, moves, curve] = [null, null, [], []];
  const stated = options["reference-temperature"] === undefined ? -1 : indexOf(options["reference-temperature"]);
  reference = stated >= 0 ? stated : Math.floor(isotherms.length / 2);
  shifts = isotherms.map(() => 0);
  levels = isotherms.map(() => 0);
  for (const one of options["start-shift"] ?? []) {
    const [temperature, decades] = one.split("="), k = indexOf(temperature);
    if (k >= 0 && k !== reference && Number.isFinite(Number(decades))) shifts[k] = clamped(Number(decades));
  }
  showText(element("isotherm-note"), "");
  showText(element("isotherm-readout"), "");
  show(element("isotherm-body"), isotherms.length > 0);
  if (isotherms.length === 0) return;
  showSliders();
  showUndo();
  drawChart();
}

// After a fit: at its shifts, with its curve. What it left out stays with its neighbour.
export function placeIsotherms({ shift, curves }) {
  if (!shift || isotherms.length === 0) return;
  const found = isotherms.map((one) => shift.factors.find((factor) => Math.abs(factor.temperature_C - one.temperature_C) <= 0.5));
  const near = (k) => found.reduce((best, factor, j) => (factor && (best < 0 || Math.abs(j - k) < Math.abs(best - k)) ? j : best), -1);
  shifts = isotherms.map((_, k) => (found[k] ?? found[near(k)]).ln_a / Math.LN10);
  levels = isotherms.map((_, k) => found[k]?.ln_b ?? 0);
  reference = found.findIndex((factor) => factor?.temperature_C === shift.T_ref_C);
  curve = curves.values.map((x, i) => [x, ...curves.columns.map((column) => column.fitted[i])]);
  moves = [];
  showText(element("isotherm-note"), shift.started_from === "given" ? "The fit started from the shifts that were given."
    : shift.started_from === "rows" ? "The fit did not start from the shifts that were given: the rows scatter clearly less about others." : "");
  showSliders();
  showUndo();
  drawChart();
}

// isThere: options of the table can be taken back.
export function showEarlier(isThere) {
  hasEarlier = isThere;
  showUndo();
}
