// The fit of a capture: moduli and terms with intervals, data with fit, residuals.
import { order } from "./api.js";
import { Chart } from "./charts.js";
import { element, list, sentence, show, showText, significant } from "./format.js";
import { showModuli } from "./moduli.js";
import { isRunning } from "./run.js";

const kRetry_ms = 1000, kMostTries = 120;

let onFitted = () => {}, starts = [], asked = 0;

// The first hold, in which the force changes by some per cent only: its rows, or none.
function firstHold(data) {
  const end = starts.length > 1 ? starts[1] : Infinity;
  const rows = data.filter((row) => row[0] < end);
  const peak = rows.reduce((best, row, i) => (row[1] > rows[best][1] ? i : best), 0);
  return rows.length - peak > 10 ? rows.slice(peak) : [];
}

const isWhole = () => element("fit-whole").checked;

const fitChart = new Chart(element("fit-chart"), {
  labels: ["time", "measured", "fit"], colors: ["measured", "fit"], points: ["measured"],
  units: ["s", "N", "N"], file: () => `${element("result-name").textContent.replace(/\.viscap$/, "")} fit`,
  titles: { xlabel: "time (s)", ylabel: "force (N)" },
  onWindow: (range) => residualChart.showWindow(range),
  window: () => {
    const hold = isWhole() ? [] : firstHold(fitChart.data);
    return hold.length > 0 ? [starts.length > 0 ? starts[0] : hold[0][0], hold[hold.length - 1][0]] : null;
  },
  range: () => {
    const values = (isWhole() ? [] : firstHold(fitChart.data)).map((row) => row[1]);
    if (values.length === 0) return null;
    const low = Math.min(...values), high = Math.max(...values);
    return [low - 0.15 * (high - low), high + 0.15 * (high - low)];
  },
  readout: (x, row) => {
    const data = fitChart.data[row];
    element("fit-readout").textContent = x === null ? ""
      : `${significant(x, 4)} s: measured ${significant(data[1], 5)} N, fit ${significant(data[2], 5)} N`;
  },
});
const residualChart = new Chart(element("residual-chart"), {
  labels: ["time", "residual"], colors: ["depth"], points: ["residual"], band: [-2, 2],
  titles: { xlabel: "time (s)", ylabel: "residual / deviation" },
  onWindow: (range) => fitChart.showWindow(range),
  range: () => {
    const largest = Math.max(3, ...residualChart.data.map((row) => Math.abs(row[1])));
    return [-1.1 * largest, 1.1 * largest];
  },
});

function showFit(fit) {
  showModuli(element("result-table"), fit);
  const saved = fit.material_file ? ` The material is in ${fit.material_file}.`
    : fit.material_trouble ? ` The material was not saved: ${sentence(fit.material_trouble)}` : "";
  element("result-note").textContent =
    `Intervals cover the scatter alone; geometry, calibration and frame add ${significant(100 * fit.systematic_relative, 2)} % to E0.${saved}`;
  list(element("result-flags"), fit.flags.map((flag) => sentence(flag.text)));
  const { time_s, measured, fitted, sigma } = fit.curves;
  show(element("result-body"), true);
  starts = fit.curves.motion_start_s;
  residualChart.show(time_s.map((t, i) => [t, (measured[i] - fitted[i]) / (sigma[i] || 1)]));
  residualChart.rebuild();
  fitChart.show(time_s.map((t, i) => [t, measured[i], fitted[i]]));
  fitChart.rebuild();  // last, because its window is that of both
}

// Another page may fit just now, for example the same run.
export async function orderWhenFree(path, body, onWait = () => {}) {
  for (let n = 0; ; ++n) {
    try {
      return await order(path, body);
    } catch (error) {
      if (error.code !== "busy" || isRunning() || n >= kMostTries) throw error;
      onWait(error);
    }
    await new Promise((done) => setTimeout(done, kRetry_ms));
  }
}

export async function fitCapture(capture) {
  const number = ++asked;
  show(element("result"), true);
  show(element("result-body"), false);
  showText(element("result-name"), capture);
  const status = element("result-status");
  status.className = "";
  showText(status, "Fitting …");
  try {
    const fit = await orderWhenFree("/api/fit", { capture }, (error) => {
      if (number === asked) showText(status, `Waiting: ${sentence(error.message)}`);
    });
    if (number !== asked) return;  // the person asked for another fit meanwhile
    showFit(fit);
    status.className = fit.trustworthy && fit.status === "finished" ? "good" : "note";
    showText(status, fit.status !== "finished" ? "The run was not finished; this is a fit of what was recorded."
      : fit.trustworthy ? "The fit describes the data." : "Do not trust this fit before you have read the notes below.");
  } catch (error) {
    if (number !== asked) return;
    status.className = "alert";
    showText(status, sentence(error.message));
  }
  await onFitted();
}

export function startResult(handlers) {
  ({ onFitted } = handlers);
  element("fit-whole").addEventListener("change", () => fitChart.rebuild());
}
