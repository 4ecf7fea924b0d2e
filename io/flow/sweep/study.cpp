#include "io/flow/sweep/study.h"

#include "io/basics/atomic_file.h"
#include "io/basics/number_text.h"
#include "io/basics/words.h"
#include "io/config/config_fields.h"
#include "io/config/toml_text.h"
#include "io/scenes/scene_file.h"
#include "models/maths/failure_text.h"
#include "models/maths/text_of_number.h"
#include "models/uncertainty/sobol_points.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <optional>
#include <set>
#include <sstream>
#include <stdexcept>
#include <tuple>

namespace viscard {
namespace {

constexpr double kMostPoints = 1e7;

// "40 um" as number and unit.
struct NumberAndUnit {
  double number = 0.0;
  std::string unit;
};

std::optional<NumberAndUnit> split(const std::string& text) {
  const std::string_view all = trimmed(text);
  NumberAndUnit out;
  const auto [end, error] = std::from_chars(all.data(), all.data() + all.size(), out.number);
  if (error != std::errc() || !std::isfinite(out.number)) return std::nullopt;
  out.unit = std::string(trimmed({end, static_cast<std::size_t>(all.data() + all.size() - end)}));
  return out;
}

std::string joined(double number, const std::string& unit) {
  return text_from_number(number) + (unit.empty() ? "" : " " + unit);
}

[[noreturn]] void refuse(const Study& study, const StudyParameter& parameter,
                         const std::string& why) {
  throw std::runtime_error(study.path.string() + ": parameter '" + parameter.key + "' " + why);
}

// The value at a share of the range, 0 to 1.
std::string value_in_range(const StudyParameter& parameter, double share) {
  const NumberAndUnit from = *split(parameter.from), to = *split(parameter.to);
  const double number = parameter.spacing == "log"
                            ? from.number * std::pow(to.number / from.number, share)
                            : from.number + share * (to.number - from.number);
  return joined(number, from.unit);
}

void check_range(const Study& study, const StudyParameter& parameter) {
  const auto from = split(parameter.from), to = split(parameter.to);
  if (!from || !to || from->unit != to->unit) {
    refuse(
        study, parameter,
        "needs values = [...], or from and to with the same unit, such as from = \"30 um\", to = "
        "\"50 um\"");
  }
  if (parameter.spacing != "linear" && parameter.spacing != "log") {
    refuse(study, parameter, "has a spacing that is neither \"linear\" nor \"log\"");
  }
  if (parameter.spacing == "log" && !(from->number * to->number > 0.0)) {
    refuse(study, parameter, "has a range with 0, which has no spacing \"log\"");
  }
  if (study.n_points == 0 && parameter.count < 2) {
    refuse(study, parameter, "needs a count of at least 2 in a grid");
  }
}

// A table of points: every parameter has one value for each.
void check_rows(const Study& study) {
  if (study.n_points > 0) {
    throw std::runtime_error(study.path.string() + ": points and rows exclude each other");
  }
  const std::size_t n = study.parameters.front().values.size();
  for (const StudyParameter& parameter : study.parameters) {
    if (parameter.values.empty()) refuse(study, parameter, "needs values = [...] with rows = true");
    if (parameter.values.size() == n) continue;
    refuse(
        study, parameter,
        fmt::format("has {} values and '{}' has {}; with rows = true all have one for each point",
                    parameter.values.size(), study.parameters.front().key, n));
  }
}

void check(const Study& study) {
  if (study.parameters.empty()) {
    throw std::runtime_error(study.path.string() + ": there is no [[parameter]]");
  }
  std::set<std::string> keys;
  for (const StudyParameter& parameter : study.parameters) {
    if (!keys.insert(parameter.key).second) refuse(study, parameter, "is given twice");
    if (parameter.values.empty()) check_range(study, parameter);
  }
  if (study.is_rows) check_rows(study);
  double points = 1.0;
  for (const StudyParameter& parameter : study.parameters) {
    points *= static_cast<double>(parameter.values.empty() ? parameter.count
                                                           : std::ssize(parameter.values));
  }
  if (study.n_points == 0 && !study.is_rows && points > kMostPoints) {
    throw std::runtime_error(
        fmt::format("{}: combines {:.6g} points; at most {:.6g} are answered in one study. Give "
                    "fewer values, or points = N for a Sobol' sequence",
                    study.path.string(), points, kMostPoints));
  }
}

std::string value_at(const StudyParameter& parameter, std::int64_t index) {
  if (!parameter.values.empty()) return parameter.values[static_cast<std::size_t>(index)];
  return value_in_range(parameter,
                        static_cast<double>(index) / static_cast<double>(parameter.count - 1));
}

std::int64_t size_of(const StudyParameter& parameter) {
  return parameter.values.empty() ? parameter.count : std::ssize(parameter.values);
}

// The place of an entry that a part of a key names, "2" the second; nothing if the list has no such entry.
std::optional<std::size_t> entry_of(const toml::array& list, const std::string& part) {
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), number);
  if (error != std::errc() || end != part.data() + part.size()) return {};
  if (number < 1 || number > list.size()) return {};
  return number - 1;
}

