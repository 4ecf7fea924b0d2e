// Parts of a fit that only some have: how tests that were fitted together agree, and the shift factors of a master curve.
import { element, fixed, make, show, significant } from "./format.js";

const kQuantities = { relaxation: ["modulus_Pa"], creep: ["compliance_1_Pa"], indentation: ["force_N"],
                      dma: ["storage_modulus_Pa", "loss_modulus_Pa"] };

// The curves of tests that were fitted together, as those of one table; of tests of several kinds those like the first.
export function withCurves(result) {
  if (result.curves || !result.tests) return result;
  const argumentOf = ({ residuals }) => Object.keys(residuals).find((key) => key === "time_s" || key === "frequency_Hz");
  const alike = result.tests.filter((test) => test.kind === result.tests[0].kind);
  const names = kQuantities[alike[0].kind] ?? ["value"], prefixes = ["", "loss_"], argument = argumentOf(alike[0]);
  const rows = alike.flatMap(({ residuals }) => residuals[argument].map((x, i) => [x, ...names.flatMap((_, k) =>
    ["measured", "fitted", "sigma"].map((key) => residuals[prefixes[k] + key][i]))])).sort((a, b) => a[0] - b[0]);
  const column = (i) => rows.map((row) => row[i]);
  return { ...result, curves: { argument, values: column(0), columns: names.map((name, k) =>
    ({ name, measured: column(1 + 3 * k), fitted: column(2 + 3 * k), sigma: column(3 + 3 * k) })) } };
}

// "+2.98 ± 0.06 %": as many decimals as the interval has meaning.
function percentOf({ relative, interval_95: [low, high] }) {
  const half = 50 * (high - low), decimals = Math.min(6, Math.max(0, 1 - Math.floor(Math.log10(half || 1))));
  const text = fixed(100 * relative, decimals);
  return `${relative > 0 && Number(text) !== 0 ? "+" : ""}${text} ± ${fixed(half, decimals)} %`;
}
const number = (text) => make("td", { class: "number" }, text);
const head = (...titles) => make("tr", {}, make("th", { scope: "col" }, titles[0]),
                                 ...titles.slice(1).map((title) => make("th", { scope: "col", class: "number" }, title)));

function fill(id, isThere, titles, rows) {
  const table = element(id);
  show(table, isThere);
  if (!isThere) return;
  table.tHead.replaceChildren(head(...titles));
  table.tBodies[0].replaceChildren(...rows());
}

export function showParts(fit) {
  fill("fit-tests", Boolean(fit.tests), ["Test", "Above the others, 95 %"], () => fit.tests.map(({ name, file, difference }) =>
    make("tr", { class: difference?.disagrees ? "wrong" : undefined }, make("th", { scope: "row", title: name }, file),
         number(difference ? percentOf(difference) : "–"))));
  const { shift } = fit;
  const freeOf = (temperature) => shift.free_factors.find((one) => one.temperature_C === temperature);
  const log10 = (ln) => significant(ln / Math.LN10, 4);
  const law = { wlf: "by WLF", arrhenius: "by Arrhenius" }[shift?.form] ?? "free";
  fill("fit-shift", Boolean(shift), ["Temperature", `log10 aT ${law}`, "free"], () => shift.factors.map((one) =>
    make("tr", {}, make("th", { scope: "row" }, `${significant(one.temperature_C, 4)} °C${one.temperature_C === shift.T_ref_C ? " (reference)" : ""}`),
         number(`${log10(one.ln_a)} ± ${significant(1.96 * one.ln_a_se / Math.LN10, 2)}`),
         number(freeOf(one.temperature_C) ? log10(freeOf(one.temperature_C).ln_a) : "–"))));
}
