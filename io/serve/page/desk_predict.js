// What the fitted material does in another test, with its band; measured values of another table beside it.
import { Chart, thinned } from "./charts.js";
import { hintOf, labelOf, pythonKeywords } from "./desk_options.js";
import { axisOf, element, list, make, nameLogSwitch, sentence, show, showText, significant } from "./format.js";

// Fields by the kind of test, which the program describes, and which axes are logarithmic at first.
const kTests = {
  relaxation: { fields: ["strain", "ramp", "from", "to"], logs: { x: true, y: false } },
  creep: { fields: ["stress", "ramp", "from", "to"], logs: { x: true, y: false } },
  recovery: { fields: ["stress", "hold", "recovery"], logs: { x: false, y: false } },
  cycles: { fields: ["strain", "period", "cycles"], logs: { x: false, y: false } },
  oscillation: { fields: ["from", "to"], logs: { x: true, y: true } },
};
const kColors = ["fit", "depth"], kMeasuredColors = ["series-1", "series-3"];
const kMostPoints = 3000;

let options = [], values = {}, onChange = () => {}, charts = [], curve = null, measured = [];

export function startPredict(described, handler) {
  options = described.predict;
  onChange = handler;
  element("predict-test").replaceChildren(...Object.keys(kTests).map((name) => make("option", { value: name }, name)));
  element("predict-test").value = "creep";
  element("predict-test").addEventListener("change", () => { values = {}; showFields(); onChange(); });
  element("predict-against").addEventListener("change", () => onChange());
  for (const id of ["predict-log-x", "predict-log-y"]) element(id).addEventListener("change", draw);
  showFields();
}

function showFields() {
  const test = element("predict-test").value, { fields, logs } = kTests[test];
  for (const axis of ["x", "y"]) element(`predict-log-${axis}`).checked = logs[axis];
  element("predict-fields").replaceChildren(...fields.map((name) => options.find((one) => one.name === name)).map((option) => {
    const unit = test === "oscillation" ? "Hz" : option.unit;  // of --from and --to
    const input = make("input", { autocomplete: "off", placeholder: option.default ?? hintOf(option, unit) });
    input.addEventListener("change", () => { values[option.name] = input.value.trim(); onChange(); });
    return make("label", { title: option.description, "data-option": option.name }, labelOf(option.name), input);
  }));
}

// What viscard.predict() of Python takes. given: the options of the command.
export const predictKeywords = (given) => pythonKeywords(given, options);

export function showOtherTables(names) {
  const before = element("predict-against").value;
  element("predict-against").replaceChildren(make("option", { value: "" }, "nothing"), ...names.map((name) => make("option", { value: name }, name)));
  element("predict-against").value = names.includes(before) ? before : "";
}

export function chosenPrediction() {
  const against = element("predict-against").value;
  return { predict: { test: element("predict-test").value, ...values }, ...(against ? { against } : {}) };
}

const isBand = (name) => /_(low|high)_95$/.test(name);
const bandOf = (name) => [`${name}_low_95`, `${name}_high_95`].filter((one) => curve[one]);
const measuredName = (name) => `${name} measured`;
const shortName = (name) => axisOf(name).label.replace(/ \(.*\)$/, "");

// What the test gives, not what is put in (the strain of cycles): only that has a band. The loss tangent has a chart of its own.
function answers() {
  const names = Object.keys(curve).slice(1).filter((name) => !isBand(name) && name !== "inside_window" && name !== "tan_delta");
  const withBand = names.filter((name) => bandOf(name).length > 0);
  return withBand.length > 0 ? withBand : "frequency_Hz" in curve ? names : names.slice(-1);
}