template <typename Value>
void put(toml::node& in, const std::string& part, const Value& value, const std::string& key) {
  if (toml::table* const table = in.as_table()) {
    table->insert_or_assign(part, value);
    return;
  }
  toml::array& list = *in.as_array();
  const auto entry = entry_of(list, part);
  if (!entry) {
    throw std::runtime_error("the parameter '" + key + "' names entry " + part +
                             " of a list that has " + std::to_string(list.size()) +
                             " in the scene; entries are counted from 1");
  }
  list.replace(list.cbegin() + static_cast<std::ptrdiff_t>(*entry), value);
}

// "; did you mean 'geometry.diameter'?" if scenes of this kind have no such key.
std::string meant_key(const std::string& scene, const std::filesystem::path& path,
                      const std::string& key) {
  try {
    std::vector<std::string> known;
    for (const FieldKey& one : keys_of(scene_from_toml(scene, path, {}, Plausible::kOff))) {
      known.push_back(one.key);
    }
    const bool is_known = std::find(known.begin(), known.end(), key) != known.end();
    return is_known ? "; give it in the scene, too" : did_you_mean(key, known);
  } catch (const std::exception& error) {
    if (is_passing(error)) throw;
    // The scene alone cannot be read.
    return "; give it in the scene, too";
  }
}

// A value in TOML: a number, or a text.
std::string toml_value(const std::string& value) {
  std::ostringstream text;
  const auto number = split(value);
  if (number && number->unit.empty()) {
    text << toml::value<double>(number->number);
  } else {
    text << toml::value<std::string>(value);
  }
  return text.str();
}

// The value at a key, if the scene has it.
const toml::node* value_of_key(const toml::table& root, const std::string& key) {
  const toml::node* node = &root;
  std::istringstream parts(key);
  for (std::string part; node != nullptr && std::getline(parts, part, '.');) {
    if (const toml::table* const table = node->as_table()) {
      node = table->get(part);
    } else if (const toml::array* const list = node->as_array()) {
      const auto entry = entry_of(*list, part);
      node = entry ? list->get(*entry) : nullptr;
    } else {
      return nullptr;
    }
  }
  return node != nullptr && node->is_value() ? node : nullptr;
}

// Where a position of toml++, which counts characters, lies in a text.
std::size_t offset_of(const std::string& text, const toml::source_position& position) {
  std::size_t offset = text.starts_with("\xEF\xBB\xBF") ? 3 : 0;  // a byte-order mark
  for (toml::source_index line = 1; line < position.line; ++line) {
    offset = text.find('\n', offset) + 1;
  }
  for (toml::source_index column = 1; column < position.column; ++column) {
    do {
      ++offset;
    } while (offset < text.size() && (static_cast<unsigned char>(text[offset]) & 0xC0U) == 0x80U);
  }
  return offset;
}

