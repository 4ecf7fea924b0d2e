// The options of a fit as fields. What they are, the program itself says: names, values, meanings.
import { element, make, sentence } from "./format.js";

// Fields that stand above the rows, by the kind of test; all others are behind "All options".
const kAlways = ["kind", "from", "to"];
const kByKind = { indentation: ["punch-diameter", "layer-thickness", "poisson-ratio", "frame-stiffness"] };
const kOfModuli = ["modulus-kind", "poisson-ratio"];
const kOfForce = ["depth", "punch-diameter", "layer-thickness", "gauge-length", "area"];

let options = [], onChange = () => {};

export function startOptions(described, handler) {
  options = described;
  onChange = handler;
}

const labelOf = (name) => { const text = name.replaceAll("-", " "); return text[0].toUpperCase() + text.slice(1); };

// The value of a field as the request holds it; undefined: not set.
function valueOf(option, input) {
  if (option.type === "flag") return input.checked || undefined;
  const text = input.value.trim();
  if (text === "") return undefined;
  return option.is_list ? text.split(/\s*;\s*/).filter((one) => one !== "") : text;
}

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
  const hint = option.unit ? `in ${option.unit}, or with unit` : option.is_list ? "several: a; b" : option.default ?? "";
  return make("input", { id, autocomplete: "off", spellcheck: "false", placeholder: hint,
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
  const names = [...new Set([...kAlways, ...(kByKind[table.kind] ?? (isForce ? kOfForce : kOfModuli)), "density"])];
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
export const keywordOf = (name) => (name === "from" ? "from_" : name.replaceAll("-", "_"));

// The same in Python: keywords of viscard.fit(). data: a file, or tests by kind.
export function pythonOf(data, chosen) {
  const words = Object.entries(chosen).map(([name, value]) => {
    const option = options.find((one) => one.name === name);
    const isNumber = option && ["number", "whole number"].includes(option.type);
    const text = value === true ? "True" : isNumber ? String(value) : JSON.stringify(value);
    return `, ${keywordOf(name)}=${text}`;
  });
  return `import viscard\nresult = viscard.fit(${JSON.stringify(data)}${words.join("")})`;
}

// What is in doubt of the files that were read, such as that one was edited; command and Python lines with a button each
// that copies them.
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
  node.replaceChildren(...doubts, line("command", command), line("Python lines", python));
}
