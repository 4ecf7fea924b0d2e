#pragma once

#include <span>
#include <vector>

namespace viscard {

// How a quantity goes in time: a load, a stretch, a surface. It is linear from point to point; two points at one
// time are a jump.
struct CoursePoint {
  double time_s = 0.0;
  double value = 0.0;  // in the unit of the quantity
};
// By ascending time.
using Course = std::vector<CoursePoint>;

// Two columns of equal length as a course; each value in the unit of the quantity. Throws std::invalid_argument if they are not.
Course course_from_columns(std::span<const double> time_s, std::span<const double> value);

// Value at a time between two points.
double value_between(const CoursePoint& from, const CoursePoint& to, double time_s);

// Value at a time, or just before it if it may be a jump; 0 before the first point, and the last value after the
// last one.
double value_at(const Course& course, double time_s, bool after = true);

// The largest size of a value; 0 without points.
double largest_size(const Course& course);

}  // namespace viscard
