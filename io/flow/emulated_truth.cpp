#include "io/basics/atomic_file.h"
#include "io/basics/json_string.h"
#include "io/config/config_file.h"
#include "io/flow/capture_to_file.h"
#include "io/materials/material_file.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <stdexcept>

namespace fs = std::filesystem;

namespace viscard {

std::string json_from_truth(const EmulatedTruth& truth) {
  nlohmann::ordered_json json;
  json["schema"] = "viscard-truth/1";
  json["name"] = truth.material.name;
  json["E0_Pa"] = truth.material.E0_Pa;
  json["nu"] = truth.material.nu;
  json["terms"] = nlohmann::ordered_json::array();
  for (const MaterialTerm& term : truth.material.terms) {
    json["terms"].push_back({{"g", term.g}, {"k", term.k}, {"tau_s", term.tau_s}});
  }
  json["punch_radius_m"] = truth.contact.punch_radius_m;
  json["layer_thickness_m"] = truth.contact.layer_thickness_m;
  json["frame_stiffness_N_m"] = truth.frame_stiffness_N_m;
  json["surface_position_m"] = truth.surface_position_m;
  json["force_noise_N"] = truth.force_noise_N;
  json["force_offset_N"] = truth.force_offset_N;
  json["drift_relative_per_s"] = truth.drift_relative_per_s;
  json["overload_N"] = truth.overload_N;
  json["sample_rate_Hz"] = truth.sample_rate_Hz;
  json["steps_per_m"] = truth.steps_per_m;
  json["acceleration_m_s2"] = truth.acceleration_m_s2;
  if (truth.specimen_scatter > 0.0 || truth.alignment_scatter > 0.0 ||
      truth.surface_scatter_m > 0.0) {
    json["specimen_scatter"] = truth.specimen_scatter;
    json["alignment_scatter"] = truth.alignment_scatter;
    json["surface_scatter_m"] = truth.surface_scatter_m;
    json["contact_factor"] = truth.contact_factor;
  }
  json["seed"] = truth.seed;
  return text_from_json(json, 2) + "\n";
}

EmulatedTruth truth_from_file(const std::string& path) {
  if (fs::path(path).extension() != ".json") return read_truth(path);
  nlohmann::json json = json_or_discarded(read_file(path));
  if (!json.is_object())
    throw std::runtime_error(path + ": is not a truth file; expected a JSON object");
  json["schema"] = "viscard-material/1";  // its material has the same keys
  EmulatedTruth truth;
  truth.material = material_from_json(text_from_json(json), path).material;
  return truth;
}

}  // namespace viscard
