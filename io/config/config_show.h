#pragma once

#include "io/config/config_fields.h"
#include "models/experiment/emulated_specimen.h"
#include "models/experiment/rig_config.h"
#include "models/experiment/specimen.h"
#include "models/experiment/test_plan.h"

namespace viscard {

// The fields of each configuration struct, for reading and writing alike.

void show_rig(FieldVisitor& fields, RigConfig& rig);
void show_test(FieldVisitor& fields, TestPlan& plan);
void show_specimen(FieldVisitor& fields, Specimen& specimen);
void show_truth(FieldVisitor& fields, EmulatedTruth& truth);

// No key is required if the section names a record of `viscard calibrate`, which is read later.
// knows_gain: the instrument is a force gauge; its gain is 1 V/N unless the file gives another.
void show_calibration(FieldVisitor& fields, LoadCellCalibration& calibration, bool knows_gain);

}  // namespace viscard
