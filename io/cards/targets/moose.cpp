// MOOSE GeneralizedMaxwellModel. Sources: GeneralizedMaxwellModel.C; the solid mechanics module's
// test gen_maxwell_relax.i for the one-element model, which MOOSE has not run here. Of laws of rubber
// ComputeNeoHookeanStress alone: lambda = K - 2 mu/3 and mu = 2 C10 of the second Piola-Kirchhoff stress
// (lambda ln J - mu) C^-1 + mu I, whose energy is mu/2 (I1 - 3) - mu ln J + lambda/2 (ln J)^2
// (ComputeNeoHookeanStress.C of idaholab/moose; not run).
#include "io/basics/patterns.h"
#include "io/cards/deck.h"
#include "io/cards/keyword_lines.h"
#include "io/cards/law_numbers.h"
#include "io/cards/moose_blocks.h"
#include "io/cards/named_values.h"
#include "io/cards/read_card.h"
#include "io/cards/targets/card_targets.h"

#include <fmt/format.h>

#include <set>
#include <string>

namespace viscard {
namespace {

std::string density_block(double density) {
  if (!(density > 0.0)) return "";
  return fmt::format(
      "  [density]\n    type = GenericConstantMaterial\n    prop_names = 'density'\n"
      "    prop_values = '{}'\n  []\n",
      density);
}

double density_of(const std::string& text, const NamedNumbers& named) {
  const bool has_density = first_match(text, "prop_names\\s*=\\s*['\"]?density").has_value();
  return has_density ? one_of(named, "prop_values") : 0.0;
}

// young_modulus is instantaneous and each branch is subtracted from it; creep_viscosity is the
// relaxation time; branches take poisson_ratio.
std::string write_moose(const CardBody& body) {
  const CardNumbers& numbers = body.numbers;
  std::string out;
  if (numbers.branches.empty()) {
    out = fmt::format(
        "[Materials]\n  [{}]\n    type = ComputeIsotropicElasticityTensor\n"
        "    youngs_modulus = {}\n    poissons_ratio = {}\n  []\n"
        "  [stress]\n    type = ComputeLinearElasticStress\n  []\n"
        "  [strain]\n    type = ComputeSmallStrain\n",
        body.name, numbers.young, numbers.poisson);
  } else {
    // The default rule, backward Euler, is first order; this one takes stress linear in the step.
    out = fmt::format(
        "[Materials]\n  [{}]\n    type = GeneralizedMaxwellModel\n"
        "    young_modulus = {}\n    poisson_ratio = {}\n    integration_rule = zienkiewicz\n"
        "    creep_modulus = '{}'\n    creep_viscosity = '{}'\n  []\n"
        "  [creep]\n    type = LinearViscoelasticStressUpdate\n  []\n"
        "  [stress]\n    type = ComputeMultipleInelasticStress\n    inelastic_models = 'creep'\n"
        "  []\n  [strain]\n    type = ComputeIncrementalSmallStrain\n",
        body.name, numbers.young, numbers.poisson,
        joined(numbers.branches, &CardBranch::shear, " "),
        joined(numbers.branches, &CardBranch::time, " "));
  }
  out += "    displacements = 'disp_x disp_y disp_z'\n  []\n" + density_block(numbers.density) +
         "[]\n";
  if (numbers.branches.empty()) return out;
  return out +
         "[UserObjects]\n  [update]\n    type = LinearViscoelasticityManager\n"
         "    viscoelastic_model = " +
         body.name + "\n  []\n[]\n";
}

void check_integration(const std::string& text, ReadCard& card);
void check_repeats(const std::string& text, ReadCard& card);

void read_moose(const std::string& commented, ReadCard& card) {
  const std::string text = without_line_comments(commented, "#");
  card.findings = moose_block_findings(text);
  const NamedNumbers named = named_lists(
      text,
      "(young_modulus|youngs_modulus|poisson_ratio|poissons_ratio|creep_modulus|"
      "creep_viscosity|creep_ratio|prop_values)\\s*=\\s*('[^']*'|\"[^\"]*\"|[^\\s\\[]+)");
  const auto name = first_match(text, "\\[(?:\\./)?(\\w+)\\]\\s*type\\s*=\\s*(Gen|ComputeIso)");
  if (name) card.name = name->group[1];
  check_repeats(text, card);
  const bool is_elastic = named.count("young_modulus") == 0;
  card.numbers.young = one_of(named, is_elastic ? "youngs_modulus" : "young_modulus");
  card.numbers.poisson = one_of(named, is_elastic ? "poissons_ratio" : "poisson_ratio");
  card.numbers.density = density_of(text, named);
  const std::size_t count =
      named.count("creep_viscosity") > 0 ? named.at("creep_viscosity").size() : 0;
  const auto& modulus = list_of(named, "creep_modulus", count);
  for (std::size_t i = 0; i < count; ++i) {
    card.numbers.branches.push_back({modulus[i], 0.0, named.at("creep_viscosity")[i]});
  }
  if (named.count("creep_ratio") > 0) {
    card.add("creep-ratio", "creep_ratio is set; the branches are read with poisson_ratio", false);
  }
  if (!is_elastic) check_integration(text, card);
  if (!is_elastic &&
      !first_match(text, "LinearViscoelasticityManager\\s[^\\[]*viscoelastic_model\\s*=\\s*" +
                             (card.name.empty() ? "\\w+" : card.name) + "\\b")) {
    card.add("missing-user-object",
             "there is no LinearViscoelasticityManager with this viscoelastic_model: the "
             "coefficients of time stepping stay frozen");
  }
}

// MOOSE merges blocks of one name and then refuses the parameters that stand there twice.
void check_repeats(const std::string& text, ReadCard& card) {
  std::set<std::string> names;
  for (const Match& match :
       all_matches(text, "\\[(?:\\./)?(\\w+)\\]\\s*type\\s*=\\s*(Gen\\w*Maxwell|ComputeIso)")) {
    if (names.insert(match.group[1]).second) continue;
    card.add("doubled-block", at_line(line_of(text, match.at[0]),
                                      "the block [" + match.group[1] +
                                          "] stands in the card twice; delete one of them"));
    return;
  }
}

void check_integration(const std::string& text, ReadCard& card) {
  const auto rule = first_match(text, "integration_rule\\s*=\\s*['\"]?([\\w-]+)");
  if (!rule || upper(rule->group[1]) != "ZIENKIEWICZ") {
    card.add("integration-rule",
             "integration_rule is not zienkiewicz: the others are of first order in the step (the "
             "default is backward-euler)",
             false);
  }
  if (!first_match(text, "GeneralizedMaxwellModel\\b") ||
      !first_match(text, "LinearViscoelasticStressUpdate\\b") ||
      !first_match(text, "ComputeMultipleInelasticStress\\b") ||
      !first_match(text, "Compute(Incremental\\w*|FiniteStrain)\\b") ||
      !first_match(text, "inelastic_models\\s*=\\s*['\"]?\\w")) {
    card.add("missing-block",
             "one of GeneralizedMaxwellModel, LinearViscoelasticStressUpdate, "
             "ComputeMultipleInelasticStress with inelastic_models, and an incremental strain is "
             "missing: the branches do not act on the stress");
  }
}

std::string write_moose_law(const CardBody& body) {
  const double mu = 2.0 * body.numbers.moduli[0];
  return fmt::format(
             "[Materials]\n  [{}]\n    type = ComputeNeoHookeanStress\n    lambda = {}\n    mu = "
             "{}\n    large_kinematics = true\n  []\n"
             "  [strain]\n    type = ComputeLagrangianStrain\n"
             "    displacements = 'disp_x disp_y disp_z'\n    large_kinematics = true\n  []\n",
             body.name, body.numbers.bulk - 2.0 * mu / 3.0, mu) +
         density_block(body.numbers.density) + "[]\n";
}

void read_moose_law(const std::string& commented, ReadCard& card) {
  const std::string text = without_line_comments(commented, "#");
  require_in_card(first_match(text, "type\\s*=\\s*ComputeNeoHookeanStress").has_value(),
                  "ComputeNeoHookeanStress");
  card.findings = moose_block_findings(text);
  const NamedNumbers named =
      named_lists(text, "\\b(lambda|mu|prop_values)\\s*=\\s*('[^'\\n]*'|\"[^\"\\n]*\"|[^\\s\\[]+)");
  const double mu = one_of(named, "mu");
  take_invariant_law({mu / 2.0}, card.numbers);
  card.numbers.bulk = one_of(named, "lambda") + 2.0 * mu / 3.0;
  card.numbers.density = density_of(text, named);
  if (all_matches(text, "large_kinematics\\s*=\\s*true").size() < 2)
    card.add("small-kinematics",
             "ComputeNeoHookeanStress or ComputeLagrangianStrain lacks large_kinematics = true: "
             "MOOSE computes with small strain");
}

std::string block(const std::string& name, const std::string& lines) {
  return "  [" + name + "]\n" + lines + "  []\n";
}

std::string for_each_axis(std::string (*entry)(char axis)) {
  return entry('x') + entry('y') + entry('z');
}

std::string mesh_and_kernels() {
  std::string out =
      "[Mesh]\n  type = GeneratedMesh\n  dim = 3\n  nx = 1\n  ny = 1\n  nz = 1\n"
      "  elem_type = HEX8\n[]\n[GlobalParams]\n  displacements = 'disp_x disp_y disp_z'\n[]\n"
      "[Variables]\n";
  out += for_each_axis([](char axis) { return fmt::format("  [disp_{}]\n  []\n", axis); });
  out += "[]\n[Kernels]\n";
  out += for_each_axis([](char axis) {
    return block(fmt::format("balance_{}", axis),
                 fmt::format("    type = StressDivergenceTensors\n    variable = disp_{}\n"
                             "    component = {}\n",
                             axis, axis - 'x'));
  });
  return out +
         "[]\n[AuxVariables]\n  [stress_zz]\n    order = CONSTANT\n    family = MONOMIAL\n  "
         "[]\n[]\n"
         "[AuxKernels]\n" +
         block("stress_zz",
               "    type = RankTwoAux\n    variable = stress_zz\n    rank_two_tensor = stress\n"
               "    index_i = 2\n    index_j = 2\n    execute_on = timestep_end\n") +
         "[]\n";
}

std::string moose_boundaries(const DeckInput& input) {
  // GeneratedMesh names the faces x = 0 left, y = 0 bottom, z = 0 back, z = 1 front.
  std::string out =
      "[BCs]\n" + for_each_axis([](char axis) {
        return block(
            fmt::format("roller_{}", axis),
            fmt::format("    type = DirichletBC\n    variable = disp_{}\n    boundary = {}\n"
                        "    value = 0\n",
                        axis,
                        axis == 'x'   ? "left"
                        : axis == 'y' ? "bottom"
                                      : "back"));
      });
  return out +
         block("pull", fmt::format("    type = Function{}BC\n    variable = disp_z\n"
                                   "    boundary = front\n    function = ramp\n",
                                   input.is_creep() ? "Neumann" : "Dirichlet")) +
         "[]\n";
}

std::vector<DeckFile> moose_deck(const DeckInput& input, const std::string& name) {
  std::string out =
      mesh_and_kernels() + "[Functions]\n" +
      block("ramp", fmt::format("    type = PiecewiseLinear\n    x = '0 {0} {1}'\n"
                                "    y = '0 {2} {2}'\n",
                                input.ramp(), 2.0 * input.end(),
                                input.is_creep() ? input.stress() : input.test.amplitude)) +
      "[]\n" + moose_boundaries(input) + input.card.text + "[Postprocessors]\n";
  out += block("stress", "    type = ElementAverageValue\n    variable = stress_zz\n");
  out +=
      block("strain", "    type = SideAverageValue\n    variable = disp_z\n    boundary = front\n");
  out += fmt::format(
      "[]\n[Executioner]\n  type = Transient\n  solve_type = NEWTON\n"
      "  petsc_options_iname = '-pc_type'\n  petsc_options_value = 'lu'\n"
      "  nl_rel_tol = 1e-12\n  nl_abs_tol = 1e-30\n  end_time = {}\n"
      "  [TimeStepper]\n    type = ConstantDT\n    dt = {}\n  []\n[]\n"
      "[Outputs]\n  csv = true\n[]\n",
      input.end(), input.blocks().front().step);
  return {{name + ".i", out}};
}

}  // namespace

CardTarget moose_target() {
  return {
      .name = "moose",
      .code = "MOOSE GeneralizedMaxwellModel",
      .extension = ".i",
      .comment = "#",
      .write = write_moose,
      .read = read_moose,
      // One step size: the class updates its branches with the size of the step before, so the
      // zienkiewicz rule is exact only where the size stays (GeneralizedMaxwellBase.C).
      .deck = DeckWriter{moose_deck,
                         "solid_mechanics-opt -i {}.i",
                         {.amplitude = 1e-6, .steps_per_tau = 8, .most_equal_increments = 20000}},
      .laws = LawColumn{.write = write_moose_law,
                        .read = read_moose_law,
                        .keywords = {"mu = 2 C10, lambda = K - 2 mu/3 of W = mu/2 (I1 - 3) - mu ln "
                                     "J + ...",
                                     "", "", "", "", ""},
                        .volume = "lambda/2 (ln J)^2",
                        .terms = "ComputeNeoHookeanStress has no memory"},
      .branch = BranchNumber::kAbsoluteYoung,
      .bulk = BulkRule::kConstantPoisson,
      .evidence = Evidence::kSource,
      .evidence_note = "source of the class; not run",
      .advice =
          "creep_viscosity is the relaxation time. Keep the UserObject, or nothing relaxes. "
          "zienkiewicz is exact for steps of one size; where the size changes, MOOSE uses the old "
          "one once."};
}

}  // namespace viscard
