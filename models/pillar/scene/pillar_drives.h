#pragma once

#include "models/pillar/time/load_history.h"

#include <optional>
#include <variant>
#include <vector>

namespace viscard {

// What is done to a pillar: one alternative for each analysis (analyses/analysis.h).

// Where and which way a load acts: on the top, or as an acceleration of the base.
enum class LoadPlace { kTop, kBase };
// Along the axis or sideways.
enum class LoadDirection { kAxial, kLateral };

// A load at rest on the top, and a voltage on the electrode.
struct StaticDrive {
  LoadDirection direction = LoadDirection::kAxial;
  double pressure_Pa = 0.0;              // lateral: shear
  std::optional<double> displacement_m;  // of the top along +z (lateral: +x), instead of a pressure
  double drive_V = 0.0;                  // on the electrode (actuator)
};

// Free vibration, perhaps under a pressure at rest on the top.
struct ModalDrive {
  int modes = 4;             // of each family
  double pressure_Pa = 0.0;  // prestress
};

// The pressure at which the straight pillar buckles sideways.
struct BucklingDrive {
  bool plate_on_top = false;  // pressed by a rigid frictionless plate that stays level
  double bow_m = 0.0;  // of a pillar that is not straight: offset of its top; 0: it is straight
  double collapse_strain = 0.1;  // at its foot, at which it has collapsed (analyses/bowed_pillar.h)
};

// A shortening in time without inertia.
struct RelaxationDrive {
  Course history;  // shortening, m
};

// A pressure in time without inertia.
struct CreepDrive {
  Course history;  // pressure on the top, Pa
};

// A steady oscillation: pressure (axial) or shear (lateral) on the top, or the base shaken.
struct HarmonicDrive {
  LoadPlace load_place = LoadPlace::kTop;
  LoadDirection direction = LoadDirection::kAxial;
  double pressure_Pa = 0.0;             // amplitude on the top
  double base_acceleration_m_s2 = 0.0;  // amplitude of the base
  std::vector<double> frequencies_Hz;   // ascending
};

// A load in time with inertia: pressure (axial) or shear (lateral) on the top, or the base shaken.
struct TransientDrive {
  LoadPlace load_place = LoadPlace::kTop;
  LoadDirection direction = LoadDirection::kAxial;
  Course history;  // Pa on the top, m/s^2 of the base
  double end_time_s = 0.0;
  int outputs = 1000;  // equal intervals
};

// One of these.
using PillarDrive = std::variant<StaticDrive, ModalDrive, BucklingDrive, RelaxationDrive,
                                 CreepDrive, HarmonicDrive, TransientDrive>;

}  // namespace viscard
