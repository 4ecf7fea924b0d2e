#pragma once

#include "io/flow/sweep/study_store.h"
#include "models/quantities/plausible.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace viscard {

// Part of a study that one machine answers: the points whose number leaves `index` - 1 when divided by
// `count`.
struct StudyShard {
  std::int64_t index = 1, count = 1;
};
// "3/64". Throws std::invalid_argument for anything else.
StudyShard shard_from(const std::string& text);

// State of the points of a shard.
struct StudyOutcome {
  std::int64_t n_points = 0;    // of the study
  std::int64_t n_answered = 0;  // now
  std::int64_t n_before = 0;    // of this shard, done before
  std::int64_t n_refused = 0;   // of those answered now: outside the model
  std::int64_t n_failed = 0;    // of those tried now: by memory, disk or an error of the program
  std::string first_failure;    // of these
};

// Reads the scene at every value of every parameter. Throws std::runtime_error naming the parameter and
// the value for one that the scene cannot take: a wrong unit, or no plausible number. What only some
// combinations contradict stays with their points.
void check_values(const Study& study, Plausible judged = Plausible::kScene);

// Counts a point that was tried.
void count_point(const StudyPoint& point, StudyOutcome& outcome);

// The scene's answer at one point, or the reason why there is none. A file that is not what it was when
// the study was read counts as a passing failure.
StudyPoint answer_point(const Study& study, std::int64_t number,
                        Plausible judged = Plausible::kScene);

// The points of the shard that the store does not hold yet, ascending. Sets n_points and n_before of
// the outcome.
std::vector<std::int64_t> open_points(const Study& study, const StudyShard& shard,
                                      StudyStore& store, StudyOutcome& outcome);

// Answers the points of the shard that the store does not hold yet, on all cores, and keeps each as it
// ends. A point without an answer is kept with the reason. progress: called with the fraction done; may
// be empty.
StudyOutcome run_study(const Study& study, const StudyShard& shard, StudyStore& store,
                       const std::function<void(double)>& progress,
                       Plausible judged = Plausible::kScene);

}  // namespace viscard
