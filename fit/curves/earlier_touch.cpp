#include "fit/curves/earlier_touch.h"

#include "fit/curves/contact_course.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace viscard {

BranchState left_by(const Course& touch, double at_s, double tau_s) {
  BranchState state;
  for (std::size_t i = 1; i <= touch.size() && touch[i - 1].time_s < at_s; ++i) {
    const double end_s = i < touch.size() ? std::min(touch[i].time_s, at_s) : at_s;
    const BranchStep step(end_s - touch[i - 1].time_s, tau_s, /*with_slope=*/true);
    state.advance(step, value_at(touch, end_s) - touch[i - 1].value);
  }
  return state;
}

Course earlier_touch(const Course& punch_m, const PronySeries& series) {
  const auto touched = std::find_if(punch_m.begin(), punch_m.end(),
                                    [](const CoursePoint& at) { return at.value > 0.0; });
  if (touched == punch_m.end()) return {};
  const auto first = static_cast<std::size_t>(touched - punch_m.begin());
  const ContactCourse course = contact_course(punch_m, 0.0, first, series);
  Course touch;
  if (first > 0) touch.push_back({punch_m[first - 1].time_s, 0.0});
  for (std::size_t k = first; k < punch_m.size(); ++k) {
    touch.push_back({punch_m[k].time_s, course.surface_m[k]});
  }
  return touch;
}

double relative_change(const Course& a, const Course& b) {
  double change_m = 0.0;
  for (const Course* course : {&a, &b}) {
    for (const CoursePoint& at : *course) {
      change_m = std::max(change_m, std::abs(value_at(a, at.time_s) - value_at(b, at.time_s)));
    }
  }
  const double deepest_m = std::max(largest_size(a), largest_size(b));
  return deepest_m > 0.0 ? change_m / deepest_m : 0.0;
}

}  // namespace viscard
