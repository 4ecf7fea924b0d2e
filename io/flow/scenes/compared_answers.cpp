#include "io/flow/scenes/compared_answers.h"

#include "io/flow/scenes/answer_scene.h"
#include "io/flow/scenes/named_values.h"
#include "models/maths/result_visitor.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>

namespace viscard {
namespace {

template <typename List>
const typename List::value_type* with_name(const List& list, const std::string& name) {
  const auto at =
      std::find_if(list.begin(), list.end(), [&](const auto& one) { return one.name == name; });
  return at == list.end() ? nullptr : &*at;
}

ComparedValue compared(const NamedValue& here, const NamedValue& other) {
  ComparedValue out{.name = here.name,
                    .unit = here.unit,
                    .value = here.value,
                    .other = other.value,
                    .error = here.error_estimate,
                    .other_error = other.error_estimate,
                    .ratio = std::nullopt};
  if (!(std::abs(other.value) > other.error_estimate)) return out;
  out.ratio = here.value / other.value;
  // To first order, both errors at their worst.
  out.ratio_error =
      (here.error_estimate + std::abs(*out.ratio) * other.error_estimate) / std::abs(other.value);
  return out;
}

// Readings of numbered electrodes, "centre_voltage_3", at these places.
VoltageProfile numbered(const std::string& name, const SceneAnswer& answer,
                        const std::vector<std::pair<double, double>>& places_m) {
  VoltageProfile profile{.name = name, .x_m = {}, .value_V = {}, .error_V = {}};
  for (std::size_t i = 0; i < places_m.size(); ++i) {
    const SceneResult* result = with_name(answer.results, name + "_" + std::to_string(i + 1));
    if (result == nullptr || result->unit != "V" || places_m[i].second != 0.0) continue;
    profile.x_m.push_back(places_m[i].first);
    profile.value_V.push_back(result->value);
    profile.error_V.push_back(result->error_estimate);
  }
  return profile;
}

// The middle row of a map; of an even number of rows the one behind the middle.
VoltageProfile middle_row(const SceneMap& map, const SceneArray& array) {
  VoltageProfile profile{.name = map.name, .x_m = {}, .value_V = {}, .error_V = {}};
  for (std::size_t i = 0; i < map.pillar.size(); ++i) {
    const ScenePillar& pillar = array.pillars[map.pillar[i]];
    if (pillar.row != array.rows / 2 + 1) continue;
    profile.x_m.push_back(pillar.x_m);
    profile.value_V.push_back(map.value[i]);
    profile.error_V.push_back(map.error.empty() ? 0.0 : map.error[i]);
  }
  return profile;
}

std::vector<std::string> stems_of_first_electrode(const SceneAnswer& answer) {
  std::vector<std::string> stems;
  for (const SceneResult& result : answer.results) {
    if (result.unit == "V" && result.name.ends_with("_voltage_1"))
      stems.push_back(result.name.substr(0, result.name.size() - 2));
  }
  return stems;
}

double smallest_distance_m(std::vector<double> x_m) {
  std::sort(x_m.begin(), x_m.end());
  double smallest = HUGE_VAL;
  for (std::size_t i = 1; i < x_m.size(); ++i) smallest = std::min(smallest, x_m[i] - x_m[i - 1]);
  return smallest;
}

std::optional<double> contrast(const VoltageProfile& profile, double pitch_m) {
  double difference = -1.0, largest = 0.0;
  for (std::size_t i = 0; i < profile.x_m.size(); ++i) {
    largest = std::max(largest, std::abs(profile.value_V[i]));
    for (std::size_t k = 0; k < i; ++k) {
      const double distance = std::abs(profile.x_m[i] - profile.x_m[k]);
      if (std::abs(distance - pitch_m) > 1e-6 * pitch_m) continue;
      difference = std::max(difference, std::abs(profile.value_V[i] - profile.value_V[k]));
    }
  }
  if (difference < 0.0 || largest == 0.0) return std::nullopt;
  return difference / largest;
}

bool is_same_place(double x_m, double other_m, double pitch_m) {
  return std::abs(x_m - other_m) < 1e-6 * pitch_m;
}

bool has_same_places(const ComparedProfile& profile) {
  const auto is_same = [&](double x_m, double other_m) {
    return is_same_place(x_m, other_m, profile.pitch_m);
  };
  return std::equal(profile.here.x_m.begin(), profile.here.x_m.end(), profile.other.x_m.begin(),
                    profile.other.x_m.end(), is_same);
}

// The voltages of electrodes at the same places; those of electrodes with the same number lie elsewhere.
void add_same_places(const ComparedProfile& profile, std::vector<ComparedValue>& values) {
  std::erase_if(values, [&](const ComparedValue& value) {
    const std::string stem = profile.here.name + "_";
    return value.name.starts_with(stem) &&
           value.name.find_first_not_of("0123456789", stem.size()) == std::string::npos;
  });
  const VoltageProfile &here = profile.here, &other = profile.other;
  for (std::size_t i = 0; i < here.x_m.size(); ++i) {
    for (std::size_t k = 0; k < other.x_m.size(); ++k) {
      if (!is_same_place(here.x_m[i], other.x_m[k], profile.pitch_m)) continue;
      const std::string name = here.name + " at " + text_of(here.x_m[i] * 1e6, 6) + " um";
      values.push_back(compared({name, here.value_V[i], "V", here.error_V[i]},
                                {name, other.value_V[k], "V", other.error_V[k]}));
    }
  }
}

}  // namespace

std::vector<VoltageProfile> voltage_profiles(const Scene& scene, const SceneAnswer& answer) {
  std::vector<VoltageProfile> profiles;
  if (const auto* row = std::get_if<ArrayScene>(&scene)) {
    const double pitch_m = row->geometry.diameter_m + row->geometry.spacing_m;
    std::vector<std::pair<double, double>> places_m;
    for (int i = 0; i < row->geometry.count; ++i)
      places_m.emplace_back((i - 0.5 * (row->geometry.count - 1)) * pitch_m, 0.0);
    for (const std::string& name : stems_of_first_electrode(answer))
      profiles.push_back(numbered(name, answer, places_m));
  } else if (const auto* layer = std::get_if<LayerScene>(&scene)) {
    for (const std::string& name : voltage_names(layer->electrode))
      profiles.push_back(numbered(name, answer, layer->electrodes_m));
  } else {
    for (const SceneMap& map : answer.maps) {
      if (map.unit == "V") profiles.push_back(middle_row(map, answer.array));
    }
  }
  std::erase_if(profiles, [](const VoltageProfile& one) { return one.x_m.size() < 2; });
  return profiles;
}

std::optional<OtherScene> other_scene(const std::optional<std::string>& named,
                                      const SceneFile& file, const std::string& path,
                                      std::optional<double> tolerance, Plausible judged) {
  if (!named && file.compare.empty()) return std::nullopt;
  const std::string other_path =
      named ? *named : (std::filesystem::path(path).parent_path() / file.compare).string();
  OtherScene other{other_path, read_scene(other_path, judged)};
  if (!file.sweep.is_empty() || !other.file.sweep.is_empty()) {
    throw std::invalid_argument("--compare is for single answers; omit [sweep] in both scenes");
  }
  if (tolerance) set_tolerance(*tolerance, other.file.scene);
  return other;
}

ComparedAnswers compare_answers(const AnsweredScene& here, const AnsweredScene& other,
                                const std::string& file) {
  ComparedAnswers out{.scene = file, .values = {}, .profiles = {}};
  const std::vector<NamedValue> others = named_values(other.answer);
  for (const NamedValue& one : named_values(here.answer)) {
    const NamedValue* beside = with_name(others, one.name);
    // The force on a row and that on a strip of a layer have one name, but N and N/m.
    if (beside != nullptr && beside->unit == one.unit) out.values.push_back(compared(one, *beside));
  }
  const std::vector<VoltageProfile> other_profiles = voltage_profiles(other.scene, other.answer);
  for (const VoltageProfile& profile : voltage_profiles(here.scene, here.answer)) {
    const VoltageProfile* beside = with_name(other_profiles, profile.name);
    if (beside == nullptr) continue;
    const double pitch_m = smallest_distance_m(profile.x_m);
    out.profiles.push_back(
        {profile, *beside, pitch_m, contrast(profile, pitch_m), contrast(*beside, pitch_m)});
    if (!has_same_places(out.profiles.back())) add_same_places(out.profiles.back(), out.values);
  }
  const bool share_a_curve = std::any_of(
      here.answer.curves.begin(), here.answer.curves.end(), [&](const SceneCurve& curve) {
        return with_name(other.answer.curves, curve.name) != nullptr;
      });
  if (out.values.empty() && out.profiles.empty() && !share_a_curve) {
    throw std::runtime_error(
        "--compare: the answers of the two scenes have no value, curve or profile of "
        "voltages in common");
  }
  return out;
}

void show_keys(ResultVisitor& v, const ComparedValue& value) {
  v("error", value.error, "estimated error of value");
  v("name", value.name, "of the result");
  v("other", value.other, "of the other scene");
  v("other_error", value.other_error, "estimated error of other");
  v.or_null("ratio", value.ratio, "value over other; null if other may be 0");
  v("ratio_error", value.ratio_error, "estimated error of ratio");
  v("unit", value.unit, "its unit");
  v("value", value.value, "of this scene");
}

void show_keys(ResultVisitor& v, const ComparedProfile& profile) {
  v.or_null("contrast", profile.contrast,
            "largest difference of electrodes one pitch apart over the largest voltage");
  v("name", profile.here.name, "of the readings");
  v.or_null("other_contrast", profile.other_contrast, "of the other scene, at the same pitch");
  v("other_voltage_V", profile.other.value_V, "of the other scene");
  v("other_x_m", profile.other.x_m, "places of its electrodes");
  v("pitch_m", profile.pitch_m, "smallest distance of electrodes");
  v("voltage_V", profile.here.value_V, "of this scene");
  v("x_m", profile.here.x_m, "places of its electrodes");
}

void show_keys(ResultVisitor& v, const ComparedAnswers& compared) {
  v("profiles", compared.profiles, "voltages along x that both have");
  v("scene", compared.scene, "the other scene's file");
  v("values", compared.values, "results and modes that both have");
}

}  // namespace viscard
