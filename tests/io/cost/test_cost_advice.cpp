// What `viscard cost` recommends for a tolerance, followed, meets it: against an answer finer than
// anything the study itself has run.
#include "io/cost/study_cost.h"
#include "io/cost/study_trials.h"
#include "io/scenes/scene_file.h"
#include "models/array/layer/simulate_layer.h"
#include "models/pillar/analyses/large_strain.h"
#include "models/pillar/mesh/pillar_mesh.h"
#include "models/scene/plan.h"
#include "models/scene/simulate.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

using namespace viscard;

namespace {

// Of a build with sanitizers, so that a budget covers the same rows there.
#ifdef __SANITIZE_ADDRESS__
constexpr double kSlowdown = 40.0;
#else
constexpr double kSlowdown = 1.0;
#endif

// Degree 10, five layers. At large strain thin elements at the rim would turn inside out.
Discretisation finest_mesh(const PillarScene& scene) {
  return (is_large(scene) ? large_mesh_sequence(scene.geometry) : mesh_sequence(scene.geometry))
      .back();
}

Discretisation finest_mesh(const ArrayScene& scene) {
  return {.degree = 10, .layers = scene.electrodes.is_equipotential ? 10 : 6, .shaft_elements = 3};
}

Discretisation finest_mesh(const SpaceScene&) {
  return {.degree = 9, .layers = 4};
}

Discretisation finest_mesh(const LayerScene& scene) {
  return layer_meshes(scene).back();
}

// Of the scene's tolerance, or none where the mesh alone decides.
std::optional<double> share_of_tolerance(const auto&) {
  return std::nullopt;
}

// A touch in time to a twentieth did not end within ten minutes.
std::optional<double> share_of_tolerance(const SpaceScene& scene) {
  if (scene.touch) return 0.1;
  return scene.press ? std::optional(0.05) : std::nullopt;
}

std::optional<double> share_of_tolerance(const PillarScene& scene) {
  const bool moves = std::holds_alternative<HarmonicDrive>(scene.drive) ||
                     std::holds_alternative<TransientDrive>(scene.drive);
  return moves ? std::optional(0.05) : std::nullopt;
}

SceneAnswer independent_answer(const Scene& scene) {
  Scene on = plan_effects(with_all_effects_on(scene)).reduced;
  const std::optional<double> share =
      std::visit([](const auto& body) { return share_of_tolerance(body); }, scene);
  common(on).tolerance = share ? *share * common(scene).tolerance : 1e-6;
  return answer_on(on, std::visit([](const auto& body) { return finest_mesh(body); }, on));
}

bool is_asked(const std::vector<std::string>& wanted, const std::string& name) {
  return wanted.empty() || std::any_of(wanted.begin(), wanted.end(), [&](const std::string& w) {
           return name == w || name.starts_with(w + "_");
         });
}

double error_of(const SceneAnswer& answer, const SceneAnswer& exact,
                const std::vector<std::string>& wanted) {
  double largest = 0.0;
  for (const SceneResult& r : exact.results) {
    if (!is_asked(wanted, r.name) || !r.is_wanted)
      continue;  // a contact area has an error of its own
    const auto mine = std::find_if(answer.results.begin(), answer.results.end(),
                                   [&](const SceneResult& other) { return other.name == r.name; });
    if (mine == answer.results.end()) return 1.0;
    const double size = std::max(std::abs(r.value), r.scale);
    if (size > 0.0) largest = std::max(largest, std::abs(mine->value - r.value) / size);
  }
  REQUIRE(answer.modes.size() == exact.modes.size());
  for (std::size_t i = 0; i < exact.modes.size(); ++i) {
    largest = std::max(largest,
                       std::abs(answer.modes[i].frequency_Hz / exact.modes[i].frequency_Hz - 1.0));
  }
  return largest;
}

// Rows that the budget was too short for are missing among the study's.
const CostTrial& trial_of(const CostRow& row, const CostTrials& trials) {
  const auto found =
      std::find_if(trials.rows.begin(), trials.rows.end(), [&](const CostTrial& trial) {
        return trial.discretisation == row.discretisation && trial.effects == row.effects;
      });
  REQUIRE(found != trials.rows.end());
  return *found;
}

// The budget is processor time here, so that a busy machine leaves the same rows out.
CostClock processor_clock() {
  CostClock clock = process_clock();
  clock.wall_s = [cpu_s = clock.cpu_s] { return cpu_s() / kSlowdown; };
  return clock;
}

// Returns how many recommendations there are. `exact` is computed for the first.
int follow(const Scene& scene, double budget_s, std::optional<SceneAnswer>& exact) {
  const CostStudy study =
      study_cost(scene, {.budget_s = budget_s, .repeats = 1, .clock = processor_clock()});
  const CostTrials trials = trials_of(scene);
  int followed = 0;
  for (const CostAdvice& advice : study.advice) {
    if (advice.row < 0) continue;
    const CostTrial& row = trial_of(study.rows[static_cast<std::size_t>(advice.row)], trials);
    if (!exact) exact = independent_answer(scene);
    CAPTURE(advice.text, row.discretisation, row.effects);
    CHECK(error_of(row.run(), *exact, common(scene).wanted) <= advice.tolerance);
    ++followed;
  }
  return followed;
}

// Of the five tolerances at least the loose ones are met within one of the budgets.
void follow_file(const std::string& name, const std::vector<double>& budgets_s) {
  CAPTURE(name);
  const std::filesystem::path path =
      std::filesystem::path(VISCARD_SOURCE_DIR) / "data/scenes" / name;
  const Scene scene = read_scene(path).scene;
  std::optional<SceneAnswer> exact;
  int followed = 0;
  for (std::size_t i = 0; i < budgets_s.size() && followed < 2; ++i) {
    followed = follow(scene, budgets_s[i], exact);
  }
  CHECK(followed >= 2);
}

}  // namespace

TEST_CASE("what a cost study recommends meets its tolerance", "[io][scene]") {
  // Budgets leave room for a processor whose threads are shared, which counts twice the time.
  const auto [name, budget_s] = GENERATE(table<std::string, double>(
      {{"pillar_buckling.toml", 1.0}, {"pillar_sensor.toml", 1.0}, {"array_voltages.toml", 4.0}}));
  follow_file(name, {budget_s});
}

TEST_CASE("without time a cost study shows a few cheap meshes and lists the rows left out",
          "[io][scene]") {
  const Scene scene = read_scene(VISCARD_SOURCE_DIR "/data/scenes/pillar_buckling.toml").scene;
  const CostStudy study =
      study_cost(scene, {.budget_s = 1e-9, .repeats = 1, .clock = processor_clock()});
  CHECK(study.rows.size() == 4);
  CHECK(study.left_out + 4 == static_cast<int>(trials_of(scene).rows.size()));
}

TEST_CASE("what a cost study recommends meets its tolerance on every example",
          "[io][scene][slow]") {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(VISCARD_SOURCE_DIR "/data/scenes")) {
    if (entry.path().extension() != ".toml") continue;
    follow_file(entry.path().filename().string(), {20.0, 60.0, 180.0});
    ++count;
  }
  CHECK(count >= 11);
}
