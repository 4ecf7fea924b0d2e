// A fit of tests at large strain: the law, the laws beside it, the tests, and their picture.
import { showBody, showFlags, showJudgement } from "./desk_fit.js";
import { element, make, modulusUnit, range, significant } from "./format.js";
import { rowsOf } from "./moduli.js";

// The law that was chosen, with the keys of a linear fit.
export function lawOf(fit) {
  const law = fit.laws.find((one) => one.name === fit.law) ?? fit.laws[0];
  return { ...law, terms: law.terms.map((term) => ({ ...term, interval_95: { g: term.g_interval_95, tau_s: term.tau_s_interval_95 } })) };
}

const number = (text) => make("td", { class: "number" }, text);
const row = (name, ...cells) => make("tr", {}, make("th", { scope: "row" }, ...[name].flat()), ...cells.map(number));

// "C10_Pa" as "C10" in kPa.
function parameterRow({ name, value, interval_95 }) {
  const { factor, unit } = name.endsWith("_Pa") ? modulusUnit(value) : { factor: 1, unit: "" };
  const withUnit = (text) => `${text} ${unit}`.trim();
  return row(name.replace(/_Pa$/, ""), withUnit(significant(value * factor, 5)), withUnit(range(interval_95, factor, 5)));
}

export function showRubber({ result: fit, pictures }) {
  const law = lawOf(fit), flags = [...fit.flags, ...law.flags];
  showJudgement({ trustworthy: fit.trustworthy, flags });
  showBody("rubber-body");
  showFlags(element("rubber-flags"), flags);
  element("rubber-picture").replaceChildren(...pictures.map(({ svg }) => make("img", {
    src: `data:image/svg+xml;charset=utf-8,${encodeURIComponent(svg)}`, alt: `Stresses over stretch with the law ${fit.law}` })));
  element("rubber-law").caption.textContent = `Law: ${fit.law}`;
  element("rubber-law").tBodies[0].replaceChildren(...rowsOf(law).map(([name, ...cells]) => row(name, ...cells)), ...law.parameters.map(parameterRow));
  element("rubber-laws").tBodies[0].replaceChildren(...fit.laws.map((one) => {
    const { factor, unit } = modulusUnit(one.E0_Pa);
    return row(one.name === fit.law ? make("b", {}, one.name) : one.name, `${significant(100 * one.rms_relative, 3)} %`, significant(one.bic, 5),
               `${significant(factor * one.E0_Pa, 4)} ${unit}`);
  }));
  element("rubber-tests").tBodies[0].replaceChildren(...fit.tests.map(({ file, deformation, stretch, rms_Pa }) => {
    const { factor, unit } = modulusUnit(rms_Pa);
    return row(file, deformation, range(stretch, 1, 3), `${significant(factor * rms_Pa, 3)} ${unit}`);
  }));
}
