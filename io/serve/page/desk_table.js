// A table as it was read: columns with quantity, unit and guesses, rows, notes.
import { element, list, make, sentence, show, showText, significant } from "./format.js";

const plural = (n, one) => `${n} ${one}${n === 1 ? "" : "s"}`;

function summaryOf(table) {
  const parts = [plural(table.n_rows, "row"), plural(table.columns.length, "column"),
                 table.maker || `divided by ${table.separator}`];
  if (!table.has_header) parts.push("no header");
  if (table.decimal_comma) parts.push("decimal comma");
  const kind = table.kind ? `Read as ${table.kind}` : "Kind of test not known";
  const of = !table.modulus_kind ? "" : `, moduli of ${table.modulus_kind}`
    + (table.modulus_kind_from === "assumed" ? " (assumed: nothing states it)" : ` (by ${table.modulus_kind_from})`);
  return `${parts.join(", ")}. ${kind}${of}.`;
}

let quantities = [], onColumns = () => {};

export function startTable(described, handler) {
  quantities = described.quantities;
  onColumns = handler;
}

// "modulus_Pa=2 [kPa]" of the column that a person has named, or nothing.
const statedOf = (column, stated) => stated.find((one) => new RegExp(`=-?${column.number}( \\[|$)`).test(one));

// The words of --column after this column was named anew; an empty quantity: the program decides again.
function restated(column, stated, quantity, unit) {
  const kept = stated.filter((one) => one !== statedOf(column, stated) && !one.startsWith(`${quantity}=`));
  if (quantity) kept.push(`${quantity}=${column.number}${unit ? ` [${unit}]` : ""}`);
  return kept.length > 0 ? kept : undefined;
}

// What a column is: a list of the known quantities, and its unit.
function choiceOf(column, stated) {
  const now = statedOf(column, stated);
  const named = now ? now.split("=")[0] : "";
  const unit = now && /\[(.*)\]/.exec(now)?.[1];
  const byItself = now ? "as the table says" : column.quantity || "not known";
  const select = make("select", { "aria-label": `Quantity of ${column.header || `column ${column.number}`}`, class: now ? "chosen" : undefined },
    make("option", { value: "" }, byItself), ...quantities.map((one) => make("option", { value: one }, one)));
  select.value = named;
  const input = make("input", { "aria-label": `Unit of ${column.header || `column ${column.number}`}`, placeholder: column.unit || "unit",
                                autocomplete: "off", spellcheck: "false", value: unit || "", class: unit ? "chosen" : undefined });
  const change = () => onColumns(restated(column, stated, select.value || (input.value.trim() ? column.quantity : ""), input.value.trim()));
  select.addEventListener("change", change);
  input.addEventListener("change", change);
  return column.derived_from ? [] : [select, input];
}

function headOf(column, stated) {
  const scale = column.factor === 1 && column.offset === 0 ? "" : ` × ${significant(column.factor, 6)}`
    + (column.offset ? ` + ${significant(column.offset, 6)}` : "");
  const what = !column.quantity ? "not known" : column.used ? `${column.quantity}${scale}` : `${column.quantity}, not used`;
  const guess = column.guessed ? sentence(column.guessed) : column.derived_from ? `Computed from ${column.derived_from}.` : "";
  const gaps = column.n_gaps > 0 ? `${plural(column.n_gaps, "cell")} without a number (${column.first_gap})` : "";
  return make("th", { scope: "col", class: column.used ? "used" : undefined },
              make("span", { class: "quantity" }, what), make("br"), column.header || `column ${column.number}`, ...choiceOf(column, stated),
              ...[guess, gaps].filter(Boolean).map((text) => make("span", { class: "guess" }, text)));
}

// stated: the words of --column.
export function showTable(table, stated) {
  showText(element("table-error"), sentence(table.kind_trouble));
  show(element("table-body"), true);
  element("table-summary").textContent = summaryOf(table);
  list(element("table-notes"), table.notes.map(sentence));
  const rows = element("rows");
  rows.tHead.replaceChildren(make("tr", {}, make("th", { scope: "col" }, "line"), ...table.columns.map((column) => headOf(column, stated))));
  rows.tBodies[0].replaceChildren(...table.lines.map((line, i) => make("tr", {}, make("th", { scope: "row" }, String(line)),
    ...table.columns.map((column) => make("td", { class: column.cells[i] === "" ? "gap" : column.used ? undefined : "unused" },
                                          column.cells[i] ?? "")))));
  const shown = table.lines.length;
  element("rows-shown").textContent = shown < table.n_rows ? `The first ${shown} of ${table.n_rows} rows.` : "";
}

export function showTableError(text) {
  showText(element("table-error"), sentence(text));
  show(element("table-body"), false);
}
