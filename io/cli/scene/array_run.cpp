#include "io/cli/scene/array_run.h"

#include "io/basics/atomic_file.h"
#include "io/basics/sha256.h"
#include "io/cli/scene/answer_output.h"
#include "io/cli/scene/array_sweep.h"
#include "io/cli/scene/row_pictures.h"
#include "io/cli/words/command_line.h"
#include "io/cli/words/printed_values.h"
#include "io/cli/words/progress.h"
#include "io/scenes/scene_array.h"
#include "models/array/plane/array_plan.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <ostream>

namespace viscard {
namespace {

using Words = boost::program_options::variables_map;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// One point after the other as they end; what an earlier run left is not computed again.
SceneAnswer run_sweep(const ArraySceneFile& file, const std::string& key, const Words& values,
                      const std::string& command, Streams& streams) {
  const std::vector<SweepPoint> points = points_of(file);
  const std::string folder = values.count("out") > 0 ? values["out"].as<std::string>() : "";
  const std::filesystem::path table = std::filesystem::path(folder) / "sweep.csv";
  const bool overwrite = values.count("force") > 0;
  if (!folder.empty() && !overwrite && std::filesystem::exists(table)) {
    throw std::runtime_error(table.string() + " exists; add --force to overwrite it");
  }
  SweepStore store(folder, key);
  if (!store.done().empty()) {
    streams.err << fmt::format("going on: {} of {} points are there\n", store.done().size(),
                               points.size());
  }
  std::vector<ArrayScene> left;
  std::vector<std::size_t> number;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (store.done().count(i) > 0) continue;
    left.push_back(points[i].scene);
    number.push_back(i);
  }
  SceneAnswer sum;
  Progress progress(streams, "sweep");
  simulate_arrays(left, [&](std::size_t i, const SceneAnswer& answer) {
    SceneAnswer kept = answer;
    keep_wanted(file.scene.wanted, kept);
    store.add(number[i], kept.results);
    sum.unknowns = std::max(sum.unknowns, answer.unknowns);
    if (answer.discretisation.degree >= sum.discretisation.degree) {
      sum.discretisation = answer.discretisation;
    }
    sum.effects = answer.effects;
    progress.show(static_cast<double>(store.done().size()) / static_cast<double>(points.size()),
                  points[number[i]].label);
  });
  progress.clear();
  if (!folder.empty()) {
    write_file(table, csv_from_sweep(points, store.done(), command), overwrite);
    write_pictures(pictures_over_sweep(file, points, store.done()), folder, overwrite);
    store.remove();
  }
  sum.results = joined(file, points, store.done()).results;
  return sum;
}

}  // namespace

int run_array_scene(const std::string& path, const Words& values,
                    const std::vector<std::string>& words, Streams& streams) {
  ArraySceneFile file = read_array_scene(path);
  if (values.count("tol") > 0) file.scene.tolerance = values["tol"].as<double>();
  if (!(file.scene.tolerance >= 1e-7 && file.scene.tolerance < 1.0)) {
    throw UsageError("--tol must lie between 1e-7 and 1 for a row of pillars");
  }
  const std::string command = quoted_command_line("simulate", words);
  const auto start = std::chrono::steady_clock::now();
  SceneAnswer answer;
  if (file.sweep.is_empty()) {
    answer = simulate_array_planned(file.scene);
    if (file.scene.analysis != ArrayAnalysis::kModal) keep_wanted(file.scene.wanted, answer);
  } else {
    const std::string key =
        fmt::format("sweep {} tolerance {:.9g} viscard {}", sha256_of_file(path),
                    file.scene.tolerance, VISCARD_VERSION);
    answer = run_sweep(file, key, values, command, streams);
  }
  const double wall_s = seconds_since(start);
  const auto printed = compare_printed(file.printed, answer);
  nlohmann::json object = json_from_answer(answer, wall_s);
  if (!printed.empty()) object["printed"] = json_from_comparison(printed);
  if (values.count("out") > 0) {
    const auto folder = values["out"].as<std::string>();
    const bool overwrite = values.count("force") > 0;
    write_files(answer, object, folder, command, overwrite);
    if (file.sweep.is_empty()) write_pictures(pictures_over_pillars(answer), folder, overwrite);
  }
  if (values.count("json") > 0) {
    streams.out << object.dump(2) << "\n";
  } else {
    streams.out << path << "\n";
    print_answer(answer, wall_s, streams.out);
    print_comparison(printed, streams.out);
  }
  return kDone;
}

}  // namespace viscard
