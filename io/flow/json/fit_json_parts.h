#pragma once

#include "io/flow/fit_file.h"
#include "io/materials/material_json.h"

namespace viscard {

// Parts of the object of a fit (flow_json.h), for the files of this room.

// null unless it is finite.
Json json_number(double value);
// `shift`: factors and laws of a master curve.
Json json_from(const MasterCurve& curve);
// `tests`: one object for each test that was fitted together.
Json json_of_tests(const FittedFile& fitted);

}  // namespace viscard
