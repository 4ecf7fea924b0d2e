// Designs from specifications: against bisection with the solver, random specifications, neighbours and grids.
#include "fit/laws/fit_mixing_ratio.h"
#include "io/basics/atomic_file.h"
#include "io/flow/optimise/cheap_values.h"
#include "io/flow/optimise/optimised_output.h"
#include "io/flow/optimise/solved_values.h"
#include "io/flow/optimise/step_on_model.h"
#include "io/materials/material_file.h"
#include "io/scenes/scene_file.h"
#include "models/scene/simulate.h"
#include "models/sensor/sensor_design.h"
#include "tests/fit/laws/campaigns.h"
#include "tests/io/optimise/spec_files.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <sstream>

using namespace viscard;
using namespace viscard::test;

TEST_CASE("the longest pillar that stands is that of the formula", "[io][design]") {
  const SpecFiles files(std::string("[require]\ncollapse_margin = 2\n") + kLongest +
                        "from = \"80 um\"\nto = \"2000 um\"\n");
  const OptimisedDesign design = optimise_design(files.read(), {});
  REQUIRE(design.is_feasible);
  CHECK(design.active == std::vector<std::string>{"collapse_margin"});
  // Less 1.2 times the error of the formula (4 %, of gamma) and the rounding.
  const double expected_m = longest_m(1.8e6, 2.0) * std::exp(-1.2 * 0.04 - 2e-3);
  CHECK(design.objectives.at(0).value * 1e-6 == Approx(expected_m).epsilon(1e-3));
}

TEST_CASE("what cannot be is named with the limit that stops it", "[io][design]") {
  const double from_um = 1.1e6 * longest_m(1.8e6, 2.0);
  const SpecFiles files(std::string("[require]\ncollapse_margin = 2\n") + kLongest + "from = \"" +
                        std::to_string(from_um) + " um\"\nto = \"9000 um\"\n");
  const OptimisedDesign design = optimise_design(files.read(), {});
  CHECK_FALSE(design.is_feasible);
  CHECK(design.active ==
        std::vector<std::string>{"collapse_margin", "geometry.length at its lower end"});
}

TEST_CASE("the longest pillar that does not buckle is the one that the solver finds",
          "[io][design]") {
  const SpecFiles files(std::string("[require]\nlargest_pressure = \"20 kPa\"\n") + kLongest +
                            "from = \"100 um\"\nto = \"200 um\"\n",
                        replaced(kPillar, "1e-3", "1e-2"));
  const OptimisedDesign design = optimise_design(files.read(), {});
  REQUIRE(design.is_feasible);
  PillarScene scene = std::get<PillarScene>(scene_from_toml(design.scene_text, "scene.toml").scene);
  scene.drive = BucklingDrive{};
  const SceneResult found = simulate(scene).results.at(0);
  CHECK(found.value >= 20e3);
  CHECK(found.value <= 20e3 + 2.5 * found.error_estimate + 100.0);
}

TEST_CASE("the mixing ratio is designed by the law of a joint fit", "[io][design][slow]") {
  std::mt19937_64 dice(11);
  const Campaign campaign{.ratios = {5.0, 10.0, 15.0, 20.0, 30.0}, .specimens_per_ratio = 6};
  const RatioFit fit = fit_mixing_ratio(measured(campaign, dice));
  // The softest mixture of which a pillar four times as long as 300 um stands.
  const SpecFiles files(
      "[require]\ncollapse_margin = 4\n[[objective]]\nquantity = \"materials.pillar.ratio\"\n"
      "goal = \"largest\"\n[[range]]\nkey = \"materials.pillar.ratio\"\nfrom = \"6\"\nto = "
      "\"29\"\n",
      replaced(replaced(replaced(kPillar, "\"modal\"\nmodes = 1", "\"buckling\""),
                        R"({ E = "1.8 MPa", nu = 0.33, rho = "965 kg/m3" })",
                        R"({ file = "joint.json", ratio = 10 })"),
               "120 um", "300 um"));
  std::ofstream(files.beside("joint.json")) << json_from_ratio_fit(fit);
  const OptimisedDesign design = optimise_design(files.read(), {});
  REQUIRE(design.is_feasible);
  REQUIRE(design.active == std::vector<std::string>{"collapse_margin"});
  SensorMaterial material;
  const Material mixed = material_at_ratio(fit, design.objectives.at(0).value);
  material.young_modulus_Pa = mixed.E0_Pa;
  for (const MaterialTerm& term : mixed.terms) material.young_modulus_Pa -= term.g * mixed.E0_Pa;
  material.poisson_ratio = mixed.nu;
  CHECK(longest_upright_m(40e-6, material) / 4.0 / 300e-6 ==
        Approx(std::exp(1.2 * 0.04 + 2e-3)).epsilon(2e-3));
}

