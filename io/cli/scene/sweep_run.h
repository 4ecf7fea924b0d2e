#pragma once

#include "io/cli/words/streams.h"
#include "io/scenes/scene_file.h"
#include "models/answer/scene_answer.h"

#include <string>

namespace viscard {

struct SweepOutput {
  std::string folder;   // empty: nothing is written
  std::string command;  // recorded in the files
  bool overwrite = false;
};

// Solves every point of a sweep over rows of pillars, and writes sweep.csv and its pictures. With a
// folder it keeps the finished points in sweep.part.csv, so that a sweep that was stopped continues:
// the points of an earlier run are not computed again. `path` is the scene file.
SceneAnswer run_sweep(const SceneFile& file, const std::string& path, const SweepOutput& output,
                      Streams& streams);

}  // namespace viscard
