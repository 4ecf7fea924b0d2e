#include "io/cli/scene/sweep_run.h"

#include "io/basics/atomic_file.h"
#include "io/cli/scene/answer_output.h"
#include "io/cli/scene/answer_pictures.h"
#include "io/cli/words/output_paths.h"
#include "io/cli/words/progress.h"
#include "io/cli/words/stop_on_signal.h"
#include "io/flow/scenes/array_sweep.h"
#include "io/flow/sweep/study_store.h"
#include "models/maths/text_of_number.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>
#include <optional>
#include <ostream>
#include <utility>

namespace viscard {
namespace {

constexpr std::pair<const char*, int SweepRow::*> kOfMesh[] = {{"unknowns", &SweepRow::unknowns},
                                                               {"degree", &SweepRow::degree},
                                                               {"layers", &SweepRow::layers}};

// How a row stands in a store: its results, then the mesh.
StudyPoint point_from_row(std::size_t number, const std::string& label, const SweepRow& row) {
  StudyPoint point{.point = static_cast<std::int64_t>(number), .values = {{"point", label}}};
  for (const SceneResult& r : row.results)
    point.results.push_back({r.name, r.value, r.unit, r.error_estimate});
  for (const auto& [name, of_row] : kOfMesh)
    point.results.push_back({name, static_cast<double>(row.*of_row), "1", 0.0});
  return point;
}

SweepRow row_from_point(const StudyPoint& point) {
  SweepRow row;
  for (const NamedValue& one : point.results) {
    const auto of_mesh = std::find_if(std::begin(kOfMesh), std::end(kOfMesh),
                                      [&](const auto& known) { return one.name == known.first; });
    if (of_mesh != std::end(kOfMesh)) {
      row.*of_mesh->second = static_cast<int>(one.value);
    } else {
      row.results.push_back({one.name, one.value, one.unit, one.error_estimate});
    }
  }
  return row;
}

// The points that are done, beside the table while the sweep runs.
class PartOfSweep {
 public:
  PartOfSweep(const std::string& folder, const Study& study, Streams& streams)
      : path_(std::filesystem::path(folder) / kPartOfSweep) {
    std::filesystem::create_directories(folder);
    StoreOptions how{.is_answering = true, .elsewhere = "choose another folder with --out"};
    how.on_gone = [&streams](const std::string& why) { streams.err << "viscard: " + why + "\n"; };
    store_.emplace(path_, study, how);
    if (store_->n_damaged() == 0) return;
    streams.err << fmt::format("viscard: {}: {} damaged; their points are answered again\n",
                               path_.string(), counted(store_->n_damaged(), "row"));
  }

  std::map<std::size_t, SweepRow> rows(std::size_t n_points) {
    std::map<std::size_t, SweepRow> rows;
    store_->for_each([&](const StudyPoint& point) {
      const auto number = static_cast<std::size_t>(point.point);
      if (number < n_points) rows[number] = row_from_point(point);
    });
    return rows;
  }

  void add(const StudyPoint& point) { store_->add(point); }

  // The sweep is complete and written elsewhere.
  void remove() {
    store_.reset();
    std::filesystem::remove(path_);
  }

 private:
  std::filesystem::path path_;
  std::optional<StudyStore> store_;
};

}  // namespace

Study study_of_sweep(const SceneFile& file, const std::string& path) {
  const double tolerance = common(file.scene).tolerance;
  return study_of_scene(path, fmt::format("tolerance {:.17g}", tolerance));
}

SceneAnswer run_sweep(const SceneFile& file, const std::string& path, const SweepOutput& output,
                      Streams& streams) {
  const auto& scene = std::get<ArrayScene>(file.scene);
  const std::vector<SweepPoint> points = points_of(scene, file.sweep);
  const std::string& folder = output.folder;
  const bool overwrite = output.overwrite;
  const std::filesystem::path table = std::filesystem::path(folder) / "sweep.csv";
  std::optional<PartOfSweep> part;
  std::map<std::size_t, SweepRow> rows;
  if (!folder.empty()) {
    refuse_existing(table, overwrite);
    part.emplace(folder, study_of_sweep(file, path), streams);
    rows = part->rows(points.size());
  }
  if (!rows.empty())
    streams.err << fmt::format("continuing: {} of {} points are done\n", rows.size(),
                               points.size());
  const WordsOnSignal words_on_signal(
      folder.empty() ? "the sweep was stopped, and nothing is written; --out FOLDER keeps the "
                       "points that are done"
                     : "the sweep was stopped; the points that are done are in " + folder +
                           ", and the same command goes on with the others");
  Progress progress(streams, "sweep");
  SweepListener listener;
  listener.progress = [&](double done, const std::string& label) { progress.show(done, label); };
  if (part) {
    listener.keep = [&](std::size_t number, const SweepRow& row) {
      part->add(point_from_row(number, points[number].label, row));
    };
  }
  SceneAnswer sum = solve_sweep(file, rows, listener);
  progress.clear();
  if (part) {
    write_file(table, csv_from_sweep(points, rows, output.command), overwrite);
    write_pictures(pictures_over_sweep(file.sweep, points, rows), folder, overwrite);
    part->remove();
  }
  return sum;
}

}  // namespace viscard
