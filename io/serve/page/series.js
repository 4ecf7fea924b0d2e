// The specimens of the series, read from its folder.
import { order } from "./api.js";
import { element, make, modulusUnit, numberField, numberFrom, range, sentence, show, showText, significant } from "./format.js";

// factor: from the unit shown to SI.
const kFields = [{ key: "mixing_ratio", label: "Mixing ratio, base to one of curing agent", value: "10", factor: 1 },
                 { key: "modulus_guess_Pa", label: "Guess of the modulus (PDMS: 20 MPa / ratio)", unit: "MPa", value: "2", factor: 1e6 },
                 { key: "punch_diameter_m", label: "Diameter of the flat punch", unit: "mm", value: "4.4", factor: 1e-3 },
                 { key: "layer_thickness_m", label: "Thickness of the specimen (0: very thick)", unit: "mm", value: "11", factor: 1e-3 },
                 { key: "poisson_ratio", label: "Poisson ratio", value: "0.495", factor: 1 },
                 { key: "rho_kg_m3", label: "Density", unit: "kg/m³", value: "965", factor: 1 },
                 { key: "temperature_C", label: "Temperature", unit: "°C", value: "23", factor: 1 }];
const kStates = { none: "not run", finished: "finished", interrupted: "interrupted", running: "running" };

let chosen = null;
let onChoice = () => {}, onChange = () => {}, onFit = () => {};

export const chosenSpecimen = () => chosen;

function textFields() {
  const field = (key, label, value) =>
    make("label", {}, label, make("input", { id: `add-${key}`, name: key, autocomplete: "off", value }));
  return [field("id", "Name", "pdms-1to10"), field("material", "Material", "PDMS")];
}

function buildForm() {
  element("add-form").replaceChildren(
    ...textFields(), ...kFields.map((field) => numberField("add", field)),
    make("button", { type: "submit", class: "primary wide", id: "add-submit" }, "Add the specimen"));
}

async function add(event) {
  event.preventDefault();
  const specimen = { id: element("add-id").value.trim(), material: element("add-material").value.trim() };
  showText(element("series-error"), "");
  for (const field of kFields) {
    const input = element(`add-${field.key}`);
    const value = numberFrom(input.value);
    input.setAttribute("aria-invalid", Number.isNaN(value));
    if (Number.isNaN(value)) {
      showText(element("series-error"), `${field.label}: "${input.value}" is not a number.`);
      input.focus();
      return;
    }
    specimen[field.key] = value * field.factor;
  }
  try {
    chosen = (await order("/api/specimens", { specimen })).name;
    element("add").open = false;
    await onChange();
    onChoice();
    element("add").querySelector("summary").focus();
  } catch (error) {
    showText(element("series-error"), sentence(error.message));
  }
}

async function remove(name) {
  try {
    await order("/api/specimens/remove", { name });
    if (chosen === name) chosen = null;
    showText(element("series-error"), "");
  } catch (error) {
    showText(element("series-error"), sentence(error.message));
  }
  await onChange();
}

function modulusText(material) {
  if (!material) return "";
  if (material.trouble) return "unreadable";
  const { factor, unit } = modulusUnit(material.E0_Pa);
  return `${significant(material.E0_Pa * factor, 4)} ${unit}`;
}

function choose(name) {
  chosen = name;
  for (const row of element("specimens").tBodies[0].rows) row.classList.toggle("chosen", row.dataset.name === name);
  onChoice();
}

async function tellOrder(path, body, done) {
  showText(element("series-done"), "");
  try {
    const answer = await order(path, body);
    showText(element("series-error"), "");
    if (done) done(answer);
  } catch (error) {
    showText(element("series-error"), sentence(error.message));
  }
  await onChange();
}

function link(text, label, action) {
  const button = make("button", { type: "button", class: "link", title: label, "aria-label": label }, text);
  button.addEventListener("click", action);
  return button;
}

// A line of text that is changed in its place: Enter or leaving it keeps it.
function edited(button, label, value, keep) {
  const input = make("input", { "aria-label": label, value, autocomplete: "off", maxlength: "1000", class: "inline" });
  input.addEventListener("keydown", (event) => { if (event.key === "Enter") input.blur(); });
  input.addEventListener("blur", () => {
    input.replaceWith(button);
    if (input.value.trim() !== value) keep(input.value.trim());
  });
  button.replaceWith(input);
  input.focus();
}

