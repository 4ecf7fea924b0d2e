#include "io/cli/scene/sweep_run.h"

#include "io/basics/atomic_file.h"
#include "io/cli/scene/answer_output.h"
#include "io/cli/scene/answer_pictures.h"
#include "io/cli/words/output_paths.h"
#include "io/cli/words/progress.h"
#include "io/cli/words/stop_on_signal.h"
#include "io/flow/scenes/array_sweep.h"

#include <fmt/format.h>

#include <filesystem>
#include <ostream>

namespace viscard {
namespace {

// Points that were stored under another key belong to another scene.
std::string key_of(const ArrayScene& scene, const std::string& path) {
  return fmt::format("sweep {} tolerance {:.9g} viscard {}", sha256_as_read(path), scene.tolerance,
                     VISCARD_VERSION);
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
  const WordsOnSignal words_on_signal(
      folder.empty() ? "the sweep was stopped, and nothing is written; --out FOLDER keeps the "
                       "points that are done"
                     : "the sweep was stopped; the points that are done are in " + folder +
                           ", and the same command goes on with the others");
  Progress progress(streams, "sweep");
  SceneAnswer sum = solve_sweep(
      file, store, [&](double done, const std::string& label) { progress.show(done, label); });
  progress.clear();
  if (!folder.empty()) {
    write_file(table, csv_from_sweep(points, store.done(), output.command), overwrite);
    write_pictures(pictures_over_sweep(file.sweep, points, store.done()), folder, overwrite);
    store.remove();
  }
  return sum;
}

}  // namespace viscard
