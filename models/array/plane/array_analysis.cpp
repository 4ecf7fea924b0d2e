#include "models/array/plane/array_analysis.h"

#include <algorithm>
#include <stdexcept>

namespace viscard {

const std::vector<ArrayAnalysis>& array_analyses() {
  static const std::vector<ArrayAnalysis> kAnalyses = {
      array_static_analysis(), array_modal_analysis(), array_harmonic_analysis(),
      array_transient_analysis()};
  return kAnalyses;
}

const ArrayAnalysis& analysis_of(const ArrayScene& scene) {
  for (const ArrayAnalysis& analysis : array_analyses()) {
    if (analysis.drive.index() == scene.drive.index()) return analysis;
  }
  throw std::logic_error("this drive has no row in the table of analyses");
}

bool asks_for_voltages(const ArrayScene& scene) {
  if (!is_electric(scene) || !analysis_of(scene).is_loaded) return false;
  return scene.wanted.empty() ||
         std::any_of(scene.wanted.begin(), scene.wanted.end(),
                     [](const std::string& name) { return !name.starts_with("top_displacement"); });
}

}  // namespace viscard
