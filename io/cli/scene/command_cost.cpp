#include "io/basics/atomic_file.h"
#include "io/cli/scene/scene_commands.h"
#include "io/cli/words/command_line.h"
#include "io/cli/words/progress.h"
#include "io/cost/study_cost.h"
#include "io/plots/plot.h"
#include "io/scenes/scene_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <ostream>

namespace po = boost::program_options;

namespace viscard {
namespace {

nlohmann::json json_from_study(const CostStudy& study) {
  nlohmann::json rows = nlohmann::json::array();
  for (const CostRow& row : study.rows) {
    rows.push_back({{"discretisation", row.discretisation},
                    {"effects", row.effects},
                    {"unknowns", row.unknowns},
                    {"wall_s", row.wall_s},
                    {"memory_B", row.memory_B},
                    {"error", row.error},
                    {"pareto", row.is_on_front}});
  }
  nlohmann::json advice = nlohmann::json::array();
  for (const CostAdvice& one : study.advice) {
    advice.push_back({{"tolerance", one.tolerance},
                      {"row", one.row < 0 ? nlohmann::json() : nlohmann::json(one.row)},
                      {"text", one.text}});
  }
  nlohmann::json linear;  // null if the rows do not give it
  if (const auto factor = factor_over_linear(study, 1e-3)) {
    linear = {{"error", factor->error},
              {"factor", factor->factor},
              {"extrapolated", factor->is_extrapolated},
              {"quickest", factor->quickest}};
  }
  return {{"rows", rows},
          {"recommendations", advice},
          {"linear_elements", linear},
          {"reference_error", study.reference_error},
          {"rows_left_out", study.left_out}};
}

std::string csv_from_study(const CostStudy& study, const std::string& command) {
  std::string text = fmt::format(
      "# {} (viscard {})\ndiscretisation,effects,unknowns,wall_s,memory_B,error,pareto\n", command,
      VISCARD_VERSION);
  for (const CostRow& row : study.rows) {
    text += fmt::format("\"{}\",\"{}\",{},{},{},{},{}\n", row.discretisation, row.effects,
                        row.unknowns, row.wall_s, row.memory_B, row.error, row.is_on_front ? 1 : 0);
  }
  return text;
}

// Rows of one kind as dots of one colour: the first word of the discretisation, or the effects.
std::string kind_of(const CostRow& row) {
  if (row.effects != "all on") return "effects";
  if (row.discretisation.rfind("graded", 0) == 0) return "graded p";
  return row.discretisation.substr(0, row.discretisation[0] == 'p' ? 1 : 2);
}

constexpr double kLeastError = 1e-12;  // a logarithmic axis has no zero

PlotSeries pareto_line(const CostStudy& study) {
  std::vector<CostRow> front;
  std::copy_if(study.rows.begin(), study.rows.end(), std::back_inserter(front),
               [](const CostRow& row) { return row.is_on_front; });
  std::sort(front.begin(), front.end(),
            [](const CostRow& a, const CostRow& b) { return a.wall_s < b.wall_s; });
  PlotSeries line{.mark = Mark::kLine, .label = "Pareto front", .ink = Ink::kGrey};
  for (const CostRow& row : front) {
    line.x.push_back(row.wall_s);
    line.y.push_back(std::max(row.error, kLeastError));
  }
  return line;
}

Plot plot_from_study(const CostStudy& study, const std::string& scene) {
  PlotPanel panel;
  panel.x = {.label = "time (s)", .is_log = true};
  panel.y = {.label = "relative error", .is_log = true};
  panel.series.push_back(pareto_line(study));
  for (const char* kind : {"h1", "h2", "p", "graded p", "effects"}) {
    PlotSeries series{.mark = Mark::kPoints, .label = kind, .size = 3.0};
    for (const CostRow& row : study.rows) {
      if (kind_of(row) != kind) continue;
      series.x.push_back(row.wall_s);
      series.y.push_back(std::max(row.error, kLeastError));
    }
    series.ink = ink_of_series(panel.series.size() - 1);
    if (!series.x.empty()) panel.series.push_back(series);
  }
  return {.title = "What accuracy costs: " + scene,
          .description =
              "Relative error against time for each discretisation, with the front of those that "
              "no other beats in both.",
          .panels = {panel},
          .width_px = 760,
          .height_px = 460};
}

void print_study(const CostStudy& study, const std::string& path, std::ostream& out) {
  out << fmt::format("{}; reference known to {:.1e}\n  {:<36} {:<28} {:>8} {:>10} {:>8} {:>9}\n",
                     path, study.reference_error, "discretisation", "effects", "unknowns",
                     "time (ms)", "MB", "error");
  for (const CostRow& row : study.rows) {
    out << fmt::format("{} {:<36} {:<28} {:>8} {:>10.3g} {:>8.2f} {:>9.1e}\n",
                       row.is_on_front ? "*" : " ", row.discretisation, row.effects, row.unknowns,
                       1e3 * row.wall_s, 1e-6 * row.memory_B, row.error);
  }
  out << "  * on the Pareto front: nothing is both faster and more accurate\n";
  if (study.left_out > 0) {
    out << fmt::format("  {} more did not fit into the budget; --budget gives more time\n",
                       study.left_out);
  }
  if (const auto linear = factor_over_linear(study, 1e-3)) {
    out << fmt::format("linear elements need {:.3g} times the time of {} for an error of 0.1 %{}\n",
                       linear->factor, linear->quickest,
                       linear->is_extrapolated ? " (extrapolated from the two finest)" : "");
  }
  out << "recommended for a tolerance of\n";
  for (const CostAdvice& advice : study.advice) out << "  " << advice.text << "\n";
}

CommandSyntax cost_syntax() {
  CommandSyntax syntax{"viscard cost SCENE.toml [OPTIONS]",
                       "Shows what accuracy costs: error against time, memory and unknowns over "
                       "discretisations and effects, and the cheapest for each tolerance.",
                       "viscard cost data/scenes/pillar_modal.toml --budget 20s"};
  syntax.options.add_options()("budget", po::value<std::string>()->default_value("60s"),
                               "time to spend, such as 60s or 5min")(
      "out", po::value<std::string>(), "folder for cost.csv, cost.json and cost.svg")(
      "force", "overwrite existing files");
  syntax.positional = {"scene"};
  return syntax;
}

}  // namespace

int run_cost(const Words& words, Streams& streams) {
  CommandSyntax syntax = cost_syntax();
  const auto values = parse_words(syntax, words, streams);
  if (!values) return kDone;
  const auto path = required(*values, "scene", syntax);
  CostOptions options{.budget_s = *given_quantity(*values, "budget", "s")};
  if (!(options.budget_s > 0.0)) throw UsageError("--budget must be positive, such as 60s");
  const Scene scene = read_scene(path).scene;
  CostStudy study;
  {
    Progress progress(streams, "cost");
    options.progress = [&](double done, const std::string& name) { progress.show(done, name); };
    study = with_lines_of(path, [&] { return study_cost(scene, options); });
  }
  const nlohmann::json object = json_from_study(study);
  if (const auto out = given(*values, "out")) {
    const std::filesystem::path folder = *out;
    const bool overwrite = values->count("force") > 0;
    const std::string command = quoted_command_line("cost", words);
    std::filesystem::create_directories(folder);
    write_file(folder / "cost.csv", csv_from_study(study, command), overwrite);
    write_file(folder / "cost.json", object.dump(2) + "\n", overwrite);
    const std::string name = std::filesystem::path(path).filename().string();
    write_file(folder / "cost.svg", svg_from_plot(plot_from_study(study, name), "cost"), overwrite);
  }
  if (!print_json(*values, object, streams)) print_study(study, path, streams.out);
  return kDone;
}

}  // namespace viscard