// A chart of these columns with their bands; ylabel stands for several.
function chartOf(id, names, logs, titles, readout) {
  const [argument] = Object.keys(curve);
  const shown = [...names.flatMap(bandOf), ...names];  // the band first, so that the prediction lies on it
  const rowsOfTable = measured.filter((one) => names.includes(one.quantity));
  const largest = [...shown.map((name) => curve[name]), ...rowsOfTable.map((one) => one.values)].flat()
    .reduce((most, y) => Math.max(most, Math.abs(y ?? 0)), 0);
  const axis = axisOf(names[0], largest);
  const valueOf = (y) => (y === null || (logs().y && !(y > 0)) ? null : axis.factor * y);  // a band may reach below zero
  const isDrawn = (row) => (!logs().x || row[0] > 0) && row.slice(1).some((y) => y !== null);
  const points = rowsOfTable.map((one) => measuredName(one.quantity));
  const predicted = curve[argument].map((x, i) => [x, ...shown.map((name) => valueOf(curve[name][i])), ...points.map(() => null)]);
  const ofTable = rowsOfTable.flatMap((one, k) => thinned(one.at.map((x, i) => [x, valueOf(one.values[i])]), kMostPoints)
    .map(([x, y]) => [x, ...shown.map(() => null), ...points.map((_, j) => (j === k ? y : null))]));
  const rows = [...predicted, ...ofTable].filter(isDrawn).sort((a, b) => a[0] - b[0]);
  const chart = new Chart(element(id), {
    labels: [argument, ...shown, ...points], points, logs, file: () => `prediction ${element("predict-test").value}`,
    units: [axisOf(argument).unit, ...shown.map(() => axis.unit), ...points.map(() => axis.unit)],
    names: [shortName(argument), ...shown.map((name) => (isBand(name) ? name.replace(/^(.*)_(low|high)_95$/, (_, of, end) => `${shortName(of)}, ${end} end of 95 %`) : shortName(name))),
            ...rowsOfTable.map((one) => `${shortName(one.quantity)} measured`)],
    colors: [...shown.map((name) => (isBand(name) ? "measured" : kColors[names.indexOf(name)])),
             ...rowsOfTable.map((one) => kMeasuredColors[names.indexOf(one.quantity)])],
    titles: { ylabel: names.length === 1 ? axis.label : `modulus (${axis.unit})`, ...titles },
    readout: (x, i) => {
      const row = x === null ? null : chart.data[i];
      if (row && row.slice(1, 1 + shown.length).every((y) => y === null)) return;  // a row of the table, between those of the curve
      readout(!row ? "" : `${significant(row[0], 4)} ${axisOf(argument).unit}: `
        + names.map((name) => `${shortName(name)} ${significant(row[1 + shown.indexOf(name)], 5)} ${axis.unit}`.trim()).join(", "));
    },
  });
  chart.show(rows);
  return chart;
}

function draw() {
  for (const chart of charts) chart.close();
  charts = [];
  if (!curve) return;
  const [argument] = Object.keys(curve), names = answers(), hasLoss = "tan_delta" in curve;
  const logs = () => ({ x: element("predict-log-x").checked, y: element("predict-log-y").checked });
  const readout = (text) => { element("predict-readout").textContent = text; };
  nameLogSwitch("predict-log-x-name", argument);
  const key = (color, text) => [make("span", { class: `key ${color}` }), `${text} `];
  element("predict-legend").replaceChildren(...names.flatMap((name, k) => key(kColors[k], names.length === 1 ? "prediction" : shortName(name))),
                                            ...key("measured", "95 % band"),
                                            ...names.flatMap((name, k) => (measured.some((one) => one.quantity === name)
                                              ? key(kMeasuredColors[k], names.length === 1 ? "measured" : `${shortName(name)}, measured`) : [])));
  show(element("predict-loss-chart"), hasLoss);
  charts.push(chartOf("predict-chart", names, logs, { xlabel: axisOf(argument).label }, readout));
  if (hasLoss) charts.push(chartOf("predict-loss-chart", ["tan_delta"], () => ({ x: logs().x, y: false }), {}, readout));
}

export function showPrediction(answer) {
  const { result } = answer;
  curve = result.curve;
  measured = result.against?.measured ?? [];
  const status = element("predict-status"), compared = result.against?.quantities ?? [];
  const disagrees = compared.some((one) => one.agrees === false), isJudged = compared.every((one) => one.agrees === true);
  status.className = !result.trustworthy || disagrees ? "alert" : isJudged ? "good" : "note";
  // A material without a band, or a table with too few rows for its noise, has no share.
  const shareOf = (one) => {
    const [share, where] = one.share_inside_band_and_noise !== null ? [one.share_inside_band_and_noise, "band and noise"] : [one.share_inside_band, "the band"];
    return share === null ? "" : `, ${significant(100 * share, 3)} % of ${one.n} values inside ${where}`;
  };
  const against = compared.map((one) => ` ${shortName(one.quantity)} of ${result.against.file}: ${significant(100 * one.rms_relative, 3)} % rms${shareOf(one)}`
    + `${one.agrees === false ? "; they disagree" : ""}.`).join("");
  showText(status, `${result.trustworthy ? "" : "Do not trust the fit of this material. "}By the material in ${answer.material}.`
    + (result.n_outside_window ? ` ${result.n_outside_window} points lie outside the times that were measured.` : "") + against);
  list(element("predict-notes"), [...answer.notes, ...result.notes].map(sentence));
  show(element("predict-body"), true);
  draw();
}

export function showPredictState(text, kind) {
  const status = element("predict-status");
  status.className = kind;
  showText(status, text);
  list(element("predict-notes"), []);
  show(element("predict-body"), false);
}
