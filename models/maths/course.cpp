#include "models/maths/course.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace viscard {

Course course_from_columns(std::span<const double> time_s, std::span<const double> value) {
  if (time_s.size() != value.size()) {
    throw std::invalid_argument("a course has as many values as times");
  }
  Course course;
  for (std::size_t i = 0; i < time_s.size(); ++i) course.push_back({time_s[i], value[i]});
  return course;
}

double value_between(const CoursePoint& from, const CoursePoint& to, double time_s) {
  const double share = (time_s - from.time_s) / (to.time_s - from.time_s);
  return from.value + share * (to.value - from.value);
}

double value_at(const Course& course, double time_s, bool after) {
  const auto next =
      std::partition_point(course.begin(), course.end(), [&](const CoursePoint& point) {
        return after ? point.time_s <= time_s : point.time_s < time_s;
      });
  if (next == course.begin()) return 0.0;
  if (next == course.end()) return course.back().value;
  return value_between(*(next - 1), *next, time_s);
}

double largest_size(const Course& course) {
  double largest = 0.0;
  for (const CoursePoint& point : course) largest = std::max(largest, std::abs(point.value));
  return largest;
}

}  // namespace viscard
