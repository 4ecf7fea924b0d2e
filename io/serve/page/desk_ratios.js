// A fit over mixing ratios: the modulus of each specimen and ratio, specimens that lie apart, the material of each ratio.
import { Chart } from "./charts.js";
import { showBody, showFlags } from "./desk_fit.js";
import { axisOf, element, fixed, make, showText, significant } from "./format.js";
import { rowsOf } from "./moduli.js";

let fit = null, chart = null;

const number = (text) => make("td", { class: "number" }, text);
const materialOf = (ratio) => fit.materials.find((one) => one.mixing_ratio === ratio);

function draw() {
  if (element("ratio-chart").clientHeight === 0) return;
  if (chart) chart.close();
  const largest = Math.max(...fit.specimens.map((one) => one.E0_Pa));
  const axis = axisOf("E0_Pa", largest);
  const rows = [...fit.specimens.map((one) => [one.mixing_ratio, axis.factor * one.E0_Pa, null, null, null]),
                ...fit.materials.map((one) => [one.mixing_ratio, null, ...[...one.uncertainty.E0_interval_95, one.E0_Pa].map((E) => axis.factor * E)])]
    .sort((a, b) => a[0] - b[0]);
  chart = new Chart(element("ratio-chart"), {
    labels: ["mixing ratio", "specimen", "low", "high", "material"], colors: ["measured", "depth", "depth", "fit"], points: ["specimen"],
    titles: { xlabel: "mixing ratio (parts of base to one of curing agent)", ylabel: axis.label },
    readout: (x) => {
      const material = x === null ? null : materialOf(x);
      element("ratio-readout").textContent = material ? `${significant(x)}:1: ${significant(axis.factor * material.E0_Pa, 5)} ${axis.unit}` : "";
    },
  });
  chart.show(rows);
}

// A specimen outside the 95 % interval of a new one of its ratio is marked.
function showSpecimens() {
  element("ratio-specimens").tBodies[0].replaceChildren(...fit.specimens.map(({ name, mixing_ratio, E0_Pa }) => {
    const { E0_Pa: usual, uncertainty: { E0_interval_95: [low, high] } } = materialOf(mixing_ratio);
    const apart = fixed(100 * (E0_Pa / usual - 1), 1), { factor, unit } = axisOf("E0_Pa", usual);
    return make("tr", { class: E0_Pa < low || E0_Pa > high ? "wrong" : undefined }, make("th", { scope: "row" }, name), number(`${significant(mixing_ratio)}:1`),
                number(`${significant(factor * E0_Pa, 5)} ${unit}`), number(`${Number(apart) > 0 ? "+" : ""}${apart} %`));
  }));
}

function showMaterials() {
  const columns = fit.materials.map((one) => rowsOf({ ...one, ...one.uncertainty, E_inf_Pa: one.E0_Pa * (1 - one.terms.reduce((sum, term) => sum + term.g, 0)) }));
  const table = element("ratio-moduli");
  table.tHead.replaceChildren(make("tr", {}, make("th", { scope: "col" }, "Quantity"),
    ...fit.materials.map((one) => make("th", { scope: "col", class: "number" }, `${significant(one.mixing_ratio)}:1`))));
  table.tBodies[0].replaceChildren(...columns[0].map(([label], i) => make("tr", {}, make("th", { scope: "row" }, ...label),
    ...columns.map((rows) => make("td", { class: "number" }, rows[i][1], make("br"), make("small", {}, rows[i][2]))))));
}

export function showRatios(result) {
  fit = result;
  const status = element("fit-status");
  status.className = fit.flags.length > 0 ? "note" : "good";
  showText(status, `${fit.summary}.`);
  showBody("ratio-body");
  showFlags(element("ratio-flags"), fit.flags);
  showSpecimens();
  showMaterials();
  draw();
}

// The chart has no size while its view is hidden.
export function redrawRatios() {
  if (fit && !element("ratio-body").hidden) draw();
}
