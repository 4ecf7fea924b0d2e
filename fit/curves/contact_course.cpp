#include "fit/curves/contact_course.h"

#include "models/maths/branch_step.h"

#include <vector>

namespace viscard {
namespace {

// The branches of the series, driven by the depth of the surface since contact.
class Surface {
 public:
  Surface(const PronySeries& series, double at_rest_m)
      : series_(series), q_m_(series.terms.size()), depth_m_(at_rest_m), rest_m_(at_rest_m) {
    for (const MaxwellTerm& term : series.terms) steps_.emplace_back(term.relaxation_time_s);
  }

  // Takes a step; returns true if the surface is free at its end.
  bool advance(double dt_s, double punch_m) {
    // Without force: E_inf (u + du) + sum E_i (decay q_i + gain du) = 0.
    double pull = series_.equilibrium_modulus_Pa * (depth_m_ - rest_m_);
    double stiffness = series_.equilibrium_modulus_Pa;
    for (std::size_t i = 0; i < q_m_.size(); ++i) {
      const BranchStep& step = steps_[i].of(dt_s);
      pull += series_.terms[i].modulus_Pa * step.decay * q_m_[i].value;
      stiffness += series_.terms[i].modulus_Pa * step.gain;
    }
    const double free_m = stiffness > 0.0 ? depth_m_ - pull / stiffness : depth_m_;
    const bool is_free = punch_m <= free_m;
    const double change_m = (is_free ? free_m : punch_m) - depth_m_;
    for (std::size_t i = 0; i < q_m_.size(); ++i) q_m_[i].advance(steps_[i].of(dt_s), change_m);
    depth_m_ += change_m;
    return is_free;
  }
  double depth_m() const { return depth_m_; }

 private:
  const PronySeries& series_;
  std::vector<StepsOfBranch> steps_;
  std::vector<BranchState> q_m_;
  double depth_m_, rest_m_;
};

}  // namespace

std::size_t count_contacts(const std::vector<char>& is_free, std::size_t first) {
  constexpr std::size_t kLeast = 3;
  std::size_t count = 1, free_run = 0, contact_run = 0;
  bool was_free = false;
  for (std::size_t k = first; k < is_free.size(); ++k) {
    free_run = is_free[k] ? free_run + 1 : 0;
    contact_run = is_free[k] ? 0 : contact_run + 1;
    if (free_run >= kLeast) was_free = true;
    if (!was_free || contact_run < kLeast) continue;
    was_free = false;
    ++count;
  }
  return count;
}

ContactCourse contact_course(const Course& punch_m, double contact_m, std::size_t first,
                             const PronySeries& series) {
  ContactCourse course;
  for (const CoursePoint& sample : punch_m) course.surface_m.push_back(sample.value);
  course.is_free.assign(punch_m.size(), 0);
  Surface surface(series, contact_m);
  double last_s = punch_m[first > 0 ? first - 1 : first].time_s;
  for (std::size_t k = first; k < punch_m.size(); ++k) {
    course.is_free[k] = surface.advance(punch_m[k].time_s - last_s, punch_m[k].value) ? 1 : 0;
    course.surface_m[k] = surface.depth_m();
    last_s = punch_m[k].time_s;
  }
  course.n_contacts = count_contacts(course.is_free, first);
  return course;
}

}  // namespace viscard
