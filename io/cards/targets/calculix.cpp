// CalculiX. It has no Prony keyword: a generalised Maxwell solid is one elastic material and one
// per branch with linear Norton creep, on coincident elements. Norton flow is deviatoric, so the
// bulk modulus, the sum of all shares, stays constant. Source: CalculiX manual, *CREEP, LAW=NORTON.
// Laws of rubber: keyword_law.h.
#include "io/cards/keyword_lines.h"
#include "io/cards/material_difference.h"
#include "io/cards/targets/card_targets.h"
#include "io/cards/targets/keyword_law.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

std::string material_lines(const std::string& name, double density, double share, double poisson) {
  std::string out = "*MATERIAL, NAME=" + name + "\n";
  if (density > 0.0) out += "*DENSITY\n" + number_of_20(density) + "\n";
  return out + "*ELASTIC\n" + number_of_20(share) + ", " + number_of_20(poisson) + "\n";
}

std::string recipe(const std::string& name, std::size_t branches) {
  std::string out =
      "** Element copies: every element of the part once per material, on the same nodes, for\n"
      "** example for C3D8 element 1 with nodes 1-8:\n";
  for (std::size_t i = 0; i <= branches; ++i) {
    const std::string material = i == 0 ? name + "_INF" : fmt::format("{}_M{}", name, i);
    out += fmt::format(
        "** *ELEMENT, TYPE=C3D8, ELSET=E_{0}\n** {1}, 1, 2, 3, 4, 5, 6, 7, 8\n"
        "** *SOLID SECTION, ELSET=E_{0}, MATERIAL={0}\n",
        material, i + 1);
  }
  return out;
}

std::string write_calculix(const CardBody& body) {
  const CardNumbers& numbers = body.numbers;
  std::string out =
      material_lines(body.name + "_INF", numbers.density, numbers.equilibrium, numbers.poisson);
  for (std::size_t i = 0; i < numbers.branches.size(); ++i) {
    const CardBranch& branch = numbers.branches[i];
    // The first material carries the mass; ccx wants a density in all materials or in none.
    out += material_lines(fmt::format("{}_M{}", body.name, i + 1),
                          numbers.density > 0.0 ? 1e-30 : 0.0, branch.shear, numbers.poisson);
    out += "*CREEP, LAW=NORTON\n" + number_of_20(branch.time) + ", 1., 0.\n";
  }
  return out + recipe(body.name, numbers.branches.size());
}

// One of the overlaid materials.
struct Part {
  double young = 0.0, creep = 0.0;
  bool creeps = false;
};

void read_share(const KeywordBlock& block, bool is_first, Part& part, ReadCard& card) {
  CardNumbers share;
  read_elastic(block, card, share);
  part.young = share.young;
  if (!is_first && share.poisson != card.numbers.poisson) {
    card.add("poisson-differs", "line " + std::to_string(block.line.number + 1) +
                                    ": all overlaid materials need the same Poisson ratio");
  }
  card.numbers.poisson = share.poisson;
}

void read_creep(const KeywordBlock& block, Part& part, ReadCard& card) {
  const CardLine& line = block.first_data();
  const auto row = cells(line.text, ',');
  check_width(line, 3, card);
  if (!block.has("LAW=NORTON") && !block.parameters.empty()) {
    card.add("creep-law", at_line(block.line, "only *CREEP, LAW=NORTON can be a Maxwell branch"));
  }
  part.creeps = true;
  part.creep = cell_number(row, 0, line, "A");
  if (cell_number(row, 1, line, "n") != 1.0 || cell_number_or_zero(row, 2, line, "m") != 0.0) {
    card.add("creep-not-linear", at_line(line, "a Maxwell branch needs n = 1 and m = 0"));
  }
}

void read_calculix(const std::string& text, ReadCard& card) {
  std::vector<Part> parts;
  const std::vector<KeywordBlock> blocks = keyword_blocks(card_lines(text, "**"), '*');
  for (const CardFinding& finding : material_findings(blocks, true))
    card.findings.push_back(finding);
  for (const KeywordBlock& block : blocks) {
    if (block.keyword == "*MATERIAL") {
      parts.emplace_back();
      if (card.name.empty()) card.name = block.name();
    } else if (parts.empty()) {
      continue;  // mesh and sections before the materials
    } else if (block.keyword == "*DENSITY") {
      const double density = density_in(block);
      if (density < 0.0) card.add("negative-density", at_line(block.first_data(), "is negative"));
      card.numbers.density += density;
    } else if (block.keyword == "*ELASTIC") {
      read_share(block, parts.size() == 1, parts.back(), card);
    } else if (block.keyword == "*CREEP") {
      read_creep(block, parts.back(), card);
    }
    if (block.keyword == "*VISCOELASTIC" || block.has("MODULI=INSTANTANEOUS")) {
      card.add("calculix-ignores-prony",
               at_line(block.line,
                       "CalculiX drops this line with a warning and stays elastic; use an overlay "
                       "of Norton-creep materials"));
    }
    check_static_step(block, "*VISCO", card);
  }
  require_in_card(!parts.empty(), "*MATERIAL");
  for (const Part& part : parts) {
    if (part.creeps) card.numbers.branches.push_back({part.young, 0.0, part.creep});
    if (!part.creeps) card.numbers.equilibrium += part.young;
  }
  // A card by viscard names its first material NAME_INF.
  if (card.name.size() > 4 && card.name.ends_with("_INF")) card.name.resize(card.name.size() - 4);
}

