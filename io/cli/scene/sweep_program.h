#pragma once

#include "io/cli/words/streams.h"
#include "io/flow/sweep/run_study.h"
#include "io/options/option.h"

#include <functional>

namespace viscard {

// The job of a program that answers studies.
struct SweepJob {
  const Study& study;
  const StudyShard& shard;
  StudyStore& store;
  std::function<void(double)> progress;  // called with the fraction done
  Plausible judged = Plausible::kScene;
};

// A program that answers studies: its words, and how the points of a job are answered.
struct SweepProgram {
  const char* usage;
  const char* description;
  const char* example;
  std::function<void(OptionList&)> add_options;  // of its own; may be empty
  std::function<StudyOutcome(const SweepJob&)> run;
};

// The command sweep of a program: reads words and study, opens the store, answers the points that it
// does not hold yet or takes over those of other stores, and prints what was done.
int run_sweep_program(const SweepProgram& program, const Words& words, Streams& streams);

}  // namespace viscard
