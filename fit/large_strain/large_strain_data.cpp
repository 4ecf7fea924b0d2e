#include "fit/large_strain/large_strain_data.h"

namespace viscard {

Course history_of(const LargeStrainTest& test) {
  Course history = test.before;
  const Course readings = course_from_columns(test.time_s, test.stretch);
  history.insert(history.end(), readings.begin(), readings.end());
  return history;
}

}  // namespace viscard
