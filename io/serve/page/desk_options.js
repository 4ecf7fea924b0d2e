// The options of a fit as fields. What they are, the program itself says: names, values, meanings.
import { element, make, sentence } from "./format.js";

// Fields that stand above the rows, by the kind of test; all others are behind "All options".
const kAlways = ["kind", "from", "to"];
const kByKind = { indentation: ["punch-diameter", "layer-thickness", "poisson-ratio", "frame-stiffness"] };
const kOfModuli = ["modulus-kind", "poisson-ratio"];
const kOfForce = ["depth", "punch-diameter", "layer-thickness", "gauge-length", "area"];
const kOfRubber = ["kind", "model", "gauge-length", "area"];

let options = [], rubberKinds = [], onChange = () => {};

export function startOptions(described, handler) {
  options = described.options;
  rubberKinds = described.large_strain;
  onChange = handler;
}

export const kinds = () => options.find((one) => one.name === "kind").choices;
export const isRubberKind = (kind) => rubberKinds.includes(kind);

const labelOf = (name) => { const text = name.replaceAll("-", " "); return text[0].toUpperCase() + text.slice(1); };

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

function controlOf(option, value, id) {
  if (option.choices.length > 0 && !option.is_list && option.type === "text") {
    const none = make("option", { value: "" }, option.default ? `${option.default} (as usual)` : "by the table");
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

function fieldOf(option, chosen, prefix) {
  const id = `${prefix}-${option.name}`;
  const control = controlOf(option, chosen[option.name], id);
  if (chosen[option.name] !== undefined) control.classList.add("set");
  control.addEventListener("change", () => onChange(option.name, valueOf(option, control)));
  const isSwitch = option.type === "flag";
  return make("label", { title: option.description, class: isSwitch ? "switch" : undefined },
              ...(isSwitch ? [control, labelOf(option.name)] : [labelOf(option.name), control]));
}

// table: as it was read.
export function showFields(table, chosen) {
  const isForce = table.modulus_kind === "" && table.kind !== "indentation";
  const names = isRubberKind(table.kind) ? kOfRubber
    : [...new Set([...kAlways, ...(kByKind[table.kind] ?? (isForce ? kOfForce : kOfModuli)), "density"])];
  const find = (name) => options.find((option) => option.name === name);
  element("fields").replaceChildren(...names.map(find).filter(Boolean).map((one) => fieldOf(one, chosen, "field")));
  const groups = [...new Set(options.map((option) => option.group))];
  element("more-fields").replaceChildren(...groups.flatMap((group) => {
    const rest = options.filter((option) => option.group === group && !names.includes(option.name));
    if (rest.length === 0) return [];
    return [make("h3", {}, group), make("div", { class: "fields" }, ...rest.map((one) => fieldOf(one, chosen, "more")))];
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
