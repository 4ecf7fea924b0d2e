// Several tables in one picture: data and fit of each, and their moduli in a table.
import { order } from "./api.js";
import { Chart } from "./charts.js";
import { axisOf, element, make, show, showText, significant } from "./format.js";
import { rowsOf } from "./moduli.js";

const kColors = ["series-1", "series-2", "series-3", "series-4", "series-5", "series-6"];
const kMost = 12;  // of one fit; the picture shows as many as there are colours that can be told apart

// The mixing ratio that a name states: "pdms_1to13.csv", "13-1 b.csv"; otherwise nothing.
function ratioIn(name) {
  const found = /(?:^|[^0-9.])(?:1[ _]?(?:to|-|:)[ _]?(\d{1,2}(?:\.\d)?)|(\d{1,2}(?:\.\d)?)[ _]?(?:to|-|:)[ _]?1)(?![0-9])/i.exec(name);
  return found ? found[1] ?? found[2] : "";
}

let ratios = {};  // by table, as they were typed
let chosen = new Set(), fits = {}, chart = null, optionsOf = () => ({}), onTogether = () => {}, asked = 0;

export function startCompare(handlers) {
  ({ optionsOf, onTogether } = handlers);
  element("compare-together").addEventListener("click", () => onTogether(fitted().map((name) => ({ table: name, kind: fits[name].kind }))));
  element("compare-ratios").addEventListener("click", () => onTogether(withRatio().map((name) => ({ table: name, ratio: ratios[name] }))));
  for (const id of ["compare-log-x", "compare-log-y", "compare-relative"]) element(id).addEventListener("change", draw);
}

export function showCompareTables(names) {
  chosen = new Set([...chosen].filter((name) => names.includes(name)));
  element("compare-tables").replaceChildren(...names.map((name) => {
    const box = make("input", { type: "checkbox" });
    box.checked = chosen.has(name);
    box.addEventListener("change", () => {
      if (box.checked && chosen.size >= kMost) { box.checked = false; return tell(`At most ${kMost} tables are compared.`); }
      if (box.checked) chosen.add(name); else chosen.delete(name);
      compare();
    });
    ratios[name] ??= ratioIn(name);
    const ratio = make("input", { "aria-label": `Mixing ratio of ${name}`, placeholder: "ratio", title: "parts of base to one of curing agent",
                                  inputmode: "decimal", autocomplete: "off", size: "4", value: ratios[name] });
    ratio.addEventListener("input", () => {
      ratios[name] = ratio.value.trim().replace(",", ".").replace(/\s*:\s*1$/, "");  // 13:1 is 13
      const isWrong = ratios[name] !== "" && !(Number(ratios[name]) > 0);
      ratio.setAttribute("aria-invalid", String(isWrong));
      tell(isWrong ? `${name}: "${ratio.value}" is no mixing ratio; it is left out of a fit by ratio.` : "");
      showButtons();
    });
    return make("div", { class: "specimen" }, make("label", { class: "switch" }, box, name), ratio);
  }));
}

export function alsoCompare(name) {
  if (chosen.size < kMost) chosen.add(name);
}

const tell = (text, kind = "note") => { element("compare-status").className = kind; showText(element("compare-status"), text); };

export async function compare() {
  const number = ++asked;
  tell("");
  for (const name of chosen) {
    try {
      fits[name] = (await order("/api/desk/fit", { table: name, ...(optionsOf(name) ? { options: optionsOf(name) } : {}) })).result;
    } catch (error) {
      fits[name] = null;
      tell(`${name}: ${error.message}`, "alert");
    }
    if (number !== asked) return;
  }
  draw();
  showRows();
}

const fitted = () => [...chosen].filter((name) => fits[name]);
const withRatio = () => fitted().filter((name) => Number(ratios[name]) > 0);

function showButtons() {
  element("compare-together").disabled = fitted().length < 2;
  element("compare-ratios").disabled = withRatio().length < 3;  // fewer show no law
}

function showRows() {
  const names = fitted();
  const head = make("tr", {}, make("th", { scope: "col" }, "Quantity"), ...names.map((name, i) =>
    make("th", { scope: "col", class: "number" }, ...(kColors[i] ? [make("span", { class: `key ${kColors[i]}` })] : []), name)));
  const columns = names.map((name) => rowsOf(fits[name]));
  const longest = columns.reduce((most, rows) => (rows.length > most.length ? rows : most), []);
  const body = longest.map(([label], i) => make("tr", {}, make("th", { scope: "row" }, ...label.map((node) => node.cloneNode(true))),
    ...columns.map((rows) => make("td", { class: "number" }, ...(rows[i] ? [rows[i][1], make("br"), make("small", {}, rows[i][2])] : [])))));
  element("compare-moduli").tHead.replaceChildren(head);
  element("compare-moduli").tBodies[0].replaceChildren(...body);
}

function draw() {
  if (chart) chart.close();
  chart = null;
  const names = fitted().slice(0, kColors.length);
  showButtons();
  if (fitted().length > names.length) tell(`The picture shows the first ${kColors.length}.`);
  show(element("compare-body"), names.length > 0);
  if (names.length === 0) return;
  const kinds = new Set(names.map((name) => `${fits[name].curves.argument} ${fits[name].curves.columns[0].name}`));
  const isRelative = element("compare-relative").checked;
  if (kinds.size > 1 && !isRelative) tell("These tables are of different quantities; relative values can be compared.");
  const logs = () => ({ x: element("compare-log-x").checked, y: element("compare-log-y").checked });
  const rows = [];
  const { argument, columns: [quantity] } = fits[names[0]].curves;
  const largest = isRelative ? 0 : names.flatMap((name) => fits[name].curves.columns[0].fitted).reduce((most, y) => Math.max(most, Math.abs(y)), 0);
  const axis = axisOf(quantity.name, largest);
  names.forEach((name, k) => {
    const { values, columns } = fits[name].curves;
    const first = columns[0], scale = isRelative ? 1 / Math.max(...first.fitted.map(Math.abs)) : axis.factor;
    values.forEach((x, i) => {
      const row = new Array(1 + 2 * names.length).fill(null);
      [row[0], row[1 + 2 * k], row[2 + 2 * k]] = [x, first.measured[i] * scale, first.fitted[i] * scale];
      if ((!logs().x || x > 0) && (!logs().y || (row[1 + 2 * k] > 0 && row[2 + 2 * k] > 0))) rows.push(row);
    });
  });
  rows.sort((a, b) => a[0] - b[0]);
  const labels = names.flatMap((name) => [`${name} data`, `${name} fit`]);
  chart = new Chart(element("compare-chart"), {
    labels: [argument, ...labels], colors: names.flatMap((name, k) => [kColors[k], kColors[k]]),
    points: labels.filter((label) => label.endsWith(" data")), logs,
    titles: { xlabel: axisOf(argument).label, ylabel: isRelative ? "relative value" : axis.label },
    readout: (x) => { element("compare-readout").textContent = x === null ? "" : significant(x, 4); },
  });
  chart.show(rows);
}
