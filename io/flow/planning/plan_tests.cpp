#include "io/flow/planning/plan_tests.h"

#include "io/basics/parallel.h"
#include "io/basics/units.h"
#include "io/config/config_file.h"
#include "io/config/performance_file.h"
#include "io/flow/planning/scene_quantity.h"
#include "io/materials/material_file.h"
#include "rig/run/preflight.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace viscard {
namespace {

// Without a material file: two terms, a decade apart, that share the relaxation of the specimen.
Material guess_from(const Specimen& specimen) {
  Material guess;
  guess.E0_Pa = specimen.modulus_guess_Pa;
  guess.nu = specimen.contact.poisson_ratio;
  for (const double tau_s : {0.2, 2.0}) {
    const double g = 0.5 * specimen.relaxation_guess;
    guess.terms.push_back({g, g, tau_s});
  }
  return guess;
}

// As the controller of the stage would report them.
StageDynamics dynamics_of(const RigPerformance& performance) {
  StageDynamics dynamics;
  dynamics.steps_per_m = performance.step_m > 0.0 ? 1.0 / performance.step_m : 1e9;
  dynamics.acceleration_m_s2 = performance.acceleration_m_s2;
  dynamics.max_speed_m_s = performance.max_speed_m_s;
  return dynamics;
}

}  // namespace

WantedQuantity wanted_from_text(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == 0 || equals == std::string::npos) {
    throw std::invalid_argument("--want is '" + text +
                                "'; expected a quantity and its tolerance, such "
                                "as E0=1% or g_2=5%");
  }
  WantedQuantity wanted{text.substr(0, equals), 0.0};
  try {
    wanted.tolerance = si_from_text(text.substr(equals + 1), "1");
  } catch (const std::invalid_argument&) {
    throw std::invalid_argument("--want is '" + text +
                                "'; after the equals sign expected a share, such "
                                "as 5% or 0.05");
  }
  if (!(wanted.tolerance > 0.0 && wanted.tolerance < 1.0)) {
    throw std::invalid_argument("--want " + text +
                                ": the tolerance is relative, above 0 and below 100 %, such as 1%");
  }
  return wanted;
}

TestStudy study_tests(const TestStudyRequest& request) {
  TestStudy study;
  study.bench = {read_rig(request.rig), read_performance(request.rig),
                 read_specimen(request.specimen)};
  const Bench& bench = study.bench;
  study.guess = request.guess ? read_material(*request.guess).material : guess_from(bench.specimen);
  study.guess_text =
      request.guess
          ? *request.guess
          : fmt::format("modulus_guess and relaxation_guess of {}, as terms of 0.2 and 2 s",
                        request.specimen);
  std::vector<WantedQuantity> wanted;
  for (const std::string& text : request.want) wanted.push_back(wanted_from_text(text));
  if (request.scene && std::all_of(wanted.begin(), wanted.end(), [](const WantedQuantity& one) {
        return is_of_material(one.name);
      })) {
    throw std::invalid_argument(
        *request.scene +
        " has no effect, because all that is wanted is of the material; "
        "want a result of the scene, such as --want voltage=5%, or omit it");
  }
  if (!request.scene) {
    for (const WantedQuantity& one : wanted) {
      if (is_of_material(one.name)) continue;
      throw std::invalid_argument("--want " + one.name +
                                  ": known are E0, E_inf, sum_g, and E_i, g_i, tau_i of term i; a "
                                  "result of a scene, such as voltage, needs the scene as well: "
                                  "name its file, viscard cost SCENE.toml --rig ...");
    }
  }
  if (request.scene) take_results_of_scene(*request.scene, study.guess, wanted);
  ProtocolOptions options;
  options.is_given = request.test.has_value();
  if (request.test) options.base = read_test(*request.test);
  const StageDynamics dynamics = dynamics_of(bench.performance);
  options.deepest_m =
      preflight(bench.rig, options.base, bench.specimen).deepest_safe_depth_m * (1.0 - 1e-6);
  options.longest_s = request.longest_s;
  options.guesses = guesses_about(study.guess);
  options.is_allowed = [&](const TestPlan& plan) {
    const Preflight checks = preflight(bench.rig, plan, bench.specimen, dynamics);
    return checks.problems.empty() && checks.warnings.empty();
  };
  options.for_each = for_each_in_parallel;
  study.protocols = study_protocols(bench, wanted, options);
  return study;
}

}  // namespace viscard