// The scene with other values in their places, so that lines keep their numbers; nothing if it lacks
// one of the keys.
std::optional<std::string> with_values_in_place(const std::string& scene, const toml::table& table,
                                                const StudyValues& values) {
  struct Place {
    std::size_t begin, end;
    std::string text;
  };
  std::vector<Place> places;
  for (const auto& [key, value] : values) {
    const toml::node* const node = value_of_key(table, key);
    if (node == nullptr) return std::nullopt;
    places.push_back({offset_of(scene, node->source().begin), offset_of(scene, node->source().end),
                      toml_value(value)});
  }
  std::sort(places.begin(), places.end(),
            [](const Place& a, const Place& b) { return a.begin > b.begin; });
  std::string text = scene;
  for (const Place& place : places) text.replace(place.begin, place.end - place.begin, place.text);
  return text;
}

// Sets a key such as "geometry.film.thickness", or an entry of a list, such as "shape.at.2" and
// "analysis.history.1.2".
void set_key(toml::table& root, const std::string& key, const std::string& value,
             const std::function<std::string()>& what_next) {
  toml::node* node = &root;
  std::size_t begin = 0;
  for (std::size_t dot = key.find('.'); dot != std::string::npos; dot = key.find('.', begin)) {
    const std::string section = key.substr(begin, dot - begin);
    toml::node* inner = nullptr;
    if (toml::table* const table = node->as_table()) {
      inner = table->get(section);
    } else if (const auto entry = entry_of(*node->as_array(), section)) {
      inner = node->as_array()->get(*entry);
    }
    if (inner == nullptr || !(inner->is_table() || inner->is_array())) {
      throw std::runtime_error("the scene has no section or list '" + key.substr(0, dot) +
                               "' for the parameter '" + key + "'" + what_next());
    }
    node = inner;
    begin = dot + 1;
  }
  const auto number = split(value);
  if (number && number->unit.empty()) {
    put(*node, key.substr(begin), number->number, key);
  } else {
    put(*node, key.substr(begin), value, key);
  }
}

// Reads the scene at the first point and at every value beside it, or at every row. What is wrong
// with the scene is reported by check_values(); a file that only several values name together is
// refused at its points.
void record_scene_files(const Study& study) {
  const auto read = [&](const StudyValues& values) {
    try {
      scene_from_toml(scene_text_with(study, values), study.scene_path, {}, Plausible::kOff);
    } catch (const std::exception& error) {
      if (is_passing(error)) throw;
    }
  };
  const StudyValues first = values_at(study, 0);
  read(first);
  // Of rows, those that differ in what may name a file.
  std::set<std::string> known;
  for (std::int64_t row = 1; study.is_rows && row < count_points(study); ++row) {
    const StudyValues values = values_at(study, row);
    std::string names;
    for (const auto& [key, value] : values) {
      if (key.ends_with("file") || key.ends_with("material") || !split(value)) {
        names += value + "\n";
      }
    }
    if (known.insert(names).second) read(values);
  }
  for (std::size_t k = 0; !study.is_rows && k < study.parameters.size(); ++k) {
    for (const std::string& value : study.parameters[k].values) {
      StudyValues values = first;
      values[k].second = value;
      read(values);
    }
  }
}

// Named relative to the study, in one order, so that all machines agree however the study was
// named.
std::vector<InputFile> named_inputs(const Study& study, const InputRecorder& recorder) {
  std::vector<InputFile> inputs;
  for (const InputFile& file : recorder.files()) {
    inputs.push_back({input_name(study, file.path), file.sha256, file.note});
  }
  std::sort(inputs.begin(), inputs.end(), [](const InputFile& a, const InputFile& b) {
    return std::tie(a.path, a.sha256) < std::tie(b.path, b.sha256);
  });
  return inputs;
}

}  // namespace

