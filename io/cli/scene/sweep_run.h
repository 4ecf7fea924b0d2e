#pragma once

#include "io/cli/words/streams.h"
#include "io/flow/sweep/study.h"
#include "io/scenes/scene_file.h"
#include "models/answer/scene_answer.h"

#include <string>

namespace viscard {

struct SweepOutput {
  std::string folder;   // empty: nothing is written
  std::string command;  // recorded in the files
  bool overwrite = false;
};

// The file of a folder that holds the points that are done while a sweep runs.
inline constexpr const char* kPartOfSweep = "sweep.part.sqlite";

// What the points in that file depend on.
Study study_of_sweep(const SceneFile& file, const std::string& path);

// Solves every point of a sweep over rows of pillars, and writes sweep.csv and its pictures. With a
// folder it keeps the finished points in kPartOfSweep, a store of a study (study_store.h), so that
// a sweep that was stopped continues: the points of an earlier run are not computed again if scene,
// materials and tolerance are the same. One program at a time works in a folder. `path` is the
// scene file.
SceneAnswer run_sweep(const SceneFile& file, const std::string& path, const SweepOutput& output,
                      Streams& streams);

}  // namespace viscard
