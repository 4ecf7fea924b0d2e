// What the fitted material does in another test, with its band; measured values of another table beside it.
import { Chart } from "./charts.js";
import { axisOf, element, list, make, sentence, show, showText, significant } from "./format.js";

// Fields by the kind of test; the program describes them.
const kFields = { relaxation: ["strain", "ramp", "from", "to"], creep: ["stress", "ramp", "from", "to"],
                  recovery: ["stress", "hold", "recovery"], cycles: ["strain", "period", "cycles"], oscillation: ["from", "to"] };

let options = [], values = {}, onChange = () => {}, chart = null, curve = null;

export function startPredict(described, handler) {
  options = described.predict;
  onChange = handler;
  element("predict-test").replaceChildren(...Object.keys(kFields).map((name) => make("option", { value: name }, name)));
  element("predict-test").value = "creep";
  element("predict-test").addEventListener("change", () => { values = {}; showFields(); onChange(); });
  element("predict-against").addEventListener("change", () => onChange());
  for (const id of ["predict-log-x", "predict-log-y"]) element(id).addEventListener("change", draw);
  showFields();
}

function showFields() {
  const names = kFields[element("predict-test").value];
  element("predict-fields").replaceChildren(...names.map((name) => options.find((one) => one.name === name)).map((option) => {
    const input = make("input", { autocomplete: "off", placeholder: option.unit ? `in ${option.unit}, or with unit` : option.default ?? "" });
    input.addEventListener("change", () => { values[option.name] = input.value.trim(); onChange(); });
    return make("label", { title: option.description }, option.name.replaceAll("-", " "), input);
  }));
}

export function showOtherTables(names) {
  const before = element("predict-against").value;
  element("predict-against").replaceChildren(make("option", { value: "" }, "nothing"), ...names.map((name) => make("option", { value: name }, name)));
  element("predict-against").value = names.includes(before) ? before : "";
}

export function chosenPrediction() {
  const against = element("predict-against").value;
  return { predict: { test: element("predict-test").value, ...values }, ...(against ? { against } : {}) };
}

function draw() {
  if (chart) chart.close();
  chart = null;
  if (!curve) return;
  const names = Object.keys(curve), argument = names[0];
  const isBand = (name) => /_(low|high)_95$/.test(name);
  // The band first, so that the prediction lies on it.
  const shown = names.slice(1).filter((name) => name !== "inside_window").sort((a, b) => isBand(b) - isBand(a));
  const logs = () => ({ x: element("predict-log-x").checked, y: element("predict-log-y").checked });
  const main = shown.filter((name) => !isBand(name));
  const largest = shown.flatMap((name) => curve[name]).reduce((most, y) => Math.max(most, Math.abs(y ?? 0)), 0);
  const axis = axisOf(main[0], main.length === 1 ? largest : 0);
  const rows = curve[argument].map((x, i) => [x, ...shown.map((name) => (curve[name][i] === null ? null : axis.factor * curve[name][i]))])
    .filter((row) => (!logs().x || row[0] > 0) && (!logs().y || row.slice(1).every((y) => y === null || y > 0)));
  chart = new Chart(element("predict-chart"), {
    labels: [argument, ...shown], colors: shown.map((name) => (isBand(name) ? "measured" : main.indexOf(name) === 0 ? "fit" : "depth")), logs,
    titles: { xlabel: axisOf(argument).label, ylabel: main.length === 1 ? axis.label : main.map((name) => name.split("_")[0]).join(", ") },
    readout: (x, i) => {
      const row = x === null ? null : chart.data[i];
      element("predict-readout").textContent = !row ? ""
        : `${significant(row[0], 4)}: ${shown.map((name, k) => (isBand(name) ? "" : `${name} ${significant(row[k + 1], 5)}`)).filter(Boolean).join(", ")}`;
    },
  });
  chart.show(rows);
}

export function showPrediction(answer) {
  const { result } = answer;
  curve = result.curve;
  const status = element("predict-status");
  status.className = result.trustworthy ? "good" : "note";
  const against = result.against ? result.against.quantities.map((one) =>
    ` ${one.quantity} of ${result.against.file}: ${significant(100 * one.rms_relative, 3)} % rms, ${significant(100 * one.share_inside_band_and_noise, 3)} % of `
    + `${one.n} values inside band and noise.`).join("") : "";
  showText(status, `By the material in ${answer.material}.`
    + (result.n_outside_window ? ` ${result.n_outside_window} points lie outside the times that were measured.` : "") + against);
  list(element("predict-notes"), result.notes.map(sentence));
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
