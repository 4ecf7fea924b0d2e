#include "io/basics/atomic_file.h"
#include "io/cli/scene/answer_output.h"
#include "io/cli/scene/answer_pictures.h"
#include "io/cli/scene/array_sweep.h"
#include "io/cli/words/output_paths.h"
#include "io/cli/words/progress.h"
#include "models/scene/simulate.h"

#include <fmt/format.h>

#include <filesystem>
#include <ostream>
#include <utility>

namespace viscard {
namespace {

// Points that were stored under another key belong to another scene.
std::string key_of(const ArrayScene& scene, const std::string& path) {
  return fmt::format("sweep {} tolerance {:.9g} viscard {}", sha256_of_file(path), scene.tolerance,
                     VISCARD_VERSION);
}

// Points finish in any order: the answer of a sweep holds each effect as it is at the point where
// leaving it out costs most.
void keep_largest(const std::vector<SceneEffect>& point, std::vector<SceneEffect>& sum) {
  if (sum.empty()) sum = point;
  for (std::size_t i = 0; i < sum.size(); ++i) {
    if (point[i].estimate > sum[i].estimate) sum[i] = point[i];
  }
}

}  // namespace

SceneAnswer run_sweep(const SceneFile& file, const std::string& path, const SweepOutput& output,
                      Streams& streams) {
  const auto& scene = std::get<ArrayScene>(file.scene);
  const std::vector<SweepPoint> points = points_of(scene, file.sweep);
  const std::string& folder = output.folder;
  const bool overwrite = output.overwrite;
  const std::filesystem::path table = std::filesystem::path(folder) / "sweep.csv";
  if (!folder.empty()) refuse_existing(table, overwrite);
  SweepStore store(folder, key_of(scene, path));
  if (!store.done().empty()) {
    streams.err << fmt::format("continuing: {} of {} points are done\n", store.done().size(),
                               points.size());
  }
  std::vector<Scene> left;
  std::vector<std::size_t> number;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (store.done().count(i) > 0) continue;
    left.push_back(points[i].scene);
    number.push_back(i);
  }
  SceneAnswer sum;
  Progress progress(streams, "sweep");
  simulate_all(left, [&](std::size_t i, const SceneAnswer& answer) {
    SceneAnswer kept = answer;
    keep_wanted(scene.wanted, kept);
    store.add(number[i], kept.results);
    if (answer.unknowns > sum.unknowns) {
      sum.unknowns = answer.unknowns;
      sum.discretisation = answer.discretisation;
    }
    keep_largest(answer.effects, sum.effects);
    progress.show(static_cast<double>(store.done().size()) / static_cast<double>(points.size()),
                  points[number[i]].label);
  });
  progress.clear();
  if (!folder.empty()) {
    write_file(table, csv_from_sweep(points, store.done(), output.command), overwrite);
    write_pictures(pictures_over_sweep(file.sweep, points, store.done()), folder, overwrite);
    store.remove();
  }
  SceneAnswer all = joined(file.sweep, points, store.done());
  sum.results = std::move(all.results);
  sum.notes = std::move(all.notes);
  return sum;
}

}  // namespace viscard
