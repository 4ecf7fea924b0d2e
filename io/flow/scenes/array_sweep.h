#pragma once

#include "io/scenes/scene_file.h"
#include "models/answer/scene_answer.h"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace viscard {

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

// Solves the points that the store does not hold yet, on all cores, and keeps each in it as it ends.
// progress: called with the fraction done and the point's label; may be empty. The answer holds each
// effect as it is at the point where leaving it out costs most.
SceneAnswer solve_sweep(const SceneFile& file, SweepStore& store,
                        const std::function<void(double, const std::string&)>& progress);

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
