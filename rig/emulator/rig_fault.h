#pragma once

#include <string>
#include <vector>

namespace viscard {

// What can break on an emulated rig in the middle of a run while its devices go on answering.
enum class RigFaultKind {
  kNone,
  kFrozen,          // each reading repeats the last one
  kZeros,           // each reading is exactly 0
  kOpenWire,        // each reading is the end of the converter's range
  kDriftingWire,    // noise and a drifting offset that no force moves
  kNoExcitation,    // noise about the zero, whatever presses
  kHalfGain,        // the amplifier halves its gain
  kFiltered,        // the readings follow the force through a low pass of 0.15 s
  kSaturation,      // the amplifier clips at a quarter of the cell's full scale
  kFastReadings,    // three times as many readings per second
  kSlowReadings,    // 10 readings per second
  kDeadMotor,       // the stage counts on, its motor stands
  kLostSteps,       // toward the specimen and under load every fifth step is lost
  kPlay,            // 30 um between screw and punch when the stage turns round
  kDirectionStuck,  // each move away from the specimen goes toward it
  kSinks,           // the punch creeps toward the specimen by 0.7 mm/s, which nothing counts
  kLoadCellPort,    // the port hangs up
  kStageStall,      // the stage's controller does nothing for half a second, then goes on
  kStagePort,
  kStagePortBack,  // it hangs up and is back under its name after 1 s of wall time
};

// A fault, and when it begins.
struct RigFault {
  RigFaultKind kind = RigFaultKind::kNone;
  std::string phase;     // of the test; empty: from the start
  double after_s = 0.0;  // so long after the phase has begun, emulated time
};

// The words for the kinds: "frozen", "zeros" ...
std::vector<std::string> rig_fault_names();
std::string name_of(RigFaultKind kind);

// "frozen", "frozen@hold" or "frozen@hold+0.5" (seconds). Throws std::invalid_argument naming the
// known words.
RigFault rig_fault_from_text(const std::string& text);

}  // namespace viscard
