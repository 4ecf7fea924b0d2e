#include "io/cli/scene/answer_output.h"

#include "io/basics/atomic_file.h"
#include "io/basics/inputs.h"
#include "io/basics/json_string.h"
#include "io/cli/scene/answer_pictures.h"
#include "io/cli/scene/map_output.h"
#include "io/cli/words/json_output.h"
#include "models/answer/effect_estimate.h"
#include "models/maths/text_of_number.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>

namespace viscard {

void show_keys(ResultVisitor& v, const ShownAnswer& shown) {
  const SceneAnswer& answer = shown.answer;
  show_solution(v, answer);
  show_tolerance(v, answer, shown.tolerance);
  v("compared", shown.compared, "with --compare: beside the answer of another scene");
  show_notes(v, answer);
  v.when(!shown.printed.empty(), [&] {
    v.list("printed", "beside the values that the scene quotes", shown.printed,
           [&](const PrintedComparison& row) { show_keys(v, row); });
  });
  show_results(v, answer);
  v("uncertainty", shown.uncertainty,
    "with --uncertainty: what the uncertain inputs do to the results");
  v("unknowns", answer.unknowns, "of the mesh");
  v("wall_s", shown.wall_s, "time that it took");
  show_origin(v, shown.command);
}

void print_answer(const SceneAnswer& answer, double wall_s, std::ostream& out) {
  for (const SceneResult& r : answer.results) {
    out << fmt::format("  {:<28} {:>14.7g} {:<4} +- {:.1e}\n", r.name, r.value, r.unit,
                       r.error_estimate);
  }
  for (const SceneMode& m : answer.modes) {
    out << fmt::format("  {:<13} m = {}  {:>14.2f} Hz +- {:.1e}", m.family, m.harmonic,
                       m.frequency_Hz, m.error_estimate);
    if (m.damping_ratio) {
      out << fmt::format(", damping ratio {:.3g} +- {:.1e}", *m.damping_ratio, m.damping_error);
    }
    out << "\n";
  }
  for (const std::string& note : answer.notes) out << "  note: " << note << "\n";
  out << fmt::format("  effects on: ");
  bool first = true;
  for (const SceneEffect& e : answer.effects) {
    if (!e.on) continue;
    out << (first ? "" : ", ") << e.name;
    first = false;
  }
  out << (first ? "none" : "")
      << fmt::format("\n  degree {}, {} at the rim, {}, {:.3g} s\n", answer.discretisation.degree,
                     counted(static_cast<std::size_t>(answer.discretisation.layers), "layer"),
                     counted(static_cast<std::size_t>(answer.unknowns), "unknown"), wall_s);
}

namespace {

std::string csv_of(const SceneCurve& curve, const std::string& command) {
  const std::string column = curve.unit == "1" ? curve.name : curve.name + "_" + curve.unit;
  const bool has_error = curve.error.size() == curve.x.size();
  std::string text = fmt::format("{}{},{}{}\n", head_of_table(command), curve.x_name, column,
                                 has_error ? ",error_" + column : "");
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    text += fmt::format("{},{}", curve.x[i], curve.value[i]);
    if (has_error) text += fmt::format(",{:.3g}", curve.error[i]);
    text += "\n";
  }
  return text;
}

std::string csv_of_results(const std::vector<SceneResult>& results, const std::string& command) {
  std::string text = fmt::format("{}result,value,unit,error\n", head_of_table(command));
  for (const SceneResult& r : results) {
    const bool is_quoted = r.name.find(',') != std::string::npos;  // of a sweep: "at d, s"
    text += fmt::format("{0}{1}{0},{2:.9g},{3},{4:.3g}\n", is_quoted ? "\"" : "", r.name, r.value,
                        r.unit, r.error_estimate);
  }
  return text;
}

std::string csv_of_modes(const std::vector<SceneMode>& modes, const std::string& command) {
  const bool is_damped = std::any_of(
      modes.begin(), modes.end(), [](const SceneMode& m) { return m.damping_ratio.has_value(); });
  std::string text =
      fmt::format("{}family,harmonic,frequency_Hz,error_Hz{}\n", head_of_table(command),
                  is_damped ? ",damping_ratio,damping_error" : "");
  for (const SceneMode& m : modes) {
    text +=
        fmt::format("{},{},{:.9g},{:.3g}", m.family, m.harmonic, m.frequency_Hz, m.error_estimate);
    if (is_damped)
      text += fmt::format(",{:.9g},{:.3g}", m.damping_ratio.value_or(0.0), m.damping_error);
    text += "\n";
  }
  return text;
}

}  // namespace

std::string csv_of_shapes(const RowShapes& shapes, const std::vector<SceneMode>& modes,
                          const std::string& command) {
  std::string text = fmt::format(
      "{}# motion: mean of the top, sideways along x or up along z; the largest "
      "of "
      "a mode is 1\nfamily,mode,frequency_Hz,pillar,motion\n",
      head_of_table(command));
  std::map<std::string, int> number;
  for (std::size_t i = 0; i < std::min(shapes.modes.size(), modes.size()); ++i) {
    const RowShape& shape = shapes.modes[i];
    const int mode = ++number[shape.family];
    for (Eigen::Index pillar = 0; pillar < shape.top.size(); ++pillar) {
      text += fmt::format("{},{},{:.9g},{},{:.6g}\n", shape.family, mode, modes[i].frequency_Hz,
                          pillar + 1, shape.top[pillar]);
    }
  }
  return text;
}

void write_pictures(const std::vector<std::pair<std::string, std::string>>& pictures,
                    const std::string& folder, bool overwrite) {
  for (const auto& [name, svg] : pictures) {
    write_file(std::filesystem::path(folder) / (name + ".svg"), svg, overwrite);
  }
}

void write_files(const ShownAnswer& shown, const std::string& folder, bool overwrite) {
  const SceneAnswer& answer = shown.answer;
  const std::string& command = shown.command;
  std::filesystem::create_directories(folder);
  const auto write = [&](const std::string& name, const std::string& text) {
    write_file(std::filesystem::path(folder) / name, text, overwrite);
  };
  const auto object = with_head({"viscard-simulate/1", {shown.scene}, shown.accepts_implausible},
                                [&](ResultVisitor& v) { show_keys(v, shown); });
  write("results.json", text_from_json(object, 2) + "\n");
  if (!answer.results.empty()) write("results.csv", csv_of_results(answer.results, command));
  if (shown.compared) write("compared.csv", csv_of_compared(*shown.compared, command));
  if (!answer.modes.empty()) write("modes.csv", csv_of_modes(answer.modes, command));
  for (const SceneCurve& curve : answer.curves) write(curve.name + ".csv", csv_of(curve, command));
  write_pictures(pictures_of(answer), folder, overwrite);
  write_maps(answer, folder, command, overwrite);
  write_pictures(pictures_of_maps(answer), folder, overwrite);
}

}  // namespace viscard
