#include "fit/large_strain/large_strain_data.h"

namespace viscard {

StretchHistory history_of(const LargeStrainTest& test) {
  StretchHistory history = test.before;
  history.time_s.insert(history.time_s.end(), test.time_s.begin(), test.time_s.end());
  history.stretch.insert(history.stretch.end(), test.stretch.begin(), test.stretch.end());
  return history;
}

}  // namespace viscard