Study read_study(const std::filesystem::path& path) {
  const InputRecorder recorder(InputRecorder::Of::kPart);
  Study study{.path = path};
  std::string scene;
  const std::string text = read_file(path);
  const auto show = [&](FieldVisitor& v) {
    v.text({"scene", "pillar_sensor.toml", true}, scene);
    v.integer("points", 1, static_cast<std::int64_t>(kMostPoints), study.n_points);
    v.boolean("rows", study.is_rows);
    v.list(
        "parameter", study.parameters.size(), [&](std::size_t n) { study.parameters.resize(n); },
        [&](FieldVisitor& p, std::size_t i) {
          StudyParameter& parameter = study.parameters[i];
          p.text({"key", "geometry.diameter", true}, parameter.key);
          p.texts({"values", "40 um"}, parameter.values);
          p.text({"from", "30 um"}, parameter.from);
          p.text({"to", "50 um"}, parameter.to);
          p.integer("count", 2, static_cast<std::int64_t>(kMostPoints), parameter.count);
          p.text({"spacing", "log"}, parameter.spacing);
        });
  };
  read_as(FileKind::kStudy, text, path.string(),
          [&] { read_toml_fields(text, path.string(), show); });
  study.scene_path = path_at_key(text, path, "scene", scene, FileKind::kScene);
  study.scene_text = read_file(study.scene_path);
  check(study);
  if (study.n_points > 0) {
    const Eigen::MatrixXd points =
        sobol_points(study.n_points, static_cast<Eigen::Index>(study.parameters.size()));
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
      study.sobol.emplace_back(points.row(i).begin(), points.row(i).end());
    }
  }
  record_scene_files(study);
  study.inputs = named_inputs(study, recorder);
  return study;
}

Study study_of_scene(const std::filesystem::path& scene, const std::string& besides) {
  const InputRecorder recorder(InputRecorder::Of::kPart);
  Study study{.path = scene, .scene_path = scene, .besides = besides};
  study.scene_text = read_file(scene);
  scene_from_toml(study.scene_text, scene, {}, Plausible::kOff);
  study.inputs = named_inputs(study, recorder);
  return study;
}

std::int64_t count_points(const Study& study) {
  if (study.n_points > 0) return study.n_points;
  if (study.is_rows) return std::ssize(study.parameters.front().values);
  std::int64_t count = 1;
  for (const StudyParameter& parameter : study.parameters) count *= size_of(parameter);
  return count;
}

StudyValues values_at(const Study& study, std::int64_t point) {
  StudyValues values(study.parameters.size());
  for (std::size_t k = study.parameters.size(); k-- > 0;) {
    const StudyParameter& parameter = study.parameters[k];
    values[k].first = parameter.key;
    if (study.is_rows) {
      values[k].second = value_at(parameter, point);
      continue;
    }
    if (study.n_points == 0) {
      values[k].second = value_at(parameter, point % size_of(parameter));
      point /= size_of(parameter);
      continue;
    }
    const double share = study.sobol[static_cast<std::size_t>(point)][k];
    if (parameter.values.empty()) {
      values[k].second = value_in_range(parameter, share);
    } else {
      const auto n = static_cast<double>(parameter.values.size());
      values[k].second = parameter.values[static_cast<std::size_t>(share * n)];
    }
  }
  return values;
}

std::string scene_text_with(const Study& study, const StudyValues& values) {
  return scene_text_with(study.scene_text, study.scene_path, values);
}

std::string scene_text_with(const std::string& scene, const std::filesystem::path& path,
                            const StudyValues& values) {
  toml::table table = table_from_toml(scene, path.string());
  if (auto text = with_values_in_place(scene, table, values)) return *text;
  for (const auto& [key, value] : values) {
    set_key(table, key, value, [&, &name = key] { return meant_key(scene, path, name); });
  }
  std::ostringstream text;
  text << table << "\n";
  return text.str();
}

std::string input_name(const Study& study, const std::filesystem::path& file) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path folder = fs::weakly_canonical(study.path, error).parent_path();
  const fs::path full = fs::weakly_canonical(file, error);
  const fs::path name = full.lexically_relative(folder);
  return name.empty() ? file.string() : name.string();
}

std::string fingerprint_with_inputs(const Study& study) {
  std::string text;
  for (const InputFile& file : study.inputs) text += file.sha256 + "\n";
  return fingerprint(study) + " inputs " + sha256_of_text(text);
}

std::string fingerprint(const Study& study) {
  const auto sum_of = [&](const std::filesystem::path& file) {
    const std::string name = input_name(study, file);
    for (const InputFile& one : study.inputs) {
      if (one.path == name)
        return one.sha256;  // of what was read, even if the file has changed since
    }
    return sha256_of_file(file);
  };
  return "viscard " VISCARD_VERSION " study " + sum_of(study.path) + " scene " +
         sum_of(study.scene_path) + (study.besides.empty() ? "" : " " + study.besides);
}

}  // namespace viscard
