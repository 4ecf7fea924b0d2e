// Random arrays in the plane: answers within the tolerance, and estimates that cover the true error.
#include "models/array/space/simulate_space.h"
#include "models/scene/plan.h"
#include "models/scene/simulate.h"
#include "tests/models/scene/random_arrays.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>

using namespace viscard;
using namespace viscard::test;

namespace {

const SceneMap& map_of(const SceneAnswer& answer, const std::string& name) {
  const auto found = std::find_if(answer.maps.begin(), answer.maps.end(),
                                  [&](const SceneMap& map) { return map.name == name; });
  if (found == answer.maps.end()) throw std::runtime_error("no map " + name);
  return *found;
}

struct Judged {
  double over = 0.0;  // largest error over the tolerance
  bool is_honest = true;
};

Judged judged(const SpaceScene& scene) {
  const SceneAnswer planned = simulate(scene);
  const auto all = std::get<SpaceScene>(plan_effects(with_all_effects_on(scene)).reduced);
  const SceneAnswer fine = space_answer_on(all, space_meshes(all).back());
  Judged verdict;
  for (const SceneMap& map : planned.maps) {
    const SceneMap& exact = map_of(fine, map.name);
    for (std::size_t i = 0; i < map.value.size(); ++i) {
      const double error = std::abs(map.value[i] - exact.value[i]);
      verdict.over = std::max(verdict.over, error / (scene.tolerance * size_of(exact)));
      verdict.is_honest =
          verdict.is_honest && error <= map.error[i] + 0.02 * scene.tolerance * size_of(exact);
    }
  }
  return verdict;
}

void study_arrays(int count, unsigned long seed) {
  std::mt19937_64 random(seed);
  int answered = 0, below = 0, honest = 0;
  std::ostringstream worst;
  for (int i = 0; i < count; ++i) {
    const SpaceScene scene = random_array(random);
    try {
      const Judged verdict = judged(scene);
      ++answered;
      below += verdict.over <= 1.0 ? 1 : 0;
      honest += verdict.is_honest ? 1 : 0;
      if (verdict.over > 1.0 || !verdict.is_honest) {
        worst << "array " << i << ": error " << verdict.over << " of the tolerance, honest "
              << verdict.is_honest << "\n";
      }
    } catch (const std::exception& error) {
      worst << "array " << i << " (tolerance " << scene.tolerance << "): " << error.what() << "\n";
    }
  }
  CAPTURE(count, answered, below, honest, worst.str());
  if (std::getenv("VISCARD_SHOW") != nullptr) WARN(worst.str());
  CHECK(answered >= 0.9 * count);
  CHECK(below >= 0.99 * answered);
  CHECK(honest >= 0.99 * answered);
}

// The answer within the tolerance against one within a tenth of it.
Judged judged_pressed(SpaceScene scene) {
  const double tolerance = scene.tolerance;
  const SceneAnswer answer = simulate(scene);
  scene.tolerance = std::max(0.1 * tolerance, SpaceScene::kTolerances.least);
  const SceneAnswer fine = simulate(scene);
  Judged verdict;
  for (const SceneMap& map : answer.maps) {
    const SceneMap& exact = map_of(fine, map.name);
    for (std::size_t i = 0; i < map.value.size() && size_of(exact) > 0.0; ++i) {
      const double error = std::abs(map.value[i] - exact.value[i]);
      if (map.is_watched) {
        verdict.over = std::max(verdict.over, error / (tolerance * size_of(exact)));
      }
      const double room = 0.02 * tolerance * size_of(exact);
      verdict.is_honest = verdict.is_honest && error <= map.error[i] + exact.error[i] + room;
    }
  }
  return verdict;
}

void study_pressed_arrays(int count, unsigned long seed) {
  std::mt19937_64 random(seed);
  int answered = 0, below = 0, honest = 0, refused = 0;
  std::ostringstream worst;
  for (int i = 0; i < count; ++i) {
    const SpaceScene scene = random_pressed_array(random);
    try {
      const Judged verdict = judged_pressed(scene);
      ++answered;
      below += verdict.over <= 1.0 ? 1 : 0;
      honest += verdict.is_honest ? 1 : 0;
      if (verdict.over <= 1.0 && verdict.is_honest) continue;
      worst << "array " << i << ": error " << verdict.over << " of the tolerance "
            << scene.tolerance << ", honest " << verdict.is_honest << "\n";
    } catch (const std::exception& error) {
      ++refused;
      worst << "array " << i << " (tolerance " << scene.tolerance << "): " << error.what() << "\n";
    }
  }
  CAPTURE(count, answered, below, honest, refused, worst.str());
  if (std::getenv("VISCARD_SHOW") != nullptr) WARN(worst.str());
  // A tenth of the tolerance is more often beyond the finest grid than the tolerance itself.
  CHECK(answered >= 0.75 * count);
  CHECK(below >= 0.99 * answered);
  CHECK(honest >= 0.99 * answered);
}

// The finer answer of either kind: to a tenth of the tolerance, or on the finest mesh and grid of all.
SceneAnswer finer_answer(const SpaceScene& scene) {
  const auto all = std::get<SpaceScene>(plan_effects(with_all_effects_on(scene)).reduced);
  if (!scene.press) return space_answer_on(all, space_meshes(all).back());
  SpaceScene finer = scene;
  finer.tolerance = std::max(0.1 * scene.tolerance, SpaceScene::kTolerances.least);
  try {
    return simulate(finer);
  } catch (const std::exception&) {  // beyond the finest grid, or what stays on every grid
    return space_answer_on(scene, space_meshes(scene).back());
  }
}

Judged judged_touch(const SpaceScene& scene, const SceneAnswer& answer) {
  const SceneAnswer fine = finer_answer(scene);
  Judged verdict;
  for (const SceneMap& map : answer.maps) {
    const SceneMap& exact = map_of(fine, map.name);
    const double size = size_of(exact);
    for (std::size_t i = 0; i < map.value.size() && size > 0.0; ++i) {
      const double error = std::abs(map.value[i] - exact.value[i]);
      const double of_fine = exact.error.empty() ? 0.0 : exact.error[i];
      if (map.is_watched) verdict.over = std::max(verdict.over, error / (scene.tolerance * size));
      verdict.is_honest =
          verdict.is_honest && error <= map.error[i] + of_fine + 0.02 * scene.tolerance * size;
    }
  }
  return verdict;
}

// VISCARD_SHOW prints each scene that is refused, wrong or dishonest.
void study_touch(int from, int count, unsigned long seed) {
  int answered = 0, below = 0, honest = 0;
  std::ostringstream worst;
  for (int i = from; i < from + count; ++i) {
    std::mt19937_64 random(1000UL * seed + static_cast<unsigned long>(i));
    const SpaceScene scene = random_touch(random);
    SceneAnswer answer;
    try {
      answer = simulate(scene);
    } catch (const std::exception& error) {
      worst << "scene " << i << " (tolerance " << scene.tolerance << "): " << error.what() << "\n";
      continue;
    }
    ++answered;
    const Judged verdict = judged_touch(scene, answer);
    below += verdict.over <= 1.0 ? 1 : 0;
    honest += verdict.is_honest ? 1 : 0;
    if (verdict.over <= 1.0 && verdict.is_honest) continue;
    worst << "scene " << i << ": error " << verdict.over << " of the tolerance " << scene.tolerance
          << ", honest " << verdict.is_honest << "\n";
  }
  CAPTURE(count, answered, below, honest, worst.str());
  if (std::getenv("VISCARD_SHOW") != nullptr) {
    WARN("answered " << answered << ", below " << below << ", honest " << honest << " of " << count
                     << "\n"
                     << worst.str());
  }
  CHECK(answered >= 0.97 * count);
  CHECK(below >= 0.99 * answered);
  CHECK(honest >= 0.99 * answered);
}

}  // namespace

