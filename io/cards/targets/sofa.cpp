// SOFA with the plugin SofaViscoElastic. Source: the plugin's SLSMaxwellFirstOrder.h and
// SLSMaxwellSecondOrder.h (December 2025): S = 2 G_inf dev E + 2 G_1 (E - V_1) + 2 G_2 (dev E - V_2)
// + last tr E I, where V_i relaxes to dev E by backward Euler. The first branch takes E, not dev E,
// so it adds 2 G_1/3 to the bulk modulus for ever; the last parameter is K - 2 G_1/3, though the
// plugin's text calls it K and its source lambda. LinearElastic takes G and K. Not run here.
#include "io/basics/patterns.h"
#include "io/cards/named_values.h"
#include "io/cards/read_card.h"
#include "io/cards/targets/card_targets.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace viscard {
namespace {

constexpr const char* kSofaModels[] = {"LinearElastic", "SLSMaxwellFirstOrder",
                                       "SLSMaxwellSecondOrder"};

// What the first branch adds to the bulk modulus.
double first_branch_bulk(const CardNumbers& numbers) {
  return numbers.branches.empty() ? 0.0 : 2.0 * numbers.branches[0].shear / 3.0;
}

std::string write_sofa(const CardBody& body) {
  const CardNumbers& numbers = body.numbers;
  std::string set = fmt::format("{}", numbers.shear);
  for (const CardBranch& branch : numbers.branches) {
    set += fmt::format(" {} {}", branch.shear, branch.time);
  }
  set += fmt::format(" {}", numbers.bulk - first_branch_bulk(numbers));
  std::string out = fmt::format(
      "<TetrahedronViscoelasticityFEMForceField template=\"Vec3d\" name=\"{}\" "
      "materialName=\"{}\" ParameterSet=\"{}\"/>\n",
      body.name, kSofaModels[numbers.branches.size()], set);
  if (numbers.density > 0.0) {
    out += fmt::format("<MeshMatrixMass massDensity=\"{}\"/>\n", numbers.density);
  }
  return out;
}

std::size_t branches_of_model(const std::string& model) {
  for (std::size_t i = 0; i < std::size(kSofaModels); ++i) {
    if (model == kSofaModels[i]) return i;
  }
  throw std::runtime_error("materialName '" + model +
                           "' is none of LinearElastic, SLSMaxwellFirstOrder and "
                           "SLSMaxwellSecondOrder");
}

void read_sofa(const std::string& commented, ReadCard& card) {
  std::string text;
  for (const CardLine& line : card_lines(commented, "<!--")) text += line.text + "\n";
  const auto field = first_match(text, "<TetrahedronViscoelasticityFEMForceField\\b([^<>]*)/?>");
  if (!field) throw std::runtime_error("the card has no TetrahedronViscoelasticityFEMForceField");
  check_single_element(text, "<TetrahedronViscoelasticityFEMForceField\\b",
                       "TetrahedronViscoelasticityFEMForceField", card);
  check_single_element(text, "\\bmassDensity\\s*=", "massDensity", card);
  const std::string& attributes = field->group[1];
  const auto model = first_match(attributes, "\\bmaterialName\\s*=\\s*[\"'](\\w*)[\"']");
  if (!model) throw std::runtime_error("the force field has no materialName");
  const auto name = first_match(attributes, "\\bname\\s*=\\s*[\"'](\\w*)[\"']");
  if (name) card.name = name->group[1];
  const std::size_t count = branches_of_model(model->group[1]);
  const NamedNumbers named =
      named_lists(attributes, "\\b(ParameterSet)\\s*=\\s*(\"[^\"]*\"|'[^']*')");
  const std::vector<double>& set = list_of(named, "ParameterSet", 2 * count + 2);
  card.numbers.shear = set.front();
  for (std::size_t i = 0; i < count; ++i) {
    card.numbers.branches.push_back({set[2 * i + 1], 0.0, set[2 * i + 2]});
  }
  card.numbers.bulk = set.back() + first_branch_bulk(card.numbers);
  const NamedNumbers mass = named_lists(text, "\\b(massDensity)\\s*=\\s*(\"[^\"]*\"|'[^']*')");
  if (mass.count("massDensity") > 0) card.numbers.density = one_of(mass, "massDensity");
}

// Backward Euler of one branch under a held strain: exp(-t/tau) becomes (1 + dt/tau)^(-t/dt), off
// by at most dt/(2 e tau) of its share for small steps, at t = tau.
std::string sofa_step_note(const Material& material) {
  double share = 0.0;
  for (const MaterialTerm& term : material.terms) share += term.g;
  constexpr double kE = 2.718281828459045;
  return fmt::format(
      "The plugin integrates by backward Euler: after a jump and steps of tau_min/100, E(t) is off "
      "by up to {:.1e}, in proportion to the step. Set rayleighMass and rayleighStiffness to 0.",
      0.01 / (2.0 * kE) * share / (1.0 - share));
}

}  // namespace

CardTarget sofa_target() {
  return {.name = "sofa",
          .code = "SOFA with the plugin SofaViscoElastic",
          .extension = ".xml",
          .comment = "<!--",
          .write = write_sofa,
          .read = read_sofa,
          .elastic = ElasticForm::kBulkShear,
          .at = ModulusAt::kLongTerm,
          .branch = BranchNumber::kAbsoluteShear,
          .bulk = BulkRule::kConstantBulk,
          .max_terms = 2,
          .step_note = sofa_step_note,
          .evidence = Evidence::kSource,
          .evidence_note = "source of the plugin; not run",
          .advice =
              "Both elements belong into the node of the tetrahedra. The last parameter is K "
              "- 2 G_1/3: the first branch of the plugin adds 2 G_1/3 to the bulk modulus.",
          .cannot_represent =
              "more than two terms, relaxation of the bulk modulus, a shift with "
              "temperature; strain is Green's, so small strains only"};
}

}  // namespace viscard
