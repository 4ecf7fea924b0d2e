#pragma once

#include "models/experiment/rig_config.h"

#include <atomic>
#include <filesystem>
#include <functional>

namespace viscard {

// Listens to the load cell of a rig (or of an emulated one, which gets a weight of a tenth of its
// capacity) until it answers a finger or a weight; moves nothing. Returns the force, N. Throws
// RigError as await_touch() does.
double touch_rig(const RigConfig& rig, bool is_emulated, double wait_s,
                 const std::function<void()>& ready, const std::atomic<bool>* stop);

// Writes answered_on = DAY under [load_cell] of a rig file and changes nothing else of it. Throws
// std::runtime_error if the file has no such section or cannot be written.
void write_answer(const std::filesystem::path& rig_file, const std::string& day);

}  // namespace viscard
