// A scene: its text, drawing, effects with their estimates, answers with their errors, and what accuracy costs.
import { order } from "./api.js";
import { Chart } from "./charts.js";
import { showSame } from "./desk_options.js";
import { axisOf, element, list, make, sentence, show, showText, significant } from "./format.js";

let scene = "", kept = "", asked = 0, chart = null, refresh = () => {};

export function startScene(described, onNewFile) {
  refresh = onNewFile;
  element("scene-example").replaceChildren(make("option", { value: "" }, "choose one"),
    ...described.examples.map((one) => make("option", { value: one.name, title: one.what }, one.name.replace(".toml", ""))));
  element("scene-example").addEventListener("change", (event) => { if (event.target.value) open({ example: event.target.value }); event.target.value = ""; });
  element("scene-name").addEventListener("change", (event) => { if (event.target.value) open({ scene: event.target.value }); });
  element("scene-text").addEventListener("input", () => { element("scene-keep").disabled = element("scene-text").value === kept; });
  element("scene-keep").addEventListener("click", () => open({ scene, text: element("scene-text").value }));
  element("scene-solve").addEventListener("click", solve);
  element("scene-cost").addEventListener("click", cost);
  element("scene-tol").addEventListener("change", plan);
  for (const id of ["scene-solve", "scene-cost"]) element(id).disabled = true;
}

export function showScenes(names) {
  element("scene-name").replaceChildren(make("option", { value: "" }, names.length ? "choose one" : "none yet"),
    ...names.map((name) => make("option", { value: name }, name)));
  element("scene-name").value = names.includes(scene) ? scene : "";
}

const tell = (text, kind = "note") => { element("scene-status").className = kind; showText(element("scene-status"), text); };
const tolerance = () => { const text = element("scene-tol").value.trim(); return text ? { tol: text } : {}; };
const pythonOf = (call) => `import viscard\nprint(viscard.${call}(${JSON.stringify(scene)}${call === "cost" ? ", budget=10" : tolerance().tol ? `, tol=${tolerance().tol}` : ""}))`;

// Asks one thing about the scene; what was asked before is forgotten.
async function about(what, doing, work) {
  const number = ++asked;
  tell(doing, "");
  element("scene-same").replaceChildren();
  try {
    const answer = await order("/api/desk/scene", { scene, what, ...tolerance() });
    if (number !== asked) return;
    tell("");
    work(answer);
  } catch (error) {
    if (number === asked) tell(sentence(error.message), "alert");
  }
}

async function open(request) {
  try {
    const opened = await order("/api/desk/scene/open", request);
    scene = opened.scene;
    kept = opened.text;
    element("scene-text").value = kept;
    element("scene-keep").disabled = true;
    for (const id of ["scene-solve", "scene-cost"]) element(id).disabled = false;
    for (const id of ["scene-answer", "scene-answer-title", "scene-cost-body"]) show(element(id), false);
    list(element("scene-notes"), []);
    show(element("scene-body"), true);
    await refresh();
    showScenesOf();
    await about("drawing", "Drawing …", (answer) => showPictures(answer.pictures));
    if (element("scene-status").className !== "alert") await plan();
  } catch (error) {
    tell(sentence(error.message), "alert");
  }
}
const showScenesOf = () => { element("scene-name").value = scene; };

function plan() {
  if (!scene) return undefined;
  return about("plan", "Choosing the effects …", ({ command, result }) => {
    showEffects(result.effects);
    showSame(element("scene-same"), command, pythonOf("plan"), result);
  });
}

function solve() {
  return about("answer", "Solving …", ({ command, result, pictures }) => {
    showResults(result);
    showEffects(result.effects);
    showPictures(pictures);
    showSame(element("scene-same"), command, pythonOf("simulate"), result);
    const doubt = result.tolerance_doubt;
    tell(doubt ? sentence(doubt) : `Errors and effects are within the tolerance; ${result.unknowns} unknowns, ${significant(result.wall_s, 2)} s.`,
         doubt ? "alert" : "good");
  });
}

function cost() {
  return about("cost", "Measuring for ten seconds …", ({ command, result }) => {
    showCost(result);
    showSame(element("scene-same"), command, pythonOf("cost"), result);
  });
}

