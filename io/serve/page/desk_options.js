// The options of a fit as fields. What they are, the program itself says: names, values, meanings.
import { element, make, nameFieldsBy, sentence } from "./format.js";

// Fields that stand above the rows, by the kind of test; all others are behind "All options".
const kAlways = ["kind", "from", "to"];
const kByKind = { indentation: ["punch-diameter", "layer-thickness", "poisson-ratio", "frame-stiffness"] };
const kOfModuli = ["modulus-kind", "poisson-ratio"];
const kOfForce = ["depth", "punch-diameter", "layer-thickness", "gauge-length", "area"];
const kOfRubber = ["kind", "model", "gauge-length", "area"];

// Options that name times: a table of frequencies has none.
const kOfTime = ["from", "to", "hold", "crop", "time-zero"];

let options = [], rubberKinds = [], onChange = () => {};

export function startOptions(described, handler) {
  options = described.options;
  rubberKinds = described.large_strain;
  onChange = handler;
  nameFieldsBy(inFields);
}

// A message that names options, "pass --accept-flags", with the names of their fields: 'set "Accept flags"'. Those of the
// view that is shown come first. Options without a field stay as they are.
function inFields(text) {
  const nameOf = (option) => {
    const fields = [...document.querySelectorAll(`[data-option="${option}"]`)];
    const field = fields.find((one) => one.closest("[role=tabpanel]:not([hidden])")) ?? fields[0];
    return field && `"${field.dataset.label ?? labelOf(option)}"`;
  };
  return text
    .replaceAll(/, as in ([a-z-]+)=(?:'[^']*'|[^\s(]+)(?: \(or ([^)]*)\))?/g, (whole, kind, others) => (!kinds().includes(kind) ? whole
      : ` in the field "Kind", such as ${kind}${others ? ` (or ${others.replaceAll("=", "")})` : ""}`))
    .replaceAll(/(\b[Pp]ass )?(?<![\w-])--([a-z][a-z-]*[a-z])(?:=(?=\S))?/g, (whole, pass, option) => {
      const name = nameOf(option);
      if (!name) return whole;
      const set = !pass ? "" : pass.startsWith("P") ? "Set " : "set ";
      return `${set}${name}${whole.endsWith("=") ? " " : ""}`;
    });
}

export const kinds = () => options.find((one) => one.name === "kind").choices;
export const isRubberKind = (kind) => rubberKinds.includes(kind);

export const labelOf = (name) => { const text = name.replaceAll("-", " "); return text[0].toUpperCase() + text.slice(1); };

// The value of a field as the request holds it; undefined: not set.
function valueOf(option, input) {
  if (option.type === "flag") return input.checked || undefined;
  const text = input.value.trim();
  if (text === "") return undefined;
  return option.is_list ? text.split(/\s*;\s*/).filter((one) => one !== "") : text;
}

// What an empty field stands for, or how it is written. unit: another one than the program names.
export const hintOf = (option, unit = option.unit) => (unit === "1" ? "0.01, or 1 %" : unit ? `in ${unit}, or with unit`
  : option.is_list ? "several: a; b" : option.default ?? "");

function controlOf(option, value, id, unset) {
  if (option.choices.length > 0 && !option.is_list && option.type === "text") {
    const none = make("option", { value: "" }, option.default ? `${option.default} (as usual)` : unset);
    const select = make("select", { id }, none, ...option.choices.map((one) => make("option", { value: one }, one)));
    select.value = value ?? "";
    return select;
  }
  if (option.type === "flag") {
    const box = make("input", { id, type: "checkbox" });
    box.checked = value === true;
    return box;
  }
  return make("input", { id, autocomplete: "off", spellcheck: "false", placeholder: hintOf(option),
                         value: Array.isArray(value) ? value.join("; ") : value ?? "" });
}

// onValue(value, or undefined: not set). unset: what a list shows without a choice.
export function fieldOf(option, chosen, prefix, onValue, unset = "by the table") {
  const id = `${prefix}-${option.name}`;
  const control = controlOf(option, chosen[option.name], id, unset);
  if (chosen[option.name] !== undefined) control.classList.add("set");
  control.addEventListener("change", () => {
    const value = valueOf(option, control);
    control.classList.toggle("set", value !== undefined);
    onValue(value);
  });
  const isSwitch = option.type === "flag";
  return make("label", { title: option.description, "data-option": option.name, class: isSwitch ? "switch" : undefined },
              ...(isSwitch ? [control, labelOf(option.name)] : [labelOf(option.name), control]));
}

// table: as it was read.
export function showFields(table, chosen) {
  const isForce = table.modulus_kind === "" && table.kind !== "indentation";
  const names = isRubberKind(table.kind) ? kOfRubber
    : [...new Set([...kAlways, ...(kByKind[table.kind] ?? (isForce ? kOfForce : kOfModuli)), "density"])];
  // One that was chosen all the same can be taken away.
  const isFor = ({ name }) => table.kind !== "dma" || !kOfTime.includes(name) || chosen[name] !== undefined;
  const find = (name) => options.find((option) => option.name === name);
  const field = (one, prefix) => fieldOf(one, chosen, prefix, (value) => onChange(one.name, value));
  element("fields").replaceChildren(...names.map(find).filter(Boolean).filter(isFor).map((one) => field(one, "field")));
  const groups = [...new Set(options.map((option) => option.group))];
  element("more-fields").replaceChildren(...groups.flatMap((group) => {
    const rest = options.filter((option) => option.group === group && !names.includes(option.name) && isFor(option));
    if (rest.length === 0) return [];
    return [make("h3", {}, group), make("div", { class: "fields" }, ...rest.map((one) => field(one, "more")))];
  }));
}

// "from" is a word of Python itself.
const keywordOf = (name) => (name === "from" ? "from_" : name.replaceAll("-", "_"));

// The same in Python: the keywords of a function after its other arguments. described: the options of its command.
export function pythonKeywords(chosen, described = []) {
  return Object.entries(chosen).filter(([, value]) => value !== "" && value !== undefined).map(([name, value]) => {
    const option = described.find((one) => one.name === name);
    const isNumber = option && ["number", "whole number"].includes(option.type);
    const text = value === true ? "True" : isNumber ? String(value) : JSON.stringify(value);
    return `, ${keywordOf(name)}=${text}`;
  }).join("");
}

// data: a file, or tests by kind. A kind at large strain stands before the file, and is no keyword.
export function fitCall(data, { kind, ...chosen }) {
  const isRubber = isRubberKind(kind);
  return `viscard.fit(${JSON.stringify(isRubber ? { [kind]: data } : data)}${pythonKeywords(isRubber || !kind ? chosen : { kind, ...chosen }, options)})`;
}
export const pythonOf = (data, chosen) => `import viscard\nresult = ${fitCall(data, chosen)}`;

// What is in doubt of the files that were read, such as that one was edited; command and Python lines, if there are such,
// with a button each that copies them.
export function showSame(node, command, python, result) {
  const line = (what, text) => {
    const button = make("button", { type: "button", "aria-label": `Copy the ${what}` }, "Copy");
    button.addEventListener("click", async () => {
      await navigator.clipboard.writeText(text);
      button.textContent = "Copied";
      setTimeout(() => { button.textContent = "Copy"; }, 1500);
    });
    return make("div", {}, make("code", {}, text), button);
  };
  const doubts = (result?.input_files ?? []).filter((file) => file.note)
    .map((file) => make("p", { class: "note" }, sentence(`${file.path}: ${file.note}`)));
  node.replaceChildren(...doubts, line("command", command), ...(python ? [line("Python lines", python)] : []));
}
