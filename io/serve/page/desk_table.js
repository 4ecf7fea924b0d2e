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

function headOf(column) {
  const scale = column.factor === 1 && column.offset === 0 ? "" : ` × ${significant(column.factor, 6)}`
    + (column.offset ? ` + ${significant(column.offset, 6)}` : "");
  const what = !column.quantity ? "not known" : column.used ? `${column.quantity}${scale}` : `${column.quantity}, not used`;
  const guess = column.guessed ? sentence(column.guessed) : column.derived_from ? `Computed from ${column.derived_from}.` : "";
  const gaps = column.n_gaps > 0 ? `${plural(column.n_gaps, "cell")} without a number (${column.first_gap})` : "";
  return make("th", { scope: "col", class: column.used ? "used" : undefined },
              make("span", { class: "quantity" }, what), make("br"), column.header || `column ${column.number}`,
              ...[guess, gaps].filter(Boolean).map((text) => make("span", { class: "guess" }, text)));
}

export function showTable(table) {
  showText(element("table-error"), sentence(table.kind_trouble));
  show(element("table-body"), true);
  element("table-summary").textContent = summaryOf(table);
  list(element("table-notes"), table.notes.map(sentence));
  const rows = element("rows");
  rows.tHead.replaceChildren(make("tr", {}, make("th", { scope: "col" }, "line"), ...table.columns.map(headOf)));
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
