// Line charts by dygraphs (MIT): force and depth with the limit lines of the load cell.
/* global Dygraph */
import { cursorsOf } from "./cursors.js";

const color = (name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
const isTouch = matchMedia("(pointer: coarse)").matches;
const charts = new Set();

// The page has legends of its own, and this one sets styles that the content security policy forbids.
Dygraph.PLUGINS = Dygraph.PLUGINS.filter((plugin) => plugin !== Dygraph.Plugins.Legend);

// A number of an axis: no more digits than there is room for.
function shortNumber(value) {
  const text = String(Number(value.toPrecision(4)));
  return (text.length <= 7 ? text : value.toExponential(1)).replace("-", "−");
}

// One chart. options: labels of the columns, colors by name, right: label of the column on the right
// axis, titles: {xlabel, ylabel, y2label}, limits: [{value, text, color}], range() of the left axis, window()
// of the time, onWindow([from, to]) when that changes, readout(row), points, sizeOf(label) of their points, dashes by label, band,
// logs() = {x, y}: which axes are logarithmic, isStill: dragging does not choose a part. With units, one for each label, it has
// cursors (cursors.js): names of the columns if not the labels, file(): name of a file of them, without its ending.
export class Chart {
  constructor(node, options) {
    this.node = node;
    this.options = options;
    this.data = [];
    this.graph = null;
    // dygraphs gives what it draws while it is hidden a size of its own for good, so that waits until it is seen.
    this.observer = new ResizeObserver(() => {
      if (this.graph && this.isSeen()) this.graph.resize();
      else this.buildIfSeen();
    });
    this.cursors = options.units ? cursorsOf(node) : null;
    this.observer.observe(node);
    charts.add(this);
  }

  show(data) {
    this.data = data;
    if (data.length < 2) return;
    if (this.graph) this.graph.updateOptions({ file: data, ...this.ranges() });
    else this.buildIfSeen();
  }

  isSeen() {
    return this.node.clientHeight > 0;
  }

  buildIfSeen() {
    if (!this.graph && this.data.length >= 2 && this.isSeen()) this.build();
  }

  // Draws everything again: another theme, another test.
  rebuild() {
    if (this.graph) this.graph.destroy();
    this.graph = null;
    this.buildIfSeen();
  }

  // It is not drawn again.
  close() {
    this.observer.disconnect();
    if (this.graph) this.graph.destroy();
    this.graph = null;
    charts.delete(this);
  }

  // Shows this part of the time, as another chart does that it belongs to.
  showWindow([from, to]) {
    if (!this.graph) return;
    const [now_from, now_to] = this.graph.xAxisRange();
    const least = 1e-6 * (to - from);  // charts that follow each other must come to an end
    if (Math.abs(now_from - from) + Math.abs(now_to - to) < least) return;
    this.graph.updateOptions({ dateWindow: [from, to] });
  }

  // The zeros of both axes lie at one height, and the right one reaches half of the height, so that its
  // curve does not meet the limit lines of the left one.
  ranges() {
    const left = this.options.range ? this.options.range() : null;
    const most = this.options.right ? Math.max(...this.data.map((row) => row[2])) : 0;
    const scale = left && most > 0 ? 2 * most / left[1] : 0;
    const label = { axisLabelWidth: 54, drawGrid: true,
                    ...(this.options.logs ? { axisLabelFormatter: (y) => shortNumber(y) } : {}) };
    const logs = this.options.logs ? this.options.logs() : { x: false, y: false };
    return {
      axes: {
        x: { drawGrid: false, pixelsPerLabel: 45, logscale: logs.x,
             ...(this.options.isStill ? { axisLabelFormatter: (x) => shortNumber(x) } : {}) },
        y: { ...label, valueRange: left, logscale: logs.y },
        y2: { ...label, drawGrid: false, independentTicks: true,
              valueRange: scale > 0 ? left.map((end) => end * scale) : null },
      },
      ...(this.options.window ? { dateWindow: this.options.window() } : {}),
    };
  }

  build() {
    const { labels, colors, right, points, sizeOf, dashes, titles, onWindow } = this.options;
    const series = {};
    labels.slice(1).forEach((name, i) => {
      series[name] = { color: color(colors[i]), strokeWidth: 1.75, ...(dashes?.[name] ? { strokePattern: dashes[name] } : {}) };
      if (name === right) series[name].axis = "y2";
      if (points && points.includes(name)) {
        Object.assign(series[name], { strokeWidth: 0, drawPoints: true, pointSize: sizeOf ? sizeOf(name) : 2.2 });
      }
    });
    this.graph = new Dygraph(this.node, this.data, {
      labels, series, legend: "never", rightGap: 12,
      xRangePad: this.options.logs && this.options.logs().x ? 0 : 4,  // it would reach below zero
      connectSeparatedPoints: true,
      gridLineColor: color("line"), axisLineColor: color("line"), axisLabelFontSize: 13,
      digitsAfterDecimal: 4, xLabelHeight: 16, yLabelWidth: 16, ...titles, ...this.ranges(),
      drawCallback: (graph) => {
        if (onWindow) onWindow(graph.xAxisRange());
        if (this.cursors) this.cursors.place();
      },
      // A finger must be able to scroll the page over a chart.
      ...(isTouch || this.options.isStill ? { interactionModel: {} } : {}),
      underlayCallback: (context, area, graph) => this.drawUnder(context, area, graph),
      highlightCallback: (event, x, row) => this.options.readout && this.options.readout(x, row),
      unhighlightCallback: () => this.options.readout && this.options.readout(null),
    });
    if (this.cursors) this.cursors.attach(this);
  }

  drawUnder(context, area, graph) {
    context.save();
    context.font = "12px system-ui, sans-serif";
    if (this.options.band) {
      const [low, high] = this.options.band.map((y) => graph.toDomYCoord(y));
      context.fillStyle = color("band");
      context.fillRect(area.x, high, area.w, low - high);
    }
    this.drawPhases(context, area, graph);
    for (const limit of this.options.limits ? this.options.limits() : []) {
      const y = graph.toDomYCoord(limit.value);
      if (y < area.y || y > area.y + area.h) continue;
      context.strokeStyle = context.fillStyle = color(limit.color);
      context.lineWidth = 1.5;
      context.setLineDash(limit.dash || []);
      context.beginPath();
      context.moveTo(area.x, y);
      context.lineTo(area.x + area.w, y);
      context.stroke();
      context.textAlign = "left";  // where the approach is: the force is highest further right
      context.fillText(limit.text, area.x + 6, y - 4);
    }
    context.restore();
  }

  drawPhases(context, area, graph) {
    context.setLineDash([]);
    context.textAlign = "left";
    context.strokeStyle = color("line");
    context.fillStyle = color("soft-ink");
    let free_from = -Infinity;
    for (const phase of this.options.phases ? this.options.phases() : []) {
      const x = graph.toDomXCoord(phase.start_s);
      if (x < area.x - 1 || x > area.x + area.w) continue;
      context.beginPath();
      context.moveTo(x, area.y);
      context.lineTo(x, area.y + area.h);
      context.stroke();
      if (x < free_from) continue;
      const text = phase.name.replaceAll("_", " ");
      const width = context.measureText(text).width;
      if (x + 4 + width > area.x + area.w) continue;
      context.fillText(text, x + 4, area.y + 12);
      free_from = x + 12 + width;
    }
  }
}

matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
  for (const chart of charts) chart.rebuild();
});

