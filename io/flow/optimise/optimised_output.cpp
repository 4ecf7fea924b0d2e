#include "io/flow/optimise/optimised_output.h"

#include "io/basics/written_path.h"
#include "io/config/toml_text.h"
#include "io/flow/design/judgement_output.h"
#include "io/flow/optimise/design_choices.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <functional>
#include <map>
#include <sstream>
#include <string_view>

namespace viscard {
namespace {

std::string list_of(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

void show_lines(ResultVisitor& v, const OptimisedDesign& design) {
  std::size_t k = 0;
  v.list(
      "lines", "the requirements, as in viscard-design-judge/1", design.judgement.lines,
      [&](const JudgedLine& line) {
        show_line(v, line, [&] {
          v("probability",
            number_or_null(k < design.probabilities.size() ? std::optional(design.probabilities[k])
                                                           : std::nullopt),
            "that it holds under the uncertainties of the scene; null: not asked");
        });
        ++k;
      });
}

void for_each_text(toml::node& node, const std::function<void(std::string&)>& take) {
  if (toml::table* const table = node.as_table()) {
    for (auto&& [key, inner] : *table) for_each_text(inner, take);
  } else if (toml::array* const list = node.as_array()) {
    for (toml::node& inner : *list) for_each_text(inner, take);
  } else if (auto* const text = node.as_string()) {
    take(text->get());
  }
}

// The name of a file as it leads there from `folder`.
std::string seen_from(const std::filesystem::path& folder, const std::string& name,
                      const std::filesystem::path& scene_folder) {
  if (std::filesystem::path(name).is_absolute()) return name;
  const std::filesystem::path there =
      std::filesystem::weakly_canonical(std::filesystem::absolute(scene_folder / name));
  const std::filesystem::path here =
      std::filesystem::weakly_canonical(std::filesystem::absolute(folder.empty() ? "." : folder));
  return there.lexically_relative(here).string();
}

bool names_file(std::string_view key) {
  return key == "file" || key == "positions";
}

// Takes the folders out of all texts of a scene in `folder` that are names of files (--strip-paths); returns whether
// there were any. The files of other choices count, so that two designs do not give two files one name.
bool strip_folders(toml::table& scene, const DesignSpec& spec,
                   const std::filesystem::path& folder) {
  std::vector<std::string> all;
  for (const DesignChoice& choice : spec.choices) {
    const bool is_file = names_file(choice.key.substr(choice.key.rfind('.') + 1));
    for (const std::string& value : choice.values)
      all.push_back(is_file ? seen_from(folder, value, spec.scene_path.parent_path()) : value);
  }
  for_each_text(scene, [&](std::string& text) { all.push_back(text); });
  const WrittenValues written(all, folder);
  bool is_changed = false;
  for_each_text(scene, [&](std::string& text) {
    const std::string as_read = text;
    text = written(as_read);
    is_changed |= text != as_read;
  });
  return is_changed;
}

// As it stands, unless it names files in folders that are not to be written.
std::string scene_as_written(const DesignSpec& spec, const std::string& scene_text) {
  if (scene_text.empty()) return scene_text;
  toml::table scene = parsed_toml(scene_text);
  if (!strip_folders(scene, spec, spec.scene_path.parent_path())) return scene_text;
  std::ostringstream text;
  text << scene << "\n";
  return text.str();
}

void show_design(ResultVisitor& v, const DesignSpec& spec, const OptimisedDesign& design) {
  v("active", design.active, "limits and ends of ranges that hold it, or that stop every design");
  v("feasible", design.is_feasible, "whether all lines pass, with the probability that was asked");
  show_lines(v, design);
  v.list("objectives", "at this design", design.objectives, [&](const DesignedObjective& one) {
    v("error_estimate", one.error_estimate, "absolute");
    v("quantity", one.quantity, "its name");
    v("unit", one.unit, "of both");
    v("value", one.value, "of the design");
  });
  v("scene", scene_as_written(spec, design.scene_text),
    "the scene file, for the folder of the specification's scene");
  const std::map<std::string, std::string> values(design.values.begin(), design.values.end());
  const std::vector<std::pair<std::string, std::string>> sorted(values.begin(), values.end());
  const WrittenValues written = written_choices(spec);
  v.map("values", "of the ranges, by key", sorted,
        [&](const auto& value) { v(value.first, written(value.second), "value with its unit"); });
}

void point_from(toml::table& table, const std::filesystem::path& scene_folder,
                const std::filesystem::path& folder) {
  for (auto&& [key, node] : table) {
    if (toml::table* const inner = node.as_table()) point_from(*inner, scene_folder, folder);
    if (!names_file(key.str())) continue;
    if (const auto name = node.value<std::string>())
      node.ref<std::string>() = seen_from(folder, *name, scene_folder);
  }
}

}  // namespace

std::string text_from_front(const DesignSpec& spec, const DesignFront& front) {
  const WrittenValues written = written_choices(spec);
  std::string text;
  for (std::size_t i = 0; i < front.designs.size(); ++i) {
    const OptimisedDesign& design = front.designs[i];
    text += front.designs.size() > 1 ? fmt::format("design {}\n", i + 1) : "";
    text += design.is_feasible
                ? "  confirmed by the solver\n"
                : "  INFEASIBLE: no design within the ranges keeps all limits; nearest:\n";
    for (const auto& [key, value] : design.values)
      text += fmt::format("  {:<32} {}\n", key, written(value));
    for (const DesignedObjective& one : design.objectives) {
      text += fmt::format("  {:<32} {:.5g} +- {:.1g} {}\n", one.quantity, one.value,
                          one.error_estimate, one.unit == "1" ? "" : one.unit);
    }
    text += text_from_judgement(design.judgement);
    for (std::size_t k = 0; k < design.probabilities.size(); ++k) {
      text += fmt::format("  {:<32} holds with probability {:.3g}\n",
                          design.judgement.lines[k].kind->key, design.probabilities[k]);
    }
    const std::string held = design.active.empty() ? "nothing" : list_of(design.active);
    text += (design.is_feasible ? "  held by: " : "  stopped by: ") + held + "\n";
  }
  return text + fmt::format("  {} quantities solved\n", front.n_solved);
}

void show_front(ResultVisitor& v, const DesignSpec& spec, const DesignFront& front) {
  v.list("designs", "best in the first objective first; if none is feasible, the nearest",
         front.designs, [&](const OptimisedDesign& design) { show_design(v, spec, design); });
  v("feasible", !front.designs.empty() && front.designs[0].is_feasible,
    "whether there is a design");
  v.list("objectives", "what was sought", spec.objectives, [&](const DesignObjective& one) {
    v.word("goal", one.goal, {"largest", "smallest"}, "which way");
    v("quantity", one.quantity, "its name");
  });
  v("quantities_solved", front.n_solved, "the work");
  v("seed", spec.seed, "of the search");
}

std::string csv_from_front(const DesignSpec& spec, const DesignFront& front) {
  std::string text;
  for (const DesignChoice& choice : spec.choices) text += choice.key + ",";
  for (const DesignRange& range : spec.ranges) text += range.key + ",";
  for (const DesignedObjective& one : front.designs[0].objectives) {
    text +=
        one.quantity + " [" + (one.unit.empty() ? "1" : one.unit) + "]," + one.quantity + " error,";
  }
  for (const JudgedLine& line : front.designs[0].judgement.lines) {
    text += std::string(line.kind->key) + " margin,";
  }
  text.back() = '\n';
  const WrittenValues written = written_choices(spec);
  for (const OptimisedDesign& design : front.designs) {
    for (const auto& [key, value] : design.values) text += written(value) + ",";
    for (const DesignedObjective& one : design.objectives) {
      text += fmt::format("{:.9g},{:.3g},", one.value, one.error_estimate);
    }
    for (const JudgedLine& line : design.judgement.lines)
      text += fmt::format("{:.6g},", line.margin);
    text.back() = '\n';
  }
  return text;
}

std::string scene_for_folder(const DesignSpec& spec, const OptimisedDesign& design,
                             const std::filesystem::path& folder) {
  toml::table scene = parsed_toml(design.scene_text);
  point_from(scene, spec.scene_path.parent_path(), folder);
  std::ostringstream text;
  text << "# A design of viscard, from " << spec.path.filename().string() << "\n";
  if (strip_folders(scene, spec, folder)) {
    text
        << "# Written with --strip-paths: copy the files that it names beside it before it runs.\n";
  }
  text << scene << "\n";
  return text.str();
}

}  // namespace viscard
