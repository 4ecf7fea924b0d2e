#include "io/cli/scene/command_simulate.h"

#include "io/basics/atomic_file.h"
#include "io/cli/scene/answer_output.h"
#include "io/cli/scene/array_run.h"
#include "io/cli/words/command_line.h"
#include "io/cli/words/printed_values.h"
#include "io/cli/words/progress.h"
#include "io/pictures/section_picture.h"
#include "io/pictures/vtk_file.h"
#include "io/scenes/scene_array.h"
#include "io/scenes/scene_file.h"
#include "models/pillar/plan/plan.h"

#include <nlohmann/json.hpp>

#include <chrono>
#include <filesystem>
#include <ostream>

namespace po = boost::program_options;

namespace viscard {
namespace {

SceneAnswer answer_of(Scene scene, const std::string& path, Streams& streams) {
  Progress progress(streams, "simulate");
  scene.progress = [&](double done) { progress.show(done, ""); };
  try {
    return simulate_planned(scene);
  } catch (const SceneMistake& mistake) {
    throw std::runtime_error(told_with_line(path, mistake));
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(path + ": " + error.what());
  }
}

// For ParaView and to look at: the solution on the mesh that met the tolerance.
void write_fields(const Scene& scene, const SceneAnswer& answer, const std::string& folder,
                  bool overwrite) {
  for (const SectionGrid& grid : solution_fields(scene, answer.discretisation)) {
    const std::filesystem::path in = folder;
    write_file(in / (grid.name + ".vtu"), vtu_from_grid(grid), overwrite);
    for (const auto& [name, svg] : pictures_from_grid(grid)) {
      write_file(in / (name + ".svg"), svg, overwrite);
    }
  }
}

CommandSyntax simulate_syntax() {
  CommandSyntax syntax{
      "viscard simulate SCENE.toml [OPTIONS]",
      "Answers a scene: static, modal, buckling, creep, relaxation, harmonic or transient of one "
      "pillar, on a rigid base or a film,\nor voltages, cross-talk and modes of a row of pillars. "
      "The "
      "mesh is refined until the estimated error meets the tolerance.",
      "viscard simulate data/scenes/pillar_modal.toml"};
  syntax.options.add_options()("tol", po::value<double>(),
                               "relative error allowed, instead of the scene's")(
      "out", po::value<std::string>(),
      "folder for results as JSON and CSV, curves as CSV and pictures; static and modal scenes add "
      "fields "
      "as .vtu for ParaView")("force", "overwrite existing files");
  syntax.positional = {"scene"};
  return syntax;
}

}  // namespace

int run_simulate(const std::vector<std::string>& words, Streams& streams) {
  CommandSyntax syntax = simulate_syntax();
  const auto values = parse_words(syntax, words, streams);
  if (!values) return kDone;
  if (values->count("scene") == 0)
    throw UsageError(std::string("which scene? usage: ") + syntax.usage);
  const auto path = (*values)["scene"].as<std::string>();
  if (scene_kind(path) == "array") return run_array_scene(path, *values, words, streams);
  SceneFile file = read_scene(path);
  if (values->count("tol") > 0) file.scene.tolerance = (*values)["tol"].as<double>();
  if (!(file.scene.tolerance >= 1e-9 && file.scene.tolerance < 1.0)) {
    throw UsageError("--tol must lie between 1e-9 and 1");
  }
  const auto start = std::chrono::steady_clock::now();
  SceneAnswer answer = answer_of(file.scene, path, streams);
  const double wall_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const auto printed = compare_printed(file.printed, answer);
  if (file.scene.kind != AnalysisKind::kModal) keep_wanted(file.quantities, answer);
  nlohmann::json object = json_from_answer(answer, wall_s);
  if (!printed.empty()) object["printed"] = json_from_comparison(printed);
  if (values->count("out") > 0) {
    write_files(answer, object, (*values)["out"].as<std::string>(),
                quoted_command_line("simulate", words), values->count("force") > 0);
    write_fields(file.scene, answer, (*values)["out"].as<std::string>(),
                 values->count("force") > 0);
  }
  if (values->count("json") > 0) {
    streams.out << object.dump(2) << "\n";
  } else {
    streams.out << path << "\n";
    print_answer(answer, wall_s, streams.out);
    print_comparison(printed, streams.out);
  }
  return kDone;
}

}  // namespace viscard