TEST_CASE("random arrays meet their tolerance with honest estimates", "[models][array][space]") {
  study_arrays(5, 1);
}

TEST_CASE("many random arrays meet their tolerance with honest estimates",
          "[models][array][space][slow]") {
  study_arrays(60, 2);
}

TEST_CASE("random arrays under a shape meet their tolerance with honest estimates",
          "[models][array][space]") {
  study_pressed_arrays(2, 3);
}

TEST_CASE("many random arrays under a shape meet their tolerance with honest estimates",
          "[models][array][space][slow]") {
  study_pressed_arrays(60, 4);
}

// Percentages are judged at 10 %, the voltage that distant neighbours add at all of the own one.
TEST_CASE("cross-talk from beyond the reach of an accuracy lies within its estimate",
          "[models][array][space]") {
  study_touch(107, 1, 5);
}

TEST_CASE("300 random touches are answered, within their tolerance and honest",
          "[models][array][space][slow]") {
  study_touch(0, 300, 5);
}

// A part of any size: VISCARD_TOUCHES="from count", for studies by hand.
TEST_CASE("a part of the random touches that the environment names", "[.][heldout]") {
  const char* const part = std::getenv("VISCARD_TOUCHES");
  if (part == nullptr) {
    study_touch(1000, 1, 5);
    return;
  }
  int from = 0, count = 0;
  std::istringstream(part) >> from >> count;
  study_touch(from, count, 5);
}
