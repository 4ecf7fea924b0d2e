#pragma once

#include "io/capture/sqlite_database.h"
#include "io/flow/scenes/named_values.h"
#include "io/flow/sweep/study.h"

#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <vector>

namespace viscard {

// The answer of one point.
struct StudyPoint {
  std::int64_t point = 0;  // from 0
  StudyValues values;
  std::vector<NamedValue> results;
  std::string failure;  // why there is no answer; empty: there is
};

// A point as bytes, for another process; the numbers are the same bit for bit.
std::string bytes_from_point(const StudyPoint& point);
// Throws std::runtime_error if these are not the bytes of a point.
StudyPoint point_from_bytes(const std::string& bytes);

// The points that are done, in an SQLite file: table `points`, one row for each, with the values of the
// parameters and the results as JSON. A row is there as soon as add() returns, and survives kill -9; no
// point is there twice.
class StudyStore {
 public:
  // Opens or creates the file. Throws std::runtime_error if it belongs to another study.
  StudyStore(const std::filesystem::path& path, const Study& study);

  std::set<std::int64_t> done();
  void add(const StudyPoint& point);
  // The same for several points at once, which costs little more than for one: all or none are there.
  void add(const std::vector<StudyPoint>& points);
  // Takes over the points of another file of the same study that are not here yet; returns their number.
  std::int64_t merge(const std::filesystem::path& other, const Study& study);
  // All points in their order.
  void for_each(const std::function<void(const StudyPoint&)>& take);

 private:
  Database database_;
  Statement insert_;
};

// Columns: point, the parameters, then value and error estimate of each result, then why a point has no
// answer.
std::string csv_from_study(StudyStore& store, const Study& study);

}  // namespace viscard
