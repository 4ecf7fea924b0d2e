#include "models/pillar/scene/scene_results.h"

#include "models/pillar/analyses/analysis.h"
#include "models/pillar/analyses/top_load.h"

#include <cmath>

namespace viscard {
namespace {

using Names = std::vector<std::string>;

void add(Names& names, const std::string& stem, const Names& endings) {
  names.push_back(stem);
  for (const std::string& ending : endings) names.push_back(stem + ending);
}

void append(Names& names, const Names& more) {
  names.insert(names.end(), more.begin(), more.end());
}

Names sideways_names(const Scene& scene, Names names) {
  if (!scene.electrodes) return names;
  if (scene.electrodes->electrode_radius_m == 0.0) {
    names.emplace_back("quadrant_voltage");
    return names;
  }
  names.emplace_back("displacement_per_volt");
  if (scene.drive_V == 0.0) names.emplace_back("quadrant_charge");
  return names;
}

// The top's motion is told, or, where that is given, what it takes.
Names static_names(const Scene& scene) {
  const bool is_moved = moves_top(scene);
  const Names top = is_moved ? Names{"top_force", "top_stiffness"} : Names{"top_displacement"};
  if (is_sideways(scene)) return sideways_names(scene, top);
  if (!scene.electrodes) {
    Names names = top;
    append(names, {"base_stress_at_half_radius", "base_stress_rim_mean"});
    if (scene.film) names.emplace_back("film_bottom_stress_mean");
    return names;
  }
  if (scene.electrodes->electrode_radius_m == 0.0) {
    Names names = {"potential_at_centre", "potential_mean"};
    if (is_moved) append(names, top);
    return names;
  }
  if (is_moved) {
    Names names = {"electrode_voltage", "electrode_charge", "electrode_capacitance"};
    append(names, top);
    if (scene.readout && scene.drive_V == 0.0) {
      append(names, {"reading_at_once", "readout_time_constant"});
    }
    return names;
  }
  Names names = {"electrode_voltage", "electrode_charge", "electrode_capacitance",
                 "top_displacement", "displacement_per_volt"};
  if (scene.drive_V != 0.0) {
    if (scene.fixed_bottom) append(names, {"stiffness_driven", "stiffness_open"});
    names.emplace_back("film_stiffness_change_by_drive");
  } else if (scene.readout) {
    names.emplace_back("reading_at_once");
    names.emplace_back("readout_time_constant");
  }
  return names;
}

Names modal_names(const Scene& scene) {
  Names names = {"frequency", "lateral", "longitudinal"};
  if (scene.plane) return names;
  names.emplace_back("torsion");
  names.emplace_back("ovalling");
  return names;
}

// What moves in time or frequency: the top first, then what the film shows of it.
Names moving_names(const Scene& scene, const std::string& first, const Names& endings) {
  Names names;
  add(names, first, endings);
  const bool is_axial = scene.direction == LoadDirection::kAxial;
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

}  // namespace

std::vector<std::string> result_names(const Scene& scene) {
  const bool is_base = scene.load_place == LoadPlace::kBase;
  switch (scene.kind) {
    case AnalysisKind::kStatic:
      return static_names(scene);
    case AnalysisKind::kModal:
      return modal_names(scene);
    case AnalysisKind::kBuckling:
      return {"buckling_pressure"};
    case AnalysisKind::kCreep:
      return moving_names(scene, "top_displacement", {"_end", "_peak"});
    case AnalysisKind::kRelaxation:
      return moving_names(scene, "top_pressure", {"_end", "_peak"});
    case AnalysisKind::kTransient:
      return moving_names(scene, is_base ? "top_displacement_from_base" : "top_displacement",
                          {"_peak", "_end", "_spectrum"});
    case AnalysisKind::kHarmonic: {
      Names endings = {"_real", "_imaginary", "_magnitude", "_phase", "_at_lowest", "_at_highest"};
      for (char number = '1'; number <= '9'; ++number) {
        endings.push_back(std::string("_resonance_") + number);
      }
      return moving_names(scene, is_base ? "transmissibility" : "top_displacement", endings);
    }
  }
  return {};
}

bool is_peak_stress(const std::string& name) {
  return name.find("peak_stress") != std::string::npos || name == "base_stress_max";
}

}  // namespace viscard
