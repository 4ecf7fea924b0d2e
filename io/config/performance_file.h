#pragma once

#include "models/experiment/rig_performance.h"

#include <filesystem>
#include <string>

namespace viscard {

class FieldVisitor;

// The section [performance] of a rig file, which captures do not store. Throws as read_rig() does.
RigPerformance read_performance(const std::filesystem::path& rig_path);
RigPerformance performance_from_toml(const std::string& rig_text, const std::string& name);

void show_performance(FieldVisitor& fields, RigPerformance& performance);

}  // namespace viscard
