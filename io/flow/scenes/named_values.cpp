#include "io/flow/scenes/named_values.h"

#include <map>

namespace viscard {

std::vector<NamedValue> named_values(const SceneAnswer& answer) {
  std::vector<NamedValue> all;
  for (const SceneResult& r : answer.results) {
    all.push_back({r.name, r.value, r.unit, r.error_estimate});
  }
  std::map<std::string, int> count;
  for (const SceneMode& m : answer.modes) {
    all.push_back({m.family + " " + std::to_string(++count[m.family]), m.frequency_Hz, "Hz",
                   m.error_estimate});
  }
  return all;
}

}  // namespace viscard