// At most about `most` of the rows: of each group of rows those with the lowest and the highest force.
// Drawing 20 000 rows takes ten times as long as this, five times a second, beside a running test.
export function thinned(rows, most) {
  if (rows.length <= most) return rows;
  const size = Math.ceil(2 * rows.length / most);
  const kept = [];
  for (let from = 0; from < rows.length; from += size) {
    let low = from, high = from;
    const end = Math.min(rows.length, from + size);
    for (let i = from; i < end; ++i) {
      if (rows[i][1] < rows[low][1]) low = i;
      if (rows[i][1] > rows[high][1]) high = i;
    }
    kept.push(rows[Math.min(low, high)]);
    if (low !== high) kept.push(rows[Math.max(low, high)]);
  }
  return kept;
}

// The limit lines of a rig, for the left axis in N.
export function limitsOf(rig) {
  if (!rig || rig.trouble) return [];
  return [{ value: rig.hard_N, text: `reset at ${rig.hard_N.toFixed(2)} N`, color: "limit" },
          { value: rig.soft_N, text: `stop at ${rig.soft_N.toFixed(2)} N`, color: "limit", dash: [8, 4] },
          { value: rig.warn_N, text: `warning at ${rig.warn_N.toFixed(2)} N`, color: "warn", dash: [2, 4] }];
}
