#pragma once

#include "models/experiment/test_plan.h"

#include <cstddef>
#include <string>
#include <vector>

namespace viscard {

// One thing that a run does. Every protocol is a list of these, carried out by one runner
// (rig/run_indentation.h), so that safety, recording and contact are the same for all.
struct TestPhase {
  enum class Kind {
    kTare,       // zero of the load cell
    kApproach,   // in short jogs until touched, then back off by the gap
    kWait,       // duration_s from the end of the last move
    kMove,       // to depth_m, in move_s or, if that is 0, at speed_m_s
    kLoad,       // to force_N in about move_s
    kHoldForce,  // duration_s at force_N, the stage following
    kRetract,
  };
  Kind kind = Kind::kWait;
  std::string name;     // in the record: "ramp", "hold_2", "creep"; rows of an export carry it
  std::string purpose;  // of its moves: "ramp", "unload", "creep" ... (models/run_record.h)
  std::string text;     // for the person watching
  double depth_m = 0.0;
  double force_N = 0.0;
  double move_s = 0.0;
  double speed_m_s = 0.0;
  double duration_s = 0.0;
  // What of the test file decides over its depth or force and over its speed, for messages.
  std::string load_key;
  std::string speed_key;
};

// All of a test: tare, approach, baseline, preload, what the protocol asks for, retract, baseline.
// Throws std::invalid_argument on a protocol that is not known or has numbers that make no sense,
// naming the key to change.
std::vector<TestPhase> phases_from_plan(const TestPlan& plan);

// Largest depth and force that the phases ask for; 0 if none does.
double deepest_m(const std::vector<TestPhase>& phases);
double highest_force_N(const std::vector<TestPhase>& phases);

// Time that phases [from, end) should take, s; moves by force count as their duration.
double planned_s(const std::vector<TestPhase>& phases, std::size_t from, double approach_s);

}  // namespace viscard
