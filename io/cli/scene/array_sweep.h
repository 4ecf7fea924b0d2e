#pragma once

#include "io/cli/words/streams.h"
#include "io/scenes/scene_file.h"
#include "models/scene/common/scene_answer.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

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

// Answers of a sweep, point by point: results that carry the point's label.
using SweepRow = std::vector<SceneResult>;

// The points that are done, on disk while the sweep runs: one line each, appended and flushed as it
// ends. The first line holds a key of the scene, so that points of another one are not taken over.
class SweepStore {
 public:
  // An empty folder keeps nothing. Reads what an earlier run with the same key left.
  SweepStore(const std::filesystem::path& folder, const std::string& key);
  const std::map<std::size_t, SweepRow>& done() const { return done_; }
  void add(std::size_t point, const SweepRow& row);
  void remove();  // the sweep is complete and stored elsewhere

 private:
  void read(const std::string& key);
  std::filesystem::path path_;
  std::map<std::size_t, SweepRow> done_;
};

// One answer of the whole sweep: every result as "name at label", and, with a limit, for each
// combination of the other parameters the first spacing whose deviation lies below it:
// "first_spacing at diameter 40 um" (none, no result). Its error reaches to the spacings that lie
// above and below the limit for certain. Where the deviation exceeds the limit again at a larger
// spacing, because it changes its sign, a note says so, and "settled_spacing" is the one from which
// on it stays below.
SceneAnswer joined(const ArraySweep& sweep, const std::vector<SweepPoint>& points,
                   const std::map<std::size_t, SweepRow>& rows);

// Columns diameter_m, spacing_m, thickness_m, then value and error estimate of each result.
std::string csv_from_sweep(const std::vector<SweepPoint>& points,
                           const std::map<std::size_t, SweepRow>& rows, const std::string& command);

}  // namespace viscard
