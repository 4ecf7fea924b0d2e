#pragma once

#include "io/config/config_fields.h"
#include "io/scenes/raw_drive.h"
#include "models/array/sensing/heat_response.h"
#include "models/array/sensing/thermal_noise.h"
#include "models/array/space/space_scene.h"

namespace viscard {

// The sections [heat] and [noise] of an array in the plane before they are checked.
struct RawSensing {
  HeatScene heat;
  DummyElectrode dummy;
  bool has_dummy = false;
  NoiseBand noise{.to_Hz = 0.0};  // 0: no noise
};

// [heat]: temperature, pillar and film = { conductivity, capacity }, pyroelectric, dummy (true: beside, with
// dummy_ratio and dummy_mismatch), end_time.
void show_heat(FieldVisitor& heat_table, RawSensing& sensing);
// [noise]: temperature, from, to, loss_tangent, amplifier.
void show_noise(FieldVisitor& noise_table, RawSensing& sensing);

// Nothing for sections that are not there.
void fill_sensing(const RawSensing& raw, const RawDrive& drive, SpaceScene& scene);

}  // namespace viscard
