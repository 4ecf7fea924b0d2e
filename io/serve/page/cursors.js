// Below a chart: two cursors, which are dragged by mouse or finger or moved with keys, with the values of all curves there,
// their differences and ratios; and what is shown as a table in a file.
import { axisOf, make, save, show, significant } from "./format.js";

const kStep = 1 / 200, kLargeStep = 1 / 20;  // of the width of the chart
const kKeys = { ArrowRight: kStep, ArrowUp: kStep, ArrowLeft: -kStep, ArrowDown: -kStep, PageUp: kLargeStep, PageDown: -kLargeStep,
                Home: -1, End: 1 };
const kNames = ["A", "B"], kStart = [1 / 3, 2 / 3];

const quoted = (text) => (/[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);
const number = (text) => make("td", { class: "number" }, text);
const short = (value) => { const text = significant(value, 4); return text.length > 9 ? value.toExponential(2).replace(/^-/, "−") : text; };

class Cursors {
  constructor(node) {
    const title = node.getAttribute("aria-label");
    this.chart = null;
    this.isOn = false;
    this.x = [];
    this.handles = kNames.map((name, k) => this.handle(name, k, title));
    this.button = make("button", { type: "button", "aria-pressed": "false", "aria-label": `Cursors: ${title}` }, "Cursors");
    this.button.addEventListener("click", () => this.turn(!this.isOn));
    const table = make("button", { type: "button", "aria-label": `Save as CSV: ${title}` }, "Save as CSV");
    table.addEventListener("click", () => this.saveTable());
    this.values = make("table", { class: "cursor-values", hidden: true }, make("caption", { class: "unseen" }, `Values at the cursors: ${title}`),
                       make("thead", {}, make("tr", {}, make("th", { scope: "col" }, "At the cursor"),
                            ...[...kNames, "B − A", "B / A"].map((text) => make("th", { scope: "col", class: "number" }, text)))), make("tbody"));
    const frame = make("div", { class: "cursor-frame" });
    node.before(frame);
    frame.append(node, ...this.handles, make("div", { class: "chart-bar" }, this.button, table), this.values);
  }

  handle(name, k, title) {
    const handle = make("div", { class: "cursor", role: "slider", tabindex: "0", "aria-label": `Cursor ${name}: ${title}`, hidden: true }, make("b", {}, name));
    let from_px = 0;  // from the cursor to the pointer
    handle.addEventListener("pointerdown", (event) => {
      if (event.button !== 0 || !event.isPrimary) return;
      event.preventDefault();
      handle.setPointerCapture(event.pointerId);
      handle.focus({ preventScroll: true });
      from_px = event.clientX - handle.getBoundingClientRect().left;
    });
    handle.addEventListener("pointermove", (event) => {
      if (!handle.hasPointerCapture(event.pointerId)) return;
      const area = this.chart.graph.getArea(), middle_px = handle.offsetWidth / 2;
      this.move(k, (event.clientX - from_px + middle_px - handle.parentElement.getBoundingClientRect().left - area.x) / area.w);
    });
    handle.addEventListener("keydown", (event) => {
      const step = kKeys[event.key];
      if (!step || event.ctrlKey || event.altKey || event.metaKey) return;
      event.preventDefault();
      this.move(k, this.chart.graph.toPercentXCoord(this.x[k]) + (event.shiftKey ? kLargeStep / kStep : 1) * step);
    });
    return handle;
  }

  // The node has a new chart; the cursors stay where they were.
  attach(chart) {
    this.chart = chart;
    this.place();
  }

  turn(isOn) {
    this.isOn = isOn;
    this.button.setAttribute("aria-pressed", String(isOn));
    show(this.values, isOn);
    for (const handle of this.handles) show(handle, isOn);
    if (!isOn) return;
    this.x = [];  // where they are seen
    this.place();
  }

  xAt(share) {
    const { graph } = this.chart, area = graph.getArea();
    return graph.toDataXCoord(area.x + Math.min(1, Math.max(0, share)) * area.w);
  }

  move(k, share) {
    this.x[k] = this.xAt(share);
    this.place();
  }

  // After the chart was drawn. Of other data the cursors are set anew; those beside the part that is shown are hidden.
  place() {
    const graph = this.chart?.graph;
    if (!this.isOn || !graph) return;
    const area = graph.getArea(), [low, high] = graph.xAxisExtremes(), shown = graph.xAxisRange();
    this.handles.forEach((handle, k) => {
      if (!(this.x[k] >= low && this.x[k] <= high)) this.x[k] = this.xAt(kStart[k]);
      const share = graph.toPercentXCoord(this.x[k]);
      show(handle, share > -1e-6 && share < 1 + 1e-6);
      Object.assign(handle.style, { left: `${area.x + share * area.w}px`, top: `${area.y}px`, height: `${area.h}px` });
    });
    this.fill(shown);
  }

  names() {
    const { labels, names } = this.chart.options;
    return names ?? [axisOf(labels[0]).label.replace(/ \(.*\)$/, ""), ...labels.slice(1)];
  }

  // All columns at x, between neighbouring points of each; null where a curve has none.
  valuesAt(x) {
    const { data } = this.chart;
    let from = 0, end = data.length;
    while (from < end) {
      const middle = (from + end) >> 1;
      if (data[middle][0] < x) from = middle + 1; else end = middle;
    }
    const isThere = (row, column) => row[column] !== null && Number.isFinite(row[column]);
    return [x, ...this.chart.options.labels.slice(1).map((_, i) => {
      let before = from - 1, after = from;
      while (before >= 0 && !isThere(data[before], i + 1)) --before;
      while (after < data.length && !isThere(data[after], i + 1)) ++after;
      if (after < data.length && data[after][0] === x) return data[after][i + 1];
      if (before < 0 || after >= data.length) return null;
      const [x0, x1] = [data[before][0], data[after][0]], [y0, y1] = [data[before][i + 1], data[after][i + 1]];
      return x1 > x0 ? y0 + (y1 - y0) * (x - x0) / (x1 - x0) : y1;
    })];
  }

  fill(shown) {
    const { units } = this.chart.options, names = this.names(), [a, b] = this.x.map((x) => this.valuesAt(x));
    const withUnit = (value, i) => `${significant(value, 5)}${value === null || !units[i] ? "" : ` ${units[i]}`}`;
    [a, b].forEach((values, k) => {
      const [low, high] = shown;
      for (const [key, value] of [["min", low], ["max", high], ["now", values[0]]]) this.handles[k].setAttribute(`aria-value${key}`, String(Number(value.toPrecision(6))));
      this.handles[k].setAttribute("aria-valuetext", `${withUnit(values[0], 0)}: ${names.slice(1).map((name, i) => `${name} ${withUnit(values[i + 1], i + 1)}`).join(", ")}`);
    });
    const isBoth = (i) => a[i] !== null && b[i] !== null;
    this.values.tBodies[0].replaceChildren(...names.map((name, i) => make("tr", {},
      make("th", { scope: "row" }, units[i] ? `${name} (${units[i]})` : name), number(significant(a[i], 5)), number(significant(b[i], 5)),
      number(isBoth(i) ? short(b[i] - a[i]) : "–"), number(isBoth(i) ? short(b[i] / a[i]) : "–"))));
  }

  // The rows that are seen, with all curves.
  saveTable() {
    if (!this.chart?.graph) return;
    const { options: { units, file }, data, graph } = this.chart, [low, high] = graph.xAxisRange();
    const head = this.names().map((name, i) => quoted(units[i] ? `${name} (${units[i]})` : name)).join(",");
    const rows = data.filter((row) => row[0] >= low && row[0] <= high).map((row) => row.map((value) => value ?? "").join(","));
    save(`${file()}.csv`, `# as drawn: rows may be averages of readings, or left out\n${[head, ...rows].join("\n")}\n`, "text/csv");
  }
}

const cursors = new WeakMap();

// Those of the node of a chart, which may get one chart after another.
export function cursorsOf(node) {
  if (!cursors.has(node)) cursors.set(node, new Cursors(node));
  return cursors.get(node);
}
