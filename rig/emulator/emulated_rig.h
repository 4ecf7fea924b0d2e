#pragma once

#include "rig/emulator/emulated_rig_options.h"
#include "rig/lines/rig_clock.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace viscard {

enum class Incident : unsigned {
  kPullStageCable = 1,
  kPullLoadCellCable = 2,
  kSilenceLoadCell = 4,  // the stream stalls, the port stays
  kRestartLoadCell = 8,  // a brown-out: banner, then the clock starts from 0
  kRestartStage = 16,
  kHitLimitSwitch = 32,
  kPullThermometerCable = 64,
};

// What really happened on the bench, independent of the bytes on the wires.
struct EmulatedOutcome {
  double peak_force_N = 0.0;
  double peak_depth_m = 0.0;
  bool is_cell_broken = false;  // the force went above truth.overload_N
  double final_position_m = 0.0;
  bool is_moving = false;
  double lost_m = 0.0;     // what the stage has counted and not travelled
  double counted_m = 0.0;  // where the stage counts itself
};

// A stage (of any driver) and a load cell (HX711 amplifier, multimeter or force gauge) behind two
// pseudo-terminals, with a thermometer behind a third one, pressing on an emulated specimen. config
// names their drivers. On the wall clock one thread does all the work, otherwise it is done in the
// waits of the program that uses clock(). The destructor hangs up the ports.
class EmulatedRig {
 public:
  // Throws std::runtime_error without a free pseudo-terminal, std::invalid_argument on a bad truth.
  explicit EmulatedRig(const EmulatedRigOptions& options);
  ~EmulatedRig();

  std::string stage_port() const;
  std::string load_cell_port() const;
  // The config of the options with the ports filled in. A rig that waits seems to its program to
  // run at speed 1.
  RigConfig config() const;
  // For the program that uses the rig; must not outlive it.
  RigClock clock() const;
  bool waits() const;

  EmulatedOutcome outcome() const;
  // What the load cell's instrument has sent, as its lines with their terminators; needs
  // options.keeps_lines.
  std::vector<std::string> sent_lines() const;

  // Hangs a weight on the load cell, in addition to the force of the punch; replaces the last one.
  void hang_weight(double force_N);

  // Both may be called from any thread.
  void cause(Incident incident);
  void stall(double wall_s);  // the thread does nothing for that time; for a rig on the wall clock

  // A phase of the test has begun; the fault of the options begins with it. May be called from any
  // thread.
  void enter_phase(const std::string& phase);
  // Whether the options have a fault that has not begun.
  bool awaits_fault() const;

  // Serves something else on the lines of a rig that waits, such as a FaultProxy. It is called
  // repeatedly with the time, and returns true if bytes have gone to the program.
  void serve_too(std::function<bool(double now_s)> serve);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace viscard
