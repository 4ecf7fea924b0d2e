#pragma once

#include "models/experiment/test_plan.h"

#include <cstddef>
#include <string>
#include <vector>

namespace viscard {

// One phase of a test. Every protocol is a list of phases that one runner carries out
// (rig/run_indentation.h), so that safety, recording and contact are the same for all.
struct TestPhase {
  enum class Kind {
    kTare,       // zero of the load cell
    kApproach,   // in short jogs until touched, then back off by the gap
    kWait,       // duration_s from the end of the last move
    kMove,       // to depth_m, in move_s or, if move_s is 0, at speed_m_s
    kLoad,       // to force_N in about move_s
    kHoldForce,  // duration_s at force_N, by steps of the stage
    kRetract,
  };
  Kind kind = Kind::kWait;
  std::string name;     // in the record: "ramp", "hold_2", "creep"; rows of an export carry it
  std::string purpose;  // of its moves: "ramp", "unload", "creep" ... (run_record.h)
  std::string text;     // for the person watching
  double depth_m = 0.0;
  double force_N = 0.0;
  double move_s = 0.0;
  double speed_m_s = 0.0;
  double duration_s = 0.0;
  // The keys of the test file that set its depth or force, and its speed; used in messages.
  std::string load_key;
  std::string speed_key;
};

// All phases of a test: tare, approach, baseline, preload, the phases of the protocol, retract,
// baseline. Throws std::invalid_argument on an unknown protocol or impossible numbers; the message
// names the key to change.
std::vector<TestPhase> phases_from_plan(const TestPlan& plan);

// Largest depth and force of the phases; 0 if no phase has one.
double deepest_m(const std::vector<TestPhase>& phases);
double highest_force_N(const std::vector<TestPhase>& phases);

// Planned time of the phases [from, end), s; approach_s is the one of the approach.
double planned_s(const std::vector<TestPhase>& phases, std::size_t from, double approach_s);

}  // namespace viscard
