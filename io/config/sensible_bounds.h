#pragma once

#include "models/experiment/rig_config.h"
#include "models/experiment/specimen.h"
#include "models/experiment/test_plan.h"

#include <string>

namespace viscard {

// Refuse values in a file that no test on a bench can have, such as a modulus of 2 Pa because "MPa"
// was forgotten. They throw std::runtime_error with file, line, key, the value, the bounds and an
// example. Files inside old captures are read without these checks.
void refuse_senseless(const RigConfig& rig, const std::string& toml, const std::string& name);
void refuse_senseless(const TestPlan& plan, const std::string& toml, const std::string& name);
void refuse_senseless(const Specimen& specimen, const std::string& toml, const std::string& name);

}  // namespace viscard