function showPictures(pictures) {
  element("scene-pictures").replaceChildren(...pictures.map(({ name, svg }) => {
    const caption = axisOf(name).label;  // "static_stress_zz_Pa"
    return make("figure", {}, make("img", { src: `data:image/svg+xml;charset=utf-8,${encodeURIComponent(svg)}`, alt: caption }),
                make("figcaption", {}, caption));
  }));
}

// A bar from a millionth to one of the answer.
function barOf(effect) {
  const bar = make("span", { class: effect.on ? "bar on" : "bar" });
  bar.style.width = `${Math.min(100, Math.max(1, 100 * (1 + Math.log10(effect.estimate) / 6)))}%`;
  return bar;
}

function showEffects(effects) {
  const sized = effects.filter((one) => one.estimate !== null && one.estimate > 0).sort((a, b) => b.estimate - a.estimate);
  const others = effects.filter((one) => one.on && !sized.includes(one));
  element("scene-effects").tBodies[0].replaceChildren(...[...sized, ...others].map((one) =>
    make("tr", { title: one.reason }, make("th", { scope: "row" }, one.name.replaceAll("_", " ")), make("td", {}, one.on ? "computed" : "left out"),
         make("td", { class: "number" }, one.estimate ? `${significant(100 * one.estimate, 2)} %` : ""), make("td", { class: "bars" }, ...(one.estimate ? [barOf(one)] : [])))));
}

// The unit with the prefix that leaves one to three digits before the point; of squares and quotients none.
function prefixed(unit, size) {
  if (unit === "1" || unit === "%" || !/^[A-Za-z]+(\/[A-Za-z]+)?$/.test(unit) || !(size > 0)) return { factor: 1, unit: unit === "1" ? "" : unit };
  const thousands = Math.max(-6, Math.min(3, Math.floor(Math.log10(size) / 3 + 1e-9)));
  return { factor: 10 ** (-3 * thousands), unit: ["a", "f", "p", "n", "µ", "m", "", "k", "M", "G"][thousands + 6] + unit };
}

function showResults(result) {
  const rows = [...Object.entries(result.results).map(([name, one]) => [name.replaceAll("_", " "), one.value, one.error_estimate, one.unit]),
    ...result.modes.map((mode) => [`${mode.family} mode`, mode.frequency_Hz, mode.error_estimate, "Hz"])];
  element("scene-results").tHead.replaceChildren(make("tr", {}, ...["Result", "Value", "Error"].map((text) => make("th", { scope: "col" }, text))));
  element("scene-results").tBodies[0].replaceChildren(...rows.map(([name, value, error, unit]) => {
    const shown = prefixed(unit, Math.abs(value));
    return make("tr", {}, make("th", { scope: "row" }, name), make("td", { class: "number" }, `${significant(value * shown.factor, 6)} ${shown.unit}`),
                make("td", { class: "number" }, `± ${significant(error * shown.factor, 2)}`));
  }));
  for (const id of ["scene-answer", "scene-answer-title"]) show(element(id), true);
  list(element("scene-notes"), result.notes.map(sentence));
}

function showCost(result) {
  const rows = result.rows.filter((row) => row.cpu_s > 0 && row.error > 0);
  show(element("scene-cost-body"), rows.length > 0);
  if (rows.length === 0) return tell("Nothing could be measured within ten seconds.");
  if (chart) chart.close();
  const sorted = [...rows].sort((a, b) => a.cpu_s - b.cpu_s);
  chart = new Chart(element("scene-chart"), {
    labels: ["cpu_s", "relative error"], colors: ["fit"], points: ["relative error"], logs: () => ({ x: true, y: true }),
    titles: { xlabel: "processor time (s)", ylabel: "relative error" },
    readout: (x, i) => { const row = x === null ? null : sorted[i];
      element("scene-readout").textContent = row ? `${row.discretisation}, ${row.effects}: ${significant(row.error, 2)} in ${significant(row.cpu_s, 2)} s` : ""; },
  });
  chart.show(sorted.map((row) => [row.cpu_s, row.error]));
  element("scene-choices").replaceChildren(...sorted.filter((row) => row.pareto).map((row) => {
    const button = make("button", { type: "button" }, `${significant(row.error, 2)} in ${significant(1e3 * row.cpu_s, 2)} ms`);
    button.addEventListener("click", () => { element("scene-tol").value = String(Number(row.error.toPrecision(2))); solve(); });
    return button;
  }));
  return undefined;
}
