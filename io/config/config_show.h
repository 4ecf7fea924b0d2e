#pragma once

#include "io/config/config_fields.h"
#include "models/experiment/rig_config.h"
#include "models/experiment/test_plan.h"

#include <cstdint>

namespace viscard {

// Parts of config_file.cpp: what the configuration structs consist of.

// Shows an integer member of any width.
template <typename Integer>
void show_integer(FieldVisitor& fields, const char* key, std::int64_t low, std::int64_t high,
                  Integer& value) {
  auto wide = static_cast<std::int64_t>(value);
  fields.integer(key, low, high, wide);
  value = static_cast<Integer>(wide);
}

void show_test(FieldVisitor& fields, TestPlan& plan);

// Nothing is required where a record of `viscard calibrate` is named: it is read afterwards.
// knows_gain: a force gauge, whose gain is 1 unless said otherwise.
void show_calibration(FieldVisitor& fields, LoadCellCalibration& calibration, bool knows_gain);

}  // namespace viscard
