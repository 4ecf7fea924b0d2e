#pragma once

#include "io/config/config_fields.h"
#include "models/experiment/emulated_specimen.h"
#include "models/experiment/rig_config.h"
#include "models/experiment/specimen.h"
#include "models/experiment/test_plan.h"

#include <cstdint>

namespace viscard {

// The fields of each configuration struct, for reading and writing alike.

// Shows an integer member of any type; values outside [low, high] are refused on reading.
template <typename Integer>
void show_integer(FieldVisitor& fields, const char* key, std::int64_t low, std::int64_t high,
                  Integer& value) {
  auto wide = static_cast<std::int64_t>(value);
  fields.integer(key, low, high, wide);
  value = static_cast<Integer>(wide);
}

void show_rig(FieldVisitor& fields, RigConfig& rig);
void show_test(FieldVisitor& fields, TestPlan& plan);
void show_specimen(FieldVisitor& fields, Specimen& specimen);
void show_truth(FieldVisitor& fields, EmulatedTruth& truth);

// No key is required if the section names a record of `viscard calibrate`, which is read later.
// knows_gain: the instrument is a force gauge; its gain is 1 V/N unless the file gives another.
void show_calibration(FieldVisitor& fields, LoadCellCalibration& calibration, bool knows_gain);

}  // namespace viscard
