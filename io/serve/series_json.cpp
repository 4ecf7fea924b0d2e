#include "io/serve/series_json.h"

#include "io/materials/material_file.h"
#include "io/materials/material_json.h"
#include "io/serve/api_error.h"
#include "models/maths/failure_text.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <functional>

namespace viscard {
namespace {

// Deeper objects could exhaust the stack of the thread that copies or prints them.
constexpr int kDeepestJson = 8;

// Keys of the test that the page can change, all of the protocol "ramp-hold".
struct TestKey {
  const char* key;
  double TestPlan::*member;
};
constexpr TestKey kTestKeys[] = {{"depth_m", &TestPlan::depth_m},
                                 {"ramp_s", &TestPlan::ramp_s},
                                 {"hold_s", &TestPlan::hold_s},
                                 {"unload_to_fraction", &TestPlan::unload_to_fraction},
                                 {"recovery_s", &TestPlan::recovery_s},
                                 {"approach_speed_m_s", &TestPlan::approach_speed_m_s},
                                 {"approach_limit_m", &TestPlan::approach_limit_m},
                                 {"contact_force_N", &TestPlan::contact_force_N},
                                 {"baseline_s", &TestPlan::baseline_s}};

// Calls take for each key with its number. Throws ApiError for a key without a taker.
using Taker = std::function<bool(const std::string& key)>;
void take_each(const Json& object, const char* what, const Taker& take) {
  if (!object.is_object()) {
    throw ApiError(400, "bad-request", std::string(what) + " must be a JSON object");
  }
  for (const auto& [key, value] : object.items()) {
    if (!take(key)) {
      throw ApiError(400, "bad-value", std::string(what) + " has an unknown key '" + key + "'");
    }
  }
}

Json fields_of(const Specimen& specimen) {
  return {{"id", specimen.id},
          {"material", specimen.material},
          {"mixing_ratio", specimen.mixing_ratio},
          {"modulus_guess_Pa", specimen.modulus_guess_Pa},
          {"relaxation_guess", specimen.relaxation_guess},
          {"rho_kg_m3", specimen.rho_kg_m3},
          {"temperature_C", specimen.temperature_C},
          {"punch_diameter_m", 2.0 * specimen.contact.punch_radius_m},
          {"layer_thickness_m", specimen.contact.layer_thickness_m},
          {"poisson_ratio", specimen.contact.poisson_ratio}};
}

// A name that a person has typed, on one line.
std::string name_at(const Json& object) {
  constexpr std::size_t kLongest = 200;
  std::string name = text_at(object, "id");
  const bool has_control = std::any_of(name.begin(), name.end(), [](char c) {
    return static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
  });
  if (!has_control && name.size() <= kLongest) return name;
  throw ApiError(400, "bad-value", "'id' must be a name of one line, at most 200 characters");
}

bool take_number(Specimen& specimen, const std::string& key, double value) {
  if (key == "mixing_ratio")
    specimen.mixing_ratio = value;
  else if (key == "modulus_guess_Pa")
    specimen.modulus_guess_Pa = value;
  else if (key == "relaxation_guess")
    specimen.relaxation_guess = value;
  else if (key == "rho_kg_m3")
    specimen.rho_kg_m3 = value;
  else if (key == "temperature_C")
    specimen.temperature_C = value;
  else if (key == "punch_diameter_m")
    specimen.contact.punch_radius_m = 0.5 * value;
  else if (key == "layer_thickness_m")
    specimen.contact.layer_thickness_m = value;
  else if (key == "poisson_ratio")
    specimen.contact.poisson_ratio = value;
  else
    return false;
  return true;
}

Json json_of_material(const std::filesystem::path& file) {
  try {
    const Material material = read_material(file).material;
    Json json = {{"file", file.filename().string()}, {"E0_Pa", material.E0_Pa}};
    for (const MaterialFlag& flag : material.flags) {
      if (is_doubt_of_record(flag)) json["doubts"].push_back(flag.text);
    }
    if (material.uncertainty) json["E0_interval_95"] = json_from(material.uncertainty->E0_Pa_95);
    return json;
  } catch (const std::exception& error) {
    return {{"file", file.filename().string()}, {"trouble", failure_text(error, "this file")}};
  }
}

}  // namespace

Json object_from_text(const std::string& text) {
  const auto is_flat = [](int depth, Json::parse_event_t, Json&) {
    if (depth <= kDeepestJson) return true;
    throw ApiError(400, "bad-json", "the request is nested too deeply");
  };
  Json object;
  try {
    object = Json::parse(text, is_flat);
  } catch (const Json::exception&) {
    throw ApiError(400, "bad-json", "the request is not JSON");
  }
  if (!object.is_object()) throw ApiError(400, "bad-json", "the request is not a JSON object");
  return object;
}

std::string text_at(const Json& object, const char* key) {
  const auto found = object.find(key);
  if (found != object.end() && found->is_string()) return found->get<std::string>();
  throw ApiError(400, "bad-value", std::string("the request needs '") + key + "', a text");
}

double number_at(const Json& object, const std::string& key) {
  const Json value = object.is_object() && object.contains(key) ? object.at(key) : Json();
  if (value.is_number() && std::isfinite(value.get<double>())) return value.get<double>();
  throw ApiError(400, "bad-value", "'" + key + "' is " + value.dump() + "; it must be a number");
}

std::vector<double> rounded(const std::vector<double>& values, double step) {
  std::vector<double> result;
  result.reserve(values.size());
  const double per_step = std::round(1.0 / step);
  for (const double value : values) result.push_back(std::round(value * per_step) / per_step);
  return result;
}

Plausible judged_by(const Json& request) {
  if (!request.contains("plausible")) return Plausible::kMeasured;
  try {
    return plausible_from_word(text_at(request, "plausible"), Plausible::kMeasured);
  } catch (const std::invalid_argument& error) {
    throw ApiError(400, "bad-value", error.what());
  }
}

Json json_of_rig(const RigConfig& rig, const std::string& calibration_trouble) {
  const double capacity_N = rig.calibration.capacity_N;
  return {{"name", rig.name},
          {"capacity_N", capacity_N},
          {"warn_N", rig.safety.warn_fraction * capacity_N},
          {"soft_N", rig.safety.soft_fraction * capacity_N},
          {"hard_N", rig.safety.hard_fraction * capacity_N},
          {"calibration_id", rig.calibration.id},
          {"calibration_trouble", calibration_trouble},
          {"frame_stiffness_N_m", rig.frame.stiffness_N_m},
          {"rate_Hz", rig.load_cell.expected_rate_Hz},
          {"stage", {{"driver", rig.stage.driver}, {"port", rig.stage.port}}},
          {"load_cell", {{"driver", rig.load_cell.driver}, {"port", rig.load_cell.port}}}};
}

Json json_of_test(const TestPlan& plan) {
  Json json = {{"name", plan.name}, {"protocol", plan.protocol}};
  for (const TestKey& entry : kTestKeys) json[entry.key] = plan.*entry.member;
  return json;
}

TestPlan test_with(TestPlan plan, const Json& object) {
  take_each(object, "the test", [&](const std::string& key) {
    for (const TestKey& entry : kTestKeys) {
      if (key == entry.key) {
        plan.*entry.member = number_at(object, key);
        return true;
      }
    }
    return false;
  });
  return plan;
}

void refuse_unseen_test(const Json& shown, const TestPlan& plan) {
  const Json saved = json_of_test(plan);
  for (const auto& [key, value] : shown.items()) {
    if (saved.contains(key) && saved.at(key) == value) continue;
    throw ApiError(409, "changed",
                   "test.toml has changed since this page showed it. Look at the expected course "
                   "again, then start");
  }
}

Specimen specimen_from(const Json& object) {
  Specimen specimen;
  take_each(object, "the specimen", [&](const std::string& key) {
    if (key == "id") return specimen.id = name_at(object), true;
    if (key == "material") return specimen.material = text_at(object, "material"), true;
    if (take_number(specimen, key, 0.0)) return take_number(specimen, key, number_at(object, key));
    return false;
  });
  return specimen;
}

Json json_of_specimen(const SeriesSpecimen& specimen, const SeriesFolder& folder) {
  Json json = {{"name", specimen.name}, {"state", specimen.state()}, {"trouble", specimen.trouble}};
  json["specimen"] = specimen.specimen ? fields_of(*specimen.specimen) : Json(nullptr);
  json["captures"] = Json::array();
  for (const SeriesSpecimen::Capture& capture : specimen.captures) {
    json["captures"].push_back({{"file", capture.file},
                                {"status", capture.status},
                                {"started_at", capture.started_at},
                                {"trouble", capture.trouble},
                                {"note", capture.note}});
  }
  json["material"] = specimen.material_file.empty()
                         ? Json(nullptr)
                         : json_of_material(folder.path() / specimen.material_file);
  return json;
}

Json json_of_preflight(const Preflight& expected, const ExpectedCourse& course) {
  Json phases = Json::array();
  for (const ExpectedCourse::Phase& phase : course.phases) {
    phases.push_back({{"name", phase.name}, {"text", phase.text}, {"start_s", phase.start_s}});
  }
  return {{"peak_force_N", expected.peak_force_N},
          {"limit_N", expected.limit_N},
          {"deepest_safe_depth_m", expected.deepest_safe_depth_m},
          {"stage_travel_m", expected.stage_travel_m},
          {"ramp_speed_m_s", expected.ramp_speed_m_s},
          {"problems", expected.problems},
          {"warnings", expected.warnings},
          {"approach_at_most_s", course.approach_at_most_s},
          {"duration_s", course.time_s.back()},
          {"course",
           {{"time_s", course.time_s}, {"depth_m", course.depth_m}, {"force_N", course.force_N}}},
          {"phases", phases}};
}

}  // namespace viscard