TEST_CASE("a step on a model ends where limits and objective balance", "[io][design]") {
  // Least x + y with x y >= 1/16 in logarithms of nothing: x = y = 1/4.
  const ScoreAt score = [](const DesignPoint& at) {
    return DesignScore{at[0] + at[1], {16.0 * at[0] * at[1] - 1.0}};
  };
  const DesignPoint found = step_on_model(score, {0.6, 0.5}, 0.5);
  CHECK(found[0] == Approx(0.25).margin(1e-2));
  CHECK(found[1] == Approx(0.25).margin(1e-2));
  // No point keeps x >= 2: the least lack is at the end.
  const ScoreAt never = [](const DesignPoint& at) { return DesignScore{0.0, {at[0] - 2.0}}; };
  CHECK(step_on_model(never, {0.5}, 1.0)[0] == Approx(1.0).margin(1e-3));
  CHECK(search_ranges(score, 2, 1, 7) == search_ranges(score, 2, 1, 7));
}

TEST_CASE("specifications that are wrong are refused", "[io][design]") {
  const std::string good = "[require]\ncollapse_margin = 2\n" + std::string(kLongest);
  const auto refused = [](const std::string& spec, const char* why) {
    CAPTURE(spec);
    CHECK_THROWS_WITH(optimise_design(SpecFiles(spec).read(), {}), Catch::Contains(why));
  };
  refused(good + "from = \"90 um\"\nto = \"80 um\"\n", "from < to");
  refused(good + "from = \"90 um\"\nto = \"2 mm\"\n", "same unit");
  refused(replaced(good, "\"largest\"", "\"best\"") + "from = \"80 um\"\nto = \"90 um\"\n", "goal");
  refused(
      replaced(good, "geometry.length", "geometry.lenth") + "from = \"80 um\"\nto = \"90 um\"\n",
      "geometry.length");
  refused("[require]\ncollapse_margin = 2\n", "range");
  refused("probability = 0.9\n" + good + "from = \"80 um\"\nto = \"300 um\"\n",
          "nothing is uncertain");
  refused(replaced(good, "collapse_margin = 2", "crosstalk = 0.1") +
              "from = \"80 um\"\nto = \"300 um\"\n",
          "not answered");
}

TEST_CASE("the spread of a design's quantities comes from its own solutions",
          "[io][design][gradient]") {
  // Buckling goes with E, the bandwidth with the root of E: 10 % (95 %) of E.
  const SpecFiles files(
      "probability = 0.95\n[require]\nlargest_pressure = \"10 kPa\"\nbandwidth = \"1 kHz\"\n" +
          std::string(kLongest) + "from = \"100 um\"\nto = \"140 um\"\n",
      replaced(replaced(kPillar, "\"1.8 MPa\"", "\"1.8 MPa +- 10 %\""), "1e-3", "1e-2"));
  const DesignSpec spec = files.read();
  const DesignSpace space(spec);
  const SolvedValues solved(spec, space);
  const std::vector<double> spread = solved.spread_at({0.5});
  REQUIRE(spread.size() == 2);
  CHECK(spread[0] == Approx(0.1 / 1.959964).epsilon(2e-3));  // of the tolerance of derivatives
  CHECK(spread[1] == Approx(0.05 / 1.959964).epsilon(2e-3));
  // Each quantity is solved for the solution that is reused and for the value; differences would need at
  // least four more.
  CHECK(solved.n_solved() == 4);
}

TEST_CASE("with a probability the design keeps off its limit by the uncertainty of the scene",
          "[io][design]") {
  // The longest that stands goes with E^(2/3): 10 % (95 %) of E are 3.4 % of it, 1.645 of which are kept.
  const SpecFiles files("probability = 0.95\n[require]\ncollapse_margin = 2\n" +
                            std::string(kLongest) + "from = \"80 um\"\nto = \"2000 um\"\n",
                        replaced(kPillar, "\"1.8 MPa\"", "\"1.8 MPa +- 10 %\""));
  const OptimisedDesign design = optimise_design(files.read(), {});
  REQUIRE(design.is_feasible);
  const double spread = 2.0 / 3.0 * 0.1 / 1.96;
  CHECK(std::log(design.judgement.lines.at(0).margin) ==
        Approx(1.645 * spread + 1.2 * 0.04 + 2e-3).margin(2e-3));
  CHECK(design.probabilities.at(0) >= 0.95);
}

