#include "io/cards/conventions.h"

#include <stdexcept>

namespace viscard {
namespace {

using enum ElasticForm;
using enum ModulusAt;
using enum BranchNumber;
using enum TimeNumber;
using enum BulkRule;
using enum Evidence;

CardTarget abaqus() {
  return {.name = "abaqus",
          .code = "Abaqus",
          .extension = ".inp",
          .comment = "**",
          .takes_incompressible = true,
          .takes_wlf = true,
          .evidence = kParsed,
          .evidence_note = "public keyword manual; an independent reader found the numbers",
          .advice =
              "Use *VISCO or dynamic steps: *STATIC does not relax. Above nu = .475 use hybrid "
              "elements (C3D8H, C3D10H)."};
}

CardTarget ansys() {
  return {.name = "ansys",
          .code = "ANSYS MAPDL",
          .extension = ".mac",
          .comment = "!",
          .max_terms = 100,
          .takes_wlf = true,
          .evidence = kParsed,
          .evidence_note = "public command manual; an independent reader found the numbers",
          .advice =
              "EX is always instantaneous. Near nu = .5 use SOLID185/186/187 with KEYOPT(6) = 1."};
}

// Keyword manual R13 vol. II; OpenRadioss and PyDYNA readers agree on the fields.
CardTarget lsdyna() {
  return {.name = "lsdyna",
          .code = "LS-DYNA *MAT_GENERAL_VISCOELASTIC (076)",
          .extension = ".k",
          .comment = "$",
          .elastic = kBulkOnly,
          .at = kLongTerm,
          .branch = kAbsoluteShear,
          .time = kBeta,
          .bulk = kConstantBulk,
          .states_equilibrium = true,
          .max_terms = 17,
          .evidence = kParsed,
          .evidence_note =
              "independent readers found the numbers; "
              "18 rows in newer versions (6 in old ones), one of them the equilibrium row beta = 0",
          .advice =
              "Numbers are rounded to ten columns. The empty line after the first card is card 2."};
}

CardTarget lsdyna006() {
  CardTarget target = lsdyna();
  target.name = "lsdyna006";
  target.code = "LS-DYNA *MAT_VISCOELASTIC (006)";
  target.max_terms = 1;
  target.evidence_note = "independent readers found the numbers";
  target.advice = "GI is the long-term shear modulus here. Numbers are rounded to ten columns.";
  return target;
}

CardTarget febio() {
  return {.name = "febio",
          .code = "FEBio viscoelastic",
          .extension = ".feb",
          .comment = "<!--",
          .bulk = kConstantPoisson,
          .states_equilibrium = true,
          .max_terms = 6,
          .evidence = kRun,
          .evidence_note = "FEBio 4 on one element, ramp and hold: 1.5e-9",
          .advice = "Paste the element into <Material>; g0 must stay, FEBio's default is 1."};
}

CardTarget febio_uncoupled() {
  return {.name = "febio-uncoupled",
          .code = "FEBio uncoupled viscoelastic",
          .extension = ".feb",
          .comment = "<!--",
          .elastic = kBulkShear,
          .bulk = kConstantBulk,
          .states_equilibrium = true,
          .max_terms = 6,
          .evidence = kRun,
          .evidence_note = "FEBio 4 on one element, ramp and hold: 2.2e-9",
          .advice = "Paste the element into <Material>; g0 must stay, FEBio's default is 1."};
}

CardTarget mfront() {
  return {.name = "mfront",
          .code = "MFront behaviour",
          .extension = ".mfront",
          .comment = "//",
          .evidence = kRun,
          .evidence_note = "MTest, ramp and hold: 2e-15",
          .advice = "mfront --obuild --interface=generic (or aster, abaqus, calculix, ansys ...)."};
}

CardTarget calculix() {
  return {.name = "calculix",
          .code = "CalculiX overlay",
          .extension = ".inp",
          .comment = "**",
          .elastic = kPoissonOnly,
          .branch = kAbsoluteYoung,
          .time = kNortonA,
          .bulk = kConstantBulk,
          .states_equilibrium = true,
          .evidence = kRun,
          .evidence_note = "run by viscard's tests with Debian's ccx",
          .advice =
              "CalculiX has no Prony keyword: one element copy per material, all on the same "
              "nodes, and *VISCO steps; it integrates to first order in the time step."};
}

CardTarget openradioss() {
  return {.name = "openradioss",
          .code = "OpenRadioss /MAT/LAW40",
          .extension = ".rad",
          .comment = "#",
          .elastic = kBulkOnly,
          .at = kLongTerm,
          .branch = kAbsoluteShear,
          .time = kBeta,
          .bulk = kConstantBulk,
          .states_equilibrium = true,
          .max_terms = 5,
          .evidence = kSource,
          .evidence_note = "format definition of the open source code; not run",
          .advice = "The card declares its units in /UNIT; solid elements only."};
}

CardTarget comsol() {
  return {.name = "comsol",
          .code = "COMSOL linear elastic with Viscoelasticity",
          .extension = ".txt",
          .comment = "%",
          .at = kLongTerm,
          .branch = kAbsoluteShear,
          .bulk = kConstantBulk,
          .takes_wlf = true,
          .evidence = kDocumentation,
          .evidence_note = "public documentation and published model files; not run",
          .advice =
              "Parameters > Load from File; E and nu are long-term, Gvm = G_i, tauvm = tau_i. "
              "Near nu = .5 use the pressure formulation."};
}

CardTarget moose() {
  return {
      .name = "moose",
      .code = "MOOSE GeneralizedMaxwellModel",
      .extension = ".i",
      .comment = "#",
      .branch = kAbsoluteYoung,
      .bulk = kConstantPoisson,
      .evidence = kSource,
      .evidence_note = "source of the class; not run",
      .advice = "creep_viscosity is the relaxation time. Keep the UserObject, or nothing relaxes."};
}

CardTarget frontistr() {
  return {.name = "frontistr",
          .code = "FrontISTR",
          .extension = ".cnt",
          .comment = "#",
          .bulk = kConstantBulk,
          .takes_wlf = true,
          .evidence = kRun,
          .evidence_note = "FrontISTR on one element, ramp and hold: 3e-8",
          .advice = "Needs !SOLUTION, TYPE=NLSTATIC and !STEP, TYPE=VISCO."};
}

CardTarget json() {
  return {.name = "json",
          .code = "neutral JSON",
          .extension = ".json",
          .comment = "",
          .takes_incompressible = true,
          .takes_wlf = true,
          .evidence = kOurs,
          .evidence_note = "read back by viscard; units stand beside the numbers",
          .advice = ""};
}

CardTarget csv() {
  return {.name = "csv",
          .code = "table of E(t), J(t), E'(f), E''(f)",
          .extension = ".csv",
          .comment = "#",
          .takes_incompressible = true,
          .evidence = kOurs,
          .evidence_note = "read back by viscard; units stand in the column names",
          .advice = ""};
}

}  // namespace

const std::vector<CardTarget>& card_targets() {
  static const std::vector<CardTarget> table{
      abaqus(),          ansys(),     lsdyna(),   lsdyna006(),   febio(),
      febio_uncoupled(), mfront(),    calculix(), openradioss(), comsol(),
      moose(),           frontistr(), json(),     csv()};
  return table;
}

const CardTarget* find_card_target(const std::string& name) {
  for (const CardTarget& target : card_targets()) {
    if (name == target.name) return &target;
  }
  return nullptr;
}

const CardTarget& card_target(const std::string& name) {
  if (const CardTarget* found = find_card_target(name)) return *found;
  std::string names;
  for (const CardTarget& target : card_targets()) {
    names += names.empty() ? target.name : ", " + target.name;
  }
  throw std::invalid_argument("there is no card target '" + name + "'; there are " + names);
}

CardTarget mfront_gallery_target() {
  CardTarget target = card_target("mfront");
  target.elastic = ElasticForm::kBulkShear;
  target.at = ModulusAt::kLongTerm;
  target.branch = BranchNumber::kAbsoluteShear;
  return target;
}

std::string conventions_in_words(const CardTarget& target) {
  return to_word(target.at) + " " + to_word(target.elastic) + "; branches " +
         to_word(target.branch) + "; time " + to_word(target.time) + "; bulk " +
         to_word(target.bulk);
}

std::string to_word(ElasticForm form) {
  switch (form) {
    case kYoungPoisson:
      return "E, nu";
    case kBulkShear:
      return "K, G";
    case kBulkOnly:
      return "K, with G the sum of the branches";
    case kPoissonOnly:
      return "nu, with E the sum of the shares";
  }
  return "";
}

std::string to_word(ModulusAt at) {
  return at == kInstantaneous ? "instantaneous" : "long-term";
}

std::string to_word(BranchNumber branch) {
  switch (branch) {
    case kRelative:
      return "relative (g_i = G_i/G_0)";
    case kAbsoluteShear:
      return "absolute (G_i)";
    case kAbsoluteYoung:
      return "absolute (E_i = g_i E_0)";
  }
  return "";
}

std::string to_word(TimeNumber time) {
  switch (time) {
    case kTau:
      return "tau";
    case kBeta:
      return "beta = 1/tau";
    case kNortonA:
      return "Norton A = 1/(3 G_i tau)";
  }
  return "";
}

std::string to_word(BulkRule bulk) {
  switch (bulk) {
    case kOwnNumbers:
      return "relaxes with its own k_i";
    case kConstantBulk:
      return "does not relax (constant K)";
    case kConstantPoisson:
      return "relaxes with the shear (constant nu)";
  }
  return "";
}

std::string to_word(Evidence evidence) {
  switch (evidence) {
    case kRun:
      return "run";
    case kParsed:
      return "parsed";
    case kSource:
      return "source";
    case kDocumentation:
      return "documentation";
    case kOurs:
      return "ours";
  }
  return "";
}

}  // namespace viscard
