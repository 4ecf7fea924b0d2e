// The options of `viscard fit`, also those of tests at large strain that both share.
#include "io/flow/words/fit_words.h"

namespace viscard {
namespace {

void add_model(OptionList& list, FitWords& words) {
  list.group("The model");
  list.add("kind", &words.kind,
           "indentation, relaxation, creep or dma; by default the columns decide")
      .among({"indentation", "relaxation", "creep", "dma"});
  list.add("terms", &words.terms, "use this number of terms instead of choosing one");
  list.add("max-terms", &words.max_terms, "largest number of terms to try, without --terms")
      .by_default("40");
  list.add("liquid", &words.liquid, "no equilibrium modulus (by itself if the data show none)");
  list.add("solid", &words.solid,
           "keep the equilibrium modulus also where the data do not show it");
  list.add("allow-negative", &words.allow_negative, "terms may have negative moduli");
  list.add("model", &words.model,
           "answer with this law: kww, springpot, fractional-maxwell, fractional-kelvin-voigt or "
           "fractional-zener; its Prony series goes to --out. At large strain: neo-hooke, "
           "mooney-rivlin, yeoh, ogden-1, ogden-2, ogden-3, arruda-boyce or gent; yeoh+mullins-or "
           "adds the softening by the first loading, mullins-or alone adds it to all; hyperfoam is "
           "a foam, with the number of terms by BIC or hyperfoam-1 to hyperfoam-3")
      .such_as(all_model_names());
  list.add("diagnose", &words.diagnose,
           "compare by BIC with laws of few parameters: stretched exponential, springpot, "
           "fractional Maxwell, Kelvin-Voigt and Zener");
  list.add("fix", &words.fix,
           "hold a parameter at a value in SI, such as tau_1=0.2; parameters are E0, E_inf, and "
           "E_i, g_i, tau_i of term i (repeatable, needs --terms)");
  list.add("bound", &words.bound,
           "keep a parameter within bounds, such as g_2=0:0.1 (repeatable, needs --terms)");
  list.add("constraints", &words.constraints, "file with the text of one --fix or --bound a line")
      .read_from_file();
}

void add_noise(OptionList& list, FitWords& words) {
  list.group("Noise and intervals");
  list.add("noise", &words.noise, "white: no inflation for autocorrelation, sigma^2 = rss/(n - p)")
      .among({"auto", "white"})
      .by_default("auto");
  list.add("drift", &words.drift,
           "tables of relaxation or indentation: fit a drift linear in time; by default it is "
           "tried if the residual calls for it");
  list.add("no-drift", &words.no_drift, "never fit a drift to a table");
  list.add("full-data", &words.full_data, "fit every sample instead of averages in log time");
  list.add("profiles", &words.profiles,
           "asymmetric intervals of E_inf and times from profile likelihoods");
  list.add("spectrum", &words.spectrum,
           "the continuous spectrum H(tau) beside the series, with what the data leave open");
  list.add("bootstrap", &words.bootstrap,
           "intervals from this many resamples of blocks of residuals");
}

void add_table(OptionList& list, FitWords& words) {
  list.group("What the table is");
  list.add("column", &words.column,
           "NAME=HEADER or NAME=2: the column of a quantity; also NAME=-HEADER and "
           "NAME=1e9*HEADER");
  list.add("sheet", &words.sheet,
           "of an Excel workbook (.xlsx), or the struct of a MATLAB file (.mat); default: the one "
           "with most numbers");
  list.add("table", &words.table,
           "number of the table in a sheet or file that has several, below each other or side by "
           "side, from 1; default: the one with most numbers");
  list.add("skip", &words.skip, "lines at the begin of a text file that are not read");
  list.add("segment", &words.segment, "use only rows of this segment (repeatable)");
  list.add("time-zero", &words.time_zero, "time in the table where t = 0").of("s").by_default("0");
  list.add("from", &words.from, "fit only rows from this time on, such as \"2 s\"").of("s");
  list.add("to", &words.to, "fit only rows up to this time").of("s");
  list.add("hold", &words.hold,
           "fit only this hold of the record, from 1, with the ramp that leads to it");
  list.add("crop", &words.crop,
           "auto: fit only up to the end of the longest hold (without a depth: from the largest "
           "value to the lift of the punch)")
      .among({"auto"});
  list.add("modulus-kind", &words.modulus_kind,
           "what the moduli, compliances or stresses are of: tension, shear, plane-strain, "
           "indentation (the reduced modulus) or bulk; by default headers (E, G, shear ...) and "
           "formats decide. E follows with --poisson-ratio")
      .among(modulus_kind_words());
  list.add("reference-temperature", &words.reference_temperature,
           "of the master curve of a table with several temperatures (temperature_C), such as "
           "\"20 degC\"; default: the middle one")
      .of("degC");
  list.add(
      "start-shift", &words.start_shift,
      "TEMPERATURE=DECADES: of a master curve, log10 a_T of the isotherm at this temperature from "
      "which the fit starts, such as 40=-1.2 (repeatable; other isotherms follow their "
      "neighbours); needed where isotherms have no modulus in common");
  list.add("vertical-shift", &words.vertical_shift,
           "factors on the moduli of each isotherm of a master curve: auto (if the data clearly "
           "need them), on or off")
      .among({"auto", "on", "off"})
      .by_default("auto");
}

void add_specimen(OptionList& list, FitWords& words) {
  list.group("The specimen");
  list.add("depth", &words.depth,
           "constant depth of a table of force and time, such as \"0.1 mm\": gives stiffnesses")
      .of("m");
  list.add("gauge-length", &words.gauge_length,
           "length at rest of a specimen under load and extension, such as \"25 mm\"; by default "
           "lines above the table may state it")
      .of("m");
  list.add("area", &words.area,
           "its cross-section at rest, such as \"12 mm2\"; likewise (or width and thickness)")
      .of("m2");
  list.add("youngs-modulus", &words.youngs_modulus,
           "of a relative modulus (g_R(t), E/E0): its first value, such as \"1.5 MPa\". At large "
           "strain: the modulus at rest that the law must have, such as \"1.8 MPa +- 0.1 MPa\" "
           "(95 %); \"E_inf=1.5 MPa\" is that after all relaxation")
      .of("Pa");
  list.add("specimen", &words.specimen, "specimen.toml with the geometry under the punch")
      .read_from_file();
  list.add("punch-diameter", &words.punch_diameter, "of a flat punch, such as \"4.4 mm\"").of("m");
  list.add("layer-thickness", &words.layer_thickness,
           "of the specimen on a rigid base; without it, the specimen is a half-space")
      .of("m");
  list.add("poisson-ratio", &words.poisson_ratio, "default 0.495");
  list.add("frame-stiffness", &words.frame_stiffness,
           "between stage and punch, such as \"10 N/mm\"; needed if depth_m is the stage's "
           "position")
      .of("N/m");
  list.add("density", &words.density, "for the material file, such as \"965 kg/m3\"").of("kg/m3");
}

void add_several(OptionList& list, FitWords& words) {
  list.group("Several specimens");
  list.add("joint", &words.joint,
           "fit all files together: the law of the material in its mixing ratio, from captures, "
           "tables or material files; --out writes the joint file that viscard card reads");
  list.add("ratio", &words.ratio,
           "mixing ratio, parts of base to one of curing agent; with --joint once for each file");
  list.add("specimen-id", &words.specimen_id,
           "with --joint, once for each file: the specimen it was measured on; files with the same "
           "id are repeated touches. Default: id of the capture, column specimen of the table");
  list.add("own-terms", &words.own_terms,
           "with --joint: each mixing ratio keeps its own number of terms");
  list.add("share", &words.share,
           "with --joint: E0, g, tau or one of them (tau_1) is the same at all ratios "
           "(repeatable)")
      .such_as({"E0", "g", "tau"});
}

}  // namespace

OptionList options_of(FitWords& words) {
  OptionList list;
  add_table(list, words);
  add_specimen(list, words);
  add_model(list, words);
  add_noise(list, words);
  add_several(list, words);
  list.group("Damage");
  list.add("unverified", &words.unverified, kUnverifiedHelp);
  list.group("Units");
  list.add("plausible", &words.plausible,
           "off: accept values that no test or material can have (a wrong unit, most often); the "
           "result states it")
      .among({"on", "off"})
      .by_default("on");
  return list;
}

}  // namespace viscard