namespace {

// What simulate() finds of a pillar on its film, by keys of [require], with errors: an answer of its own, without
// the judgement.
std::map<std::string, SceneResult> simulated(const PillarScene& designed) {
  std::map<std::string, SceneResult> found;
  const auto named = [](const SceneAnswer& answer, const std::string& name) {
    for (const SceneResult& result : answer.results) {
      if (result.name == name) return result;
    }
    FAIL("no result " << name);
    return SceneResult{};
  };
  SceneResult& volts = found["voltage_per_pressure"] =
      named(simulate(designed), "electrode_voltage");
  volts.value = std::abs(volts.value) / 10e3;  // the scene's load
  volts.error_estimate /= 10e3;
  PillarScene body = designed;
  body.electrodes.reset();
  body.drive = BucklingDrive{};
  found["largest_pressure"] = named(simulate(body), "buckling_pressure");
  body.drive = ModalDrive{.modes = 1};
  SceneResult& lowest = found["bandwidth"];
  lowest.value = std::numeric_limits<double>::infinity();
  for (const SceneMode& mode : simulate(body).modes) {
    if (mode.frequency_Hz > lowest.value) continue;
    lowest.value = mode.frequency_Hz;
    lowest.error_estimate = mode.error_estimate;
  }
  const double share = std::sqrt(0.05 / 1.05);  // an oscillator rises by 5 % there
  lowest.value *= share;
  lowest.error_estimate *= share;
  return found;
}

// Nothing on a grid over the ranges keeps all limits, those that fail are named, and without those that are named
// there is a design.
void check_infeasible(const DesignSpec& spec, const OptimisedDesign& design) {
  const DesignSpace space(spec);
  JudgeOptions quick;
  quick.search_s = 0.0;
  for (int point = 0; point < 27; ++point) {
    const int row = point / 3, layer = point / 9;
    const DesignPoint at = {0.5 * (point % 3), 0.5 * (row % 3), 0.5 * layer};
    CHECK_FALSE(
        judge_scene(space.text_at(at, 9), spec.scene_path, spec.requirements, quick).passes());
  }
  DesignSpec relieved = spec;
  for (const JudgedLine& line : design.judgement.lines) {
    const bool is_named = std::find(design.active.begin(), design.active.end(), line.kind->key) !=
                          design.active.end();
    if (line.verdict != Verdict::kPass) CHECK(is_named);
    if (is_named) relieved.requirements.*line.kind->limit = kNotRequired;
  }
  CHECK(optimise_design(relieved, {}).is_feasible);
}

}  // namespace

TEST_CASE("ten random specifications: designs confirmed by simulate, infeasible ones by a grid",
          "[io][design][slow]") {
  std::mt19937_64 dice(20);
  const auto between = [&](double low, double high) {
    return low * std::pow(high / low, std::uniform_real_distribution<>(0.0, 1.0)(dice));
  };
  const std::string at_rest = read_file(VISCARD_SOURCE_DIR "/data/scenes/pillar_sensor.toml");
  const std::string scene = replaced(
      replaced(at_rest, "../materials", VISCARD_SOURCE_DIR "/data/materials"), "1e-3", "1e-2");
  int n_feasible = 0;
  for (int i = 0; i < 10; ++i) {
    const double pressure_kPa = between(5.0, 400.0), bandwidth_kHz = between(0.5, 20.0),
                 volts_mV_kPa = between(0.5, 6.0), margin = between(1.0, 3.0);
    std::ostringstream spec;
    spec << "seed = " << i << "\n[require]\nlargest_pressure = \"" << pressure_kPa
         << " kPa\"\nbandwidth = \"" << bandwidth_kHz << " kHz\"\nvoltage_per_pressure = \""
         << volts_mV_kPa << " mV/kPa\"\ncollapse_margin = " << margin
         << "\n[[range]]\nkey = \"geometry.diameter\"\nfrom = \"20 um\"\nto = \"40 um\"\n"
            "[[range]]\nkey = \"geometry.length\"\nfrom = \"40 um\"\nto = \"300 um\"\n"
            "[[range]]\nkey = \"geometry.film.thickness\"\nfrom = \"10 um\"\nto = \"50 um\"\n"
            "[[objective]]\nquantity = \""
         << (i % 2 == 0 ? "voltage_per_pressure" : "geometry.length") << "\"\ngoal = \"largest\"\n";
    const SpecFiles files(spec.str(), scene);
    CAPTURE(i, spec.str());
    const DesignSpec read = files.read();
    const OptimisedDesign design = optimise_design(read, {});
    CHECK_FALSE(design.active.empty());
    if (!design.is_feasible) {
      check_infeasible(read, design);
      continue;
    }
    ++n_feasible;
    // The scene file itself, with a finer tolerance: simulate finds each value and margin as stated.
    const std::string out = files.beside("designed.toml");
    std::ofstream(out) << scene_for_folder(read, design, std::filesystem::path(out).parent_path());
    PillarScene scene_of_design = std::get<PillarScene>(read_scene(out).scene);
    scene_of_design.tolerance = 2e-3;
    for (const auto& answer : simulated(scene_of_design)) {
      const std::string& key = answer.first;
      const auto& result = answer.second;
      CAPTURE(key);
      const auto line = std::find_if(design.judgement.lines.begin(), design.judgement.lines.end(),
                                     [&](const JudgedLine& one) { return key == one.kind->key; });
      REQUIRE(line != design.judgement.lines.end());
      const double error = line->found.error_estimate + result.error_estimate;
      CHECK(result.value == Approx(line->found.value).margin(error).epsilon(0.0));
      CHECK(result.value - result.error_estimate >= line->limit);
      CHECK(result.value / line->limit ==
            Approx(line->margin).margin(error / line->limit).epsilon(0.0));
    }
  }
  CHECK(n_feasible >= 2);
  CHECK(n_feasible <= 8);
}
