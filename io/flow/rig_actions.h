#pragma once

#include "models/experiment/rig_config.h"
#include "rig/move_stage.h"
#include "rig/rig_check.h"
#include "rig/run/run_control.h"
#include "rig/touch_cell.h"
#include "rig/weigh.h"
#include "rig/zero_force.h"

#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

// What is done with a rig outside of a run: check it, wait for a finger, move its stage. Each opens the devices of a rig
// file, or an emulated rig in their place, and throws RigError for a port that cannot be opened and for wrong words of
// the rig file.
namespace viscard {

// Opens both devices of a rig (or of an emulated one) and measures them for some seconds; moves
// nothing. Throws RigError as check_rig() does.
RigCheck check_rig_config(const RigConfig& rig, bool is_emulated, double seconds);

// As in a capture: an expired calibration, or one dated later than today, forbids a test; one
// without a date is only a warning.
void add_calibration(const RigConfig& rig, RigCheck& found);

// Listens to the load cell of a rig (or of an emulated one, which gets a weight of a tenth of its
// capacity) until it has answered a finger or a weight; moves nothing. Returns the force, N. Throws
// RigError as await_touch() does.
double touch_rig(const RigConfig& rig, bool is_emulated, const TouchOptions& asked);

// Writes answered_on = DAY under [load_cell] of a rig file and changes nothing else of it. Throws
// std::runtime_error if the file has no such section or cannot be written.
void write_answer(const std::filesystem::path& rig_file, const std::string& day);
// Writes file = "RECORD" under [calibration]; the other keys there become comments. Throws likewise.
void write_calibration_file(const std::filesystem::path& rig_file, const std::string& record);

// Writes zero = "12.345 mm" under [stage], at position_m of the controller. Throws likewise.
void write_zero(const std::filesystem::path& rig_file, double position_m);

// Where the stage of a rig (or of an emulated one) stands; moves nothing. Throws RigError, among others if
// the position means another place when the stage is connected again.
double lasting_position_m(const RigConfig& rig, bool is_emulated);
// Lets the instrument of a rig (or of an emulated one) make the force at rest its zero. Throws RigError as
// zero_force() does.
ZeroedForce zero_rig_force(const RigConfig& rig, bool is_emulated, const std::atomic<bool>* stop);

// How a message begins that refuses a number: "--away is '1', without a unit (in m)". Empty: "the
// way is 1000 mm".
struct OrderTexts {
  std::string way, speed, limit;
};
// Throws std::invalid_argument for a way, speed or limit that no move by hand has.
void check_order(const StageOrder& order, const RigConfig& rig, const OrderTexts& typed = {});
// Opens the devices of the rig, or of an emulated one, and carries out the order. control: who watches and
// stops it; its clock is set here. position_m: where the stage stands, before
// (of an emulated one, which would begin at 0) and after the move, also of one that failed; nothing if that is not known. Throws RigError as move_stage() does, and if another program holds a port.
StageMoved move_rig_stage(RigConfig rig, bool is_emulated, const StageOrder& order,
                          RunControl control, std::optional<double>* position_m = nullptr);

// Opens the load cell and weighs one load, which hangs already (on an emulated rig it is hung). largest_N: of the
// loads of this calibration. Throws RigError as weigh() does.
WeighedLoad weigh_on_rig(const RigConfig& rig, bool is_emulated, double force_N, double largest_N,
                         const std::atomic<bool>* stop);

}  // namespace viscard
