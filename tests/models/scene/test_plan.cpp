#include "models/scene/plan.h"
#include "models/scene/simulate.h"
#include "tests/models/scene/random_scenes.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <sstream>

using namespace viscard;

namespace {

// The planner's result on one scene.
struct Verdict {
  bool answered = false;
  std::string refusal;
  double true_error = 0.0;  // largest relative error of the results
  double estimate = 0.0;    // largest relative one
  bool is_covered = true;   // every number lies within its own estimate
  std::string uncovered;    // the last that does not
  double planned_s = 0.0, fine_s = 0.0;
};

// The answer with everything on uses one fine mesh for all tolerances, finer than most plans use,
// so that its own error is a fiftieth of the tolerance or less.
struct FineMesh {
  int degree = 8;
  int layers = 5;
};
constexpr double kFineError = 0.02;

void judge(const std::string& name, double value, double reference, double size, double estimate,
           double slack, Verdict& verdict) {
  const double error = std::abs(value - reference);
  verdict.true_error = std::max(verdict.true_error, error / size);
  verdict.estimate = std::max(verdict.estimate, estimate / size);
  if (error <= estimate + slack * size) return;
  verdict.is_covered = false;
  std::ostringstream text;
  text << name << ": true " << error / size << ", estimate " << estimate / size;
  verdict.uncovered = text.str();
}

void compare(const SceneAnswer& planned, const SceneAnswer& fine, double slack, Verdict& verdict) {
  for (const SceneResult& mine : planned.results) {
    if (!mine.is_wanted) continue;
    for (const SceneResult& other : fine.results) {
      if (other.name != mine.name) continue;
      judge(mine.name, mine.value, other.value, std::max(std::abs(other.value), other.scale),
            mine.error_estimate, slack, verdict);
    }
  }
  for (std::size_t i = 0; i < planned.modes.size(); ++i) {
    const double reference_Hz = fine.modes.at(i).frequency_Hz;
    judge(planned.modes[i].family, planned.modes[i].frequency_Hz, reference_Hz, reference_Hz,
          planned.modes[i].error_estimate, slack, verdict);
  }
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

Verdict verdict_on(const PillarScene& scene, const FineMesh& mesh) {
  Verdict verdict;
  auto start = std::chrono::steady_clock::now();
  SceneAnswer planned;
  try {
    planned = simulate(scene);
    verdict.answered = true;
  } catch (const std::runtime_error& error) {  // a refusal is no wrong answer; they are counted
    verdict.refusal = error.what();
    return verdict;
  }
  verdict.planned_s = seconds_since(start);
  start = std::chrono::steady_clock::now();
  SceneAnswer fine;
  try {
    fine = test::fine_answer(scene, mesh.degree, mesh.layers);
  } catch (const std::runtime_error& error) {  // a stubby pillar does not buckle on fine meshes
    verdict.answered = false;
    verdict.refusal = std::string("on the fine mesh: ") + error.what();
    return verdict;
  }
  verdict.fine_s = seconds_since(start);
  compare(planned, fine, kFineError * scene.tolerance, verdict);
  return verdict;
}

std::string described(const PillarScene& scene, const Verdict& v) {
  std::ostringstream text;
  text << "kind " << scene.drive.index() << " tol " << scene.tolerance << " L/d "
       << scene.geometry.length_m / scene.geometry.diameter_m << " nu " << scene.pillar.nu
       << (scene.film ? " film" : "") << (scene.electrodes ? " electrode" : "") << " terms "
       << scene.pillar.terms.size() << " wanted";
  for (const std::string& name : scene.wanted) text << " " << name;
  if (scene.film) {
    text << " E_f/E " << scene.film->stiffness_Pa(2, 2) / scene.pillar.E0_Pa << " t/d "
         << scene.geometry.film->thickness_m / scene.geometry.diameter_m << " R_f/R "
         << 2.0 * scene.geometry.film->radius_m / scene.geometry.diameter_m;
  }
  text << ": true " << v.true_error << " estimate " << v.estimate << " uncovered " << v.uncovered
       << "; off:";
  for (const SceneEffect& e : plan_effects(scene).effects) {
    if (e.is_counted) text << " " << e.name << " " << e.estimate;
  }
  return text.str();
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<long>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

// Draws `count` scenes and checks the planner's error estimates.
void study(int count, unsigned long seed, const test::Ranges& ranges = {},
           const FineMesh& mesh = {}) {
  std::mt19937_64 random(seed);
  int answered = 0, below = 0, honest = 0;
  double worst = 0.0;
  std::string doubtful;
  std::vector<double> saved;
  for (int i = 0; i < count; ++i) {
    const PillarScene scene = test::random_scene(random, ranges);
    const Verdict v = verdict_on(scene, mesh);
    if (!v.answered) {
      doubtful +=
          "\n  scene " + std::to_string(i) + ", " + described(scene, v) + " refused: " + v.refusal;
      continue;
    }
    ++answered;
    const double over = v.true_error / scene.tolerance;
    const bool is_honest =
        v.is_covered && v.estimate <= std::max(20.0 * v.true_error, scene.tolerance) * (1.0 + 1e-9);
    below += over <= 1.0 ? 1 : 0;
    honest += is_honest ? 1 : 0;
    worst = std::max(worst, over);
    saved.push_back(v.fine_s / v.planned_s);
    if (over > 1.0 || !is_honest) {
      doubtful += "\n  scene " + std::to_string(i) + ", " + described(scene, v);
    }
  }
  WARN(answered << " of " << count << " scenes answered, " << below << " below their tolerance "
                << "(worst " << worst << " of it), " << honest << " honest; median time saved "
                << median(saved) << " times" << doubtful);
  // Some 3 in 100 are refused rightly: stubby pillars that do not buckle sideways.
  CHECK(answered >= std::lround(0.95 * count));
  CHECK(below >= std::lround(0.99 * answered));
  CHECK(worst <= 2.0);
  CHECK(honest >= std::lround(0.95 * answered));
}

}  // namespace

TEST_CASE("thirty random scenes are answered within their tolerance by their plans",
          "[pillar][plan]") {
  // Cheap ones: the wide ranges are in the slow cases.
  study(30, 20140611, {.least_tolerance = 3e-3, .largest_aspect = 3.0, .widest_film = 2.0},
        {.degree = 6, .layers = 4});
}

TEST_CASE("three hundred random scenes are answered within their tolerance by their plans",
          "[pillar][plan][slow]") {
  study(300, 7);
}

// VISCARD_SEED=n tries another seed, VISCARD_SCENES=n as many scenes of it.
TEST_CASE("another seed is answered within its tolerance", "[.][heldout]") {
  const char* seed = std::getenv("VISCARD_SEED");
  const char* scenes = std::getenv("VISCARD_SCENES");
  study(scenes != nullptr ? std::atoi(scenes) : 300,
        seed != nullptr ? std::strtoul(seed, nullptr, 10) : 1);
}
