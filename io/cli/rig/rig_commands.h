#pragma once

#include "io/cli/words/streams.h"

namespace viscard {

// The commands at the rig.

// viscard rig list: lists serial ports and why one cannot be used.
// viscard rig check: identifies both devices of a rig file, measures them and reads their settings.
// viscard rig overshoot: the force beyond a limit on the emulated rig.
int run_rig(const Words& words, Streams& streams);
// viscard calibrate: the load cell with dead weights, or the frame with a rigid block.
int run_calibrate(const Words& words, Streams& streams);
// viscard capture: runs indentation tests on the rig, or on an emulated one, into capture files.
int run_capture(const Words& words, Streams& streams);
// viscard export: writes a capture as CSV.
int run_export(const Words& words, Streams& streams);

}  // namespace viscard
