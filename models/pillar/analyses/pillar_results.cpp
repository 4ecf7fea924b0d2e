#include "models/pillar/analyses/pillar_results.h"

#include "models/pillar/analyses/analysis.h"
#include "models/pillar/analyses/sideways.h"

namespace viscard {
namespace {

using Names = std::vector<std::string>;

void add(Names& names, const std::string& stem, const Names& endings) {
  names.push_back(stem);
  for (const std::string& ending : endings) names.push_back(stem + ending);
}

}  // namespace

std::vector<std::string> result_names(const PillarScene& scene) {
  return analysis_of(scene).result_names(scene);
}

std::vector<std::string> moving_names(const PillarScene& scene, const std::string& first,
                                      const Names& endings) {
  Names names;
  add(names, first, endings);
  const bool is_axial = !is_lateral(scene);
  if (reads_quadrants(scene)) {
    const bool is_sampled = scene.electrodes->electrode_radius_m == 0.0;
    add(names, is_sampled ? "quadrant_voltage" : "quadrant_charge", endings);
    if (scene.readout) {
      add(names, "reading", endings);
      names.emplace_back("readout_time_constant");
    }
  }
  if (!scene.electrodes || !is_axial) return names;
  const bool is_read = scene.electrodes->electrode_radius_m == 0.0;
  add(names, is_read ? "potential_at_centre" : "electrode_voltage", endings);
  if (!scene.readout) return names;
  add(names, "reading", endings);
  names.emplace_back("electrode_capacitance");
  names.emplace_back("readout_time_constant");
  return names;
}

}  // namespace viscard
