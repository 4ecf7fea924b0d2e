#include "io/flow/scenes/wanted_results.h"

#include <algorithm>

namespace viscard {
namespace {

// "centre_voltage" stands for centre_voltage_1, centre_voltage_2, ...; of an array in the plane for
// centre_voltage_1_1, ... and the extremes of the map.
bool is_named(const std::string& result, const std::string& wanted) {
  if (!result.starts_with(wanted)) return false;
  const std::string rest = result.substr(wanted.size());
  return rest.empty() || rest == "_largest" || rest == "_smallest" ||
         (rest.size() > 1 && rest[0] == '_' &&
          rest.find_first_not_of("0123456789_", 1) == std::string::npos);
}

}  // namespace

void keep_wanted(const std::vector<std::string>& wanted, SceneAnswer& answer) {
  if (wanted.empty() || answer.results.empty()) return;
  const auto stands_for = [&](const std::string& name, const SceneResult& r) {
    if (is_named(r.name, name)) return true;
    const bool is_curve =
        std::any_of(answer.curves.begin(), answer.curves.end(), [&](const SceneCurve& curve) {
          return curve.name == name || curve.name.starts_with(name + "_");
        });
    return is_curve && r.name.starts_with(name + "_");
  };
  std::erase_if(answer.results, [&](const SceneResult& r) {
    return std::none_of(wanted.begin(), wanted.end(),
                        [&](const std::string& name) { return stands_for(name, r); });
  });
}

}  // namespace viscard