function actionsOfCapture(capture, which) {
  const { file } = capture;
  if (capture.status === "running") return [];
  const note = link("note", `Note on ${file}`, () => edited(note, `Note on ${file}`, capture.note, (text) => tellOrder("/api/captures/note", { capture: file, note: text })));
  return [...(capture.status === "unreadable" ? [] : [link(`fit${which}`, `Fit ${file}`, () => onFit(file))]), note,
          ...(capture.status === "unreadable" ? [] : [link("CSV", `Write ${file} as a table`, () => tellOrder("/api/captures/export", { capture: file }, (answer) =>
            showText(element("series-done"), `${file} is written as ${answer.file} in the folder.`)))]),
          link("take away", `Move ${file} into the folder trash`, () => tellOrder("/api/captures/remove", { capture: file })),
          ...(capture.note ? [make("div", { class: "hint" }, capture.note)] : [])];
}

function actionsOf(entry) {
  if (entry.captures.length > 0) {
    return entry.captures.flatMap((capture, i) => actionsOfCapture(capture, entry.captures.length > 1 ? ` run ${i + 1}` : ""));
  }
  const rename = link("rename", `Rename ${entry.name}`, () => edited(rename, `New name of ${entry.name}`, entry.specimen ? entry.specimen.id : entry.name, (id) =>
    tellOrder("/api/specimens/rename", { name: entry.name, id }, (answer) => { if (chosen === entry.name) chosen = answer.name; })));
  return [rename, link("remove", `Remove ${entry.name}`, () => remove(entry.name))];
}

function rowOf(entry) {
  const radio = make("input", { type: "radio", name: "specimen", value: entry.name, id: `choose-${entry.name}` });
  radio.checked = entry.name === chosen;
  radio.addEventListener("change", () => choose(entry.name));
  const ratio = entry.specimen && entry.specimen.mixing_ratio > 0 ? `${significant(entry.specimen.mixing_ratio)}\u00a0:\u00a01` : "";
  const material = entry.material && entry.material.E0_interval_95
    ? { title: `95 %: ${range(entry.material.E0_interval_95, 1e-6)} MPa` } : {};
  const state = make("td", { class: "state" }, kStates[entry.state], ...actionsOf(entry));
  for (const doubt of entry.material?.doubts ?? []) state.append(make("div", { class: "alert" }, sentence(doubt)));
  if (entry.trouble) state.append(make("div", { class: "alert" }, sentence(entry.trouble)));
  const row = make("tr", { "data-name": entry.name },
                   make("td", {}, make("label", {}, radio, make("span", {}, entry.name))),
                   make("td", { class: "number" }, ratio), state,
                   make("td", { class: "number", ...material }, modulusText(entry.material)));
  row.classList.toggle("chosen", entry.name === chosen);
  return row;
}

function resumeText(specimens) {
  const cut = specimens.filter((entry) => entry.state === "interrupted");
  if (cut.length === 0) return "";
  const last = cut[0].captures[cut[0].captures.length - 1];
  const when = last.started_at ? `, begun at ${new Date(last.started_at).toLocaleString()},` : "";
  return `The run of ${cut[0].name}${when} was not finished; what it recorded is kept in ${last.file}. `
    + `Choose ${cut[0].name} and start it again: it goes to a new file.`;
}

let drawn = "";
export function showSeries(state) {
  showText(element("folder"), state.folder);
  showText(element("folder-trouble"), sentence(state.folder_trouble));
  const names = state.specimens.map((entry) => entry.name);
  const had = chosen;
  if (!names.includes(chosen)) chosen = state.next || names[names.length - 1] || null;
  show(element("specimens"), names.length > 0);
  show(element("no-specimens"), names.length === 0);
  if (names.length === 0) element("add").open = true;
  const text = JSON.stringify([state.specimens, chosen]);
  const isWriting = element("specimens").querySelector("input.inline") !== null;
  if (text !== drawn && !isWriting) {  // otherwise the focus would be lost every few seconds
    drawn = text;
    element("specimens").tBodies[0].replaceChildren(...state.specimens.map(rowOf));
  }
  showText(element("resume"), resumeText(state.specimens));
  if (had !== chosen) onChoice();
}

// The specimen to run after this one.
export function chooseNext(state) {
  if (state.next) choose(state.next);
}

export function startSeries(handlers) {
  ({ onChoice, onChange, onFit } = handlers);
  buildForm();
  element("add-form").addEventListener("submit", add);
}