// One element per material of the card on the same eight nodes, and one *VISCO step of fixed
// increments per block. Prints the reaction of the base (relaxation) or the displacement of the top
// (creep) after every increment.
std::vector<DeckFile> calculix_deck(const DeckInput& input, const std::string& name) {
  std::string elements, sections;
  int id = 0;
  for (const KeywordBlock& block : keyword_blocks(card_lines(input.card.text, "**"), '*')) {
    if (block.keyword != "*MATERIAL") continue;
    const std::string material = block.name();
    elements += fmt::format("*ELEMENT, TYPE=C3D8, ELSET=E_{}\n{}, 1, 2, 3, 4, 5, 6, 7, 8\n",
                            material, ++id);
    sections += fmt::format("*SOLID SECTION, ELSET=E_{0}, MATERIAL={0}\n", material);
  }
  std::string out =
      keyword_cube() + elements + input.card.text + sections + keyword_rollers_and_ramp(input);
  for (const DeckBlock& block : input.blocks()) {
    // CalculiX requires CETOL even with fixed increments, and would stop an increment with more
    // creep strain than that (checkconvergence.c).
    out += fmt::format("*STEP, INC=1000000\n*VISCO, DIRECT, CETOL=1.E30\n{}, {}\n",
                       number_of_20(block.step), number_of_20(block.length));
    out += keyword_pull(input);
    out += input.is_creep() ? "*NODE PRINT, NSET=TOP\nU\n"
                            : "*NODE PRINT, NSET=BASE, TOTALS=ONLY\nRF\n";
    out += "*END STEP\n";
  }
  return {{name + ".inp", out}};
}

// Backward Euler decays a branch by (1 + x)^-n instead of exp(-n x), x = dt/tau: at t its stress is
// off by g x/2 (t/tau) exp(-t/tau), to first order. Relative to E(t), which falls to 1 - sum g.
std::string calculix_step_note(const Material& material) {
  constexpr double kSteps = 40.0;
  double shortest_s = material.terms.front().tau_s;
  for (const MaterialTerm& term : material.terms) shortest_s = std::min(shortest_s, term.tau_s);
  double worst = 0.0;
  for (const double time_s : comparison_times_s(material)) {
    double off = 0.0, modulus = 1.0;
    for (const MaterialTerm& term : material.terms) {
      const double age = time_s / term.tau_s;
      off += term.g * 0.5 * shortest_s / (kSteps * term.tau_s) * age * std::exp(-age);
      modulus += term.g * std::expm1(-age);
    }
    worst = std::max(worst, off / modulus);
  }
  return fmt::format(
      "First order in the time step: with increments of {:g} s (the shortest tau/{:g}) E(t) after "
      "a jump is off by up to {:.1e}; half the increment, half the error.",
      shortest_s / kSteps, kSteps, worst);
}

}  // namespace

CardTarget calculix_target() {
  return {.name = "calculix",
          .code = "CalculiX overlay",
          .extension = ".inp",
          .comment = "**",
          .write = write_calculix,
          .read = read_calculix,
          // First order in time. ccx solves the creep increment of a point to absolute bounds: von
          // Mises stresses below 1e-10 units are raised to that (incplas_lin.f), so a branch that
          // has relaxed in a hold diverges at longer increments. The load of this linear test
          // starts at a strain of 1 and rises in every block, so all branches stay loaded.
          .deck =
              DeckWriter{
                  calculix_deck, "ccx {}", {.amplitude = 1.0, .steps_per_tau = 40, .rises = true}},
          .laws = LawColumn{
              .write = [](const CardBody& body) { return write_keyword_law(body, true); },
              .read = [](const std::string& text,
                         ReadCard& card) { read_keyword_law(text, true, card); },
              .keywords = keyword_laws(),
              .volume = keyword_law_volume("D_1") + "; D_1 = 2/K",
              .terms = "ccx has no Prony series beside *HYPERELASTIC and ignores one",
              .damage = {"",
                         "ccx skips *MULLINS EFFECT with a warning and runs the law without "
                         "it"},
              .evidence = "run by viscard's tests in CalculiX 2.20, laws without terms"},
          .elastic = ElasticForm::kPoissonOnly,
          .branch = BranchNumber::kAbsoluteYoung,
          .time = TimeNumber::kNortonA,
          .bulk = BulkRule::kConstantBulk,
          .states_equilibrium = true,
          .is_case_sensitive = false,
          .reads_fortran_numbers = true,
          .step_note = calculix_step_note,
          .evidence = Evidence::kRun,
          .evidence_note = "run by viscard's tests with Debian's ccx",
          .advice =
              "CalculiX has no Prony keyword: one element copy per material, all on the same "
              "nodes, and *VISCO steps; it integrates to first order in the time step.",
          .harmonic = "refused: *STEADY STATE DYNAMICS leaves creep out"};
}

}  // namespace viscard
