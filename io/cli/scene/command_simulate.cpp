#include "io/basics/atomic_file.h"
#include "io/cli/scene/answer_output.h"
#include "io/cli/scene/answer_pictures.h"
#include "io/cli/scene/scene_commands.h"
#include "io/cli/scene/sweep_run.h"
#include "io/cli/scene/uncertainty_output.h"
#include "io/cli/words/command_line.h"
#include "io/cli/words/fitted_text.h"
#include "io/cli/words/json_output.h"
#include "io/cli/words/progress.h"
#include "io/cli/words/stop_on_signal.h"
#include "io/flow/scenes/answer_scene.h"
#include "io/flow/scenes/scene_uncertainty.h"
#include "io/flow/scenes/wanted_results.h"
#include "io/pictures/row_picture.h"
#include "io/pictures/section_picture.h"
#include "io/scenes/scene_file.h"
#include "models/answer/effect_estimate.h"
#include "models/scene/simulate.h"

#include <chrono>
#include <filesystem>
#include <ostream>
#include <string>

namespace viscard {
namespace {

SceneAnswer answer_of(Scene scene, const std::string& path, Streams& streams) {
  const WordsOnSignal words_on_signal("the simulation was stopped, and nothing is written");
  Progress progress(streams, "simulate");
  common(scene).progress = [&](double done, const std::string& what) {
    progress.announce(done, what);
  };
  return simulate_file(scene, path);
}

// Pictures and ParaView files of the solution on the mesh that met the tolerance, and results over
// the numbers of the pillars.
void write_looks(const Scene& scene, const SceneAnswer& answer, const std::string& path,
                 const SweepOutput& output, Streams& streams) {
  Progress progress(streams, "simulate");
  progress.announce(1.0, "pictures");
  const std::filesystem::path in = output.folder;
  const std::string name = std::filesystem::path(path).stem().string();
  for (const SectionGrid& grid : solution_fields(scene, answer.discretisation)) {
    write_file(in / (grid.name + ".vtu"), vtu_from_grid(grid), output.overwrite);
    write_pictures(pictures_from_grid(grid, captions_from_answer(answer), name), output.folder,
                   output.overwrite);
  }
  if (const RowShapes shapes = mode_shapes(scene, answer.discretisation); !shapes.modes.empty()) {
    write_file(in / "mode_shapes.csv", csv_of_shapes(shapes, answer.modes, output.command),
               output.overwrite);
    write_pictures(pictures_from_shapes(shapes, answer.modes, name), output.folder,
                   output.overwrite);
  }
  const auto* row = std::get_if<ArrayScene>(&scene);
  const std::vector<int> loaded = row == nullptr ? std::vector<int>{} : row->loaded;
  write_pictures(pictures_over_pillars(answer, loaded), output.folder, output.overwrite);
}

// The options of `viscard simulate`.
struct SimulateWords {
  std::string scene;
  std::optional<double> tolerance;
  std::optional<std::string> compare;
  bool with_uncertainty = false;
  std::optional<std::size_t> n_samples;
  std::optional<std::string> out;
  bool overwrite = false;
};

// The uncertainty of an answer, if it is asked for.
std::optional<SceneUncertainty> uncertainty_of(const SimulateWords& words, const SceneFile& file,
                                               const SceneAnswer& answer, Streams& streams) {
  const std::string& path = words.scene;
  const auto n_samples = words.n_samples;
  if (!words.with_uncertainty) {
    if (n_samples) throw UsageError("--samples belongs to --uncertainty; give both");
    return std::nullopt;
  }
  constexpr std::size_t kFewest = 100, kMost = 10'000'000;
  if (n_samples && (*n_samples < kFewest || *n_samples > kMost)) {
    throw UsageError("--samples must be a number from 100 to 10000000");
  }
  Progress progress(streams, "uncertainty");
  const WordsOnSignal words_on_signal(
      "the uncertainty was stopped; nothing is written. --samples N limits the number of answers");
  const UncertainScene scene(file, read_file(path), path);
  progress.announce(0.0, "answers around the given values");
  return scene_uncertainty(scene, answer, {.n_samples = n_samples, .progress = [&](double done) {
                                             progress.show(done, "answers around the given values");
                                           }});
}

std::string stem_of(const std::string& path) {
  return std::filesystem::path(path).stem().string();
}

// Before any work.
std::optional<OtherScene> other_of(const SimulateWords& words, const SceneFile& file,
                                   Plausible judged) {
  try {
    return other_scene(words.compare, file, words.scene, words.tolerance, judged);
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
}

// Answers the other scene and draws both.
void compare_with(const std::string& path, const SceneFile& file, const OtherScene& other,
                  const SweepOutput& output, ShownAnswer& shown, Streams& streams) {
  streams.accepts_implausible |= other.file.accepts_implausible;
  SceneAnswer answer = answer_of(other.file.scene, other.path, streams);
  keep_wanted(common(other.file.scene).wanted, answer);
  shown.compared =
      compare_answers({file.scene, shown.answer}, {other.file.scene, answer}, other.path);
  if (output.folder.empty()) return;
  std::filesystem::create_directories(output.folder);
  const ComparedNames names{stem_of(path), stem_of(other.path)};
  write_pictures(pictures_of_compared(shown.answer, answer, *shown.compared, names), output.folder,
                 output.overwrite);
}

CommandSyntax simulate_syntax(SimulateWords& words) {
  CommandSyntax syntax{
      "viscard simulate SCENE.toml [OPTIONS]",
      "Answers a scene: static, modal, buckling, creep, relaxation, harmonic or transient of one "
      "pillar, on a rigid base or a film; voltages, cross-talk and modes of a row of pillars, or "
      "its contact with a rigid shape; or maps of voltages, cross-talk and contact forces over an "
      "array in the plane, under loads or a rigid shape. The mesh is refined until the estimated "
      "error meets the tolerance.",
      "viscard simulate data/scenes/pillar_modal.toml"};
  syntax.positional.add("scene", &words.scene, "scene file");
  OptionList& options = syntax.options;
  add_tolerance_option(options, words.tolerance);
  options
      .add("compare", &words.compare,
           "a second scene, by default that of the key compare: results, modes and voltages along "
           "x of both beside each other, and in "
           "--out "
           "curves and voltages of both in one picture each")
      .shown_as("SCENE.toml");
  options.add("uncertainty", &words.with_uncertainty,
              "95 % intervals of the results, and the share of each input in their variance: "
              "quantities such as \"40 um +- 1 um\" (also: uniform, lognormal) and what material "
              "files state");
  options.add("samples", &words.n_samples,
              "with --uncertainty: sample with about this many answers, even if the linear answer "
              "is enough; default: 4000 if it is not");
  options.add("out", &words.out,
              "folder for results as JSON and CSV, curves as CSV and pictures; static and modal "
              "scenes add fields as .vtu for ParaView, modes of a row mode_shapes.csv, arrays in "
              "the plane pillars.csv and maps as .npy");
  options.add("force", &words.overwrite, "overwrite existing files").only_with({"out"});
  syntax.may_exist = {"out"};
  syntax.results = {described<ShownAnswer>(
      "simulate", "viscard simulate; results.json has command and created_by besides")};
  return syntax;
}

}  // namespace

int run_simulate(const Words& words, Streams& streams) {
  SimulateWords asked;
  CommandSyntax syntax = simulate_syntax(asked);
  if (!parse_words(syntax, words, streams)) return kDone;
  const std::string& path = asked.scene;
  SceneFile file = read_scene(path, given_plausible(syntax, Plausible::kScene));
  streams.accepts_implausible |= file.accepts_implausible;
  apply_tolerance(asked.tolerance, file.scene);
  const std::optional<OtherScene> other =
      other_of(asked, file, given_plausible(syntax, Plausible::kScene));
  const bool is_sweep = !file.sweep.is_empty();
  const std::string folder = asked.out.value_or("");
  const SweepOutput output{folder, quoted_command_line("simulate", words), asked.overwrite};
  const auto start = std::chrono::steady_clock::now();
  ShownAnswer shown{.scene = path, .tolerance = common(file.scene).tolerance};
  SceneAnswer& answer = shown.answer;
  answer = is_sweep ? run_sweep(file, path, output, streams) : answer_of(file.scene, path, streams);
  shown.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  add_notes_of_file(file, answer);
  shown.printed = compare_printed(file.printed, answer);
  if (!is_sweep) keep_wanted(common(file.scene).wanted, answer);  // a sweep has kept them by point
  if (other) compare_with(path, file, *other, output, shown, streams);
  shown.uncertainty = uncertainty_of(asked, file, answer, streams);
  if (!folder.empty()) {
    shown.command = output.command;
    shown.accepts_implausible = streams.accepts_implausible;
    write_files(shown, folder, output.overwrite);
    shown.command.clear();
    if (!is_sweep) write_looks(file.scene, answer, path, output, streams);
    if (shown.uncertainty)
      write_uncertainty(*shown.uncertainty, folder, output.command, output.overwrite);
  }
  const auto show = [&](ResultVisitor& v) { show_keys(v, shown); };
  const SceneEffect* missing = largest_not_computed(answer);
  // An effect larger than the answer leaves nothing of it.
  const int code =
      missing != nullptr && is_missing(*missing) && missing->estimate > 1.0 ? kFailed : kDone;
  if (print_result(syntax, {"viscard-simulate/1", {path}}, show, streams)) return code;
  const std::string doubt = tolerance_doubt(answer, shown.tolerance);
  streams.out << path << (doubt.empty() ? "" : ": ") << doubt << "\n";
  print_answer(answer, shown.wall_s, FittedText(streams));
  print_comparison(shown.printed, FittedText(streams));
  if (shown.compared) print_compared(*shown.compared, FittedText(streams));
  if (shown.uncertainty) print_uncertainty(*shown.uncertainty, FittedText(streams));
  return code;
}

}  // namespace viscard
