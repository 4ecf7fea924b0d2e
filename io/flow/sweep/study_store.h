#pragma once

#include "io/basics/written_path.h"
#include "io/capture/sqlite_database.h"
#include "io/flow/scenes/named_values.h"
#include "io/flow/sweep/study.h"
#include "io/flow/sweep/study_lock.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace viscard {

// What became of a point.
enum class PointKind {
  kAnswered,
  kRefused,  // outside the model: an answer as well, which would be the same again
  kError,    // an error of the program; --retry-failed answers it again
  kPassing,  // memory, disk or a file that changed: not kept, so that it is answered next time
};

// The answer of one point.
struct StudyPoint {
  std::int64_t point = 0;  // from 0
  StudyValues values;
  std::vector<NamedValue> results;
  std::string failure;  // why there is no answer; empty: there is
  PointKind kind = PointKind::kAnswered;
};

// A point as bytes, for another process; the numbers are the same bit for bit.
std::string bytes_from_point(const StudyPoint& point);
// Throws std::runtime_error if these are not the bytes of a point.
StudyPoint point_from_bytes(const std::string& bytes);

// How a store is opened.
struct StoreOptions {
  // Go on with a store of before 2026-12, which does not state the files that its points were answered
  // with.
  bool accepts_unrecorded = false;
  bool retries_failed = false;  // forget points of kind kError, so that they are answered again
  // Points will be answered: no other program may do that meanwhile (StudyLock). on_gone may be empty.
  bool is_answering = false;
  std::function<void(const std::string&)> on_gone = nullptr;
  double waits_s = 0.0;
  std::string elsewhere = "name another file with --out";  // what to do instead of going on
};

// The points that are done, in an SQLite file: table `points`, one row for each, with the values of the
// parameters and the results as JSON, and a checksum that only rows of this study and these inputs have; table `inputs`, the files that the answers depend
// on. A row is there as soon as add() returns, and survives kill -9; no point is there twice.
class StudyStore {
 public:
  // Opens or creates the file. Damaged rows are removed, so that their points are answered again. Throws
  // std::runtime_error if it belongs to another study or to other inputs, or if it is a file of another
  // kind, which is not changed.
  StudyStore(const std::filesystem::path& path, const Study& study,
             const StoreOptions& options = {});

  // False for a store whose points may have been answered with other files.
  bool has_recorded_inputs() const { return has_recorded_inputs_; }
  std::size_t n_damaged() const { return n_damaged_; }  // rows that were removed

  std::set<std::int64_t> done();
  // Numbers of points of one kind.
  std::int64_t count(PointKind kind);
  void add(const StudyPoint& point);
  // The same for several points at once, which costs little more than for one: all or none are there.
  void add(const std::vector<StudyPoint>& points);
  // Takes over the points of another file of the same study and inputs that are not here yet; returns
  // their number. The other file is not changed.
  std::int64_t merge(const std::filesystem::path& other, const Study& study,
                     const StoreOptions& options = {});
  // All points in their order.
  void for_each(const std::function<void(const StudyPoint&)>& take);

 private:
  std::optional<StudyLock> lock_;  // first: SQLite's connection must be closed before it ends
  bool has_recorded_inputs_ = true;
  Database database_;
  std::string binding_;  // what the checksum of a row begins with
  WrittenValues written_;
  std::size_t n_damaged_ = 0;
  Statement insert_;
};

// Throws what merge() of this file would, before anything is written.
void check_study_store(const std::filesystem::path& path, const Study& study,
                       const StoreOptions& options);

// Columns: point, the parameters, then value and error estimate of each result that any point has,
// then why a point has no answer.
std::string csv_from_study(StudyStore& store, const Study& study);

}  // namespace viscard
