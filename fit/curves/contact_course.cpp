#include "fit/curves/contact_course.h"

#include "models/material/hereditary.h"

#include <cmath>

namespace viscard {
namespace {

// The branches of the series, driven by the depth of the surface since contact.
class Surface {
 public:
  Surface(const PronySeries& series, double at_rest_m)
      : series_(series), q_m_(series.terms.size(), 0.0), depth_m_(at_rest_m), rest_m_(at_rest_m) {}

  // Takes a step; returns true if the surface is free at its end.
  bool advance(double dt_s, double punch_m) {
    if (std::abs(dt_s - dt_s_) > 1e-10 * std::abs(dt_s_)) set_step(dt_s);
    // Without force: E_inf (u + du) + sum E_i (decay q_i + phi_1 du) = 0.
    double pull = series_.equilibrium_modulus_Pa * (depth_m_ - rest_m_);
    double stiffness = series_.equilibrium_modulus_Pa;
    for (std::size_t i = 0; i < q_m_.size(); ++i) {
      pull += series_.terms[i].modulus_Pa * decay_[i] * q_m_[i];
      stiffness += series_.terms[i].modulus_Pa * phi_[i];
    }
    const double free_m = stiffness > 0.0 ? depth_m_ - pull / stiffness : depth_m_;
    const bool is_free = punch_m <= free_m;
    const double change_m = (is_free ? free_m : punch_m) - depth_m_;
    for (std::size_t i = 0; i < q_m_.size(); ++i)
      q_m_[i] = decay_[i] * q_m_[i] + phi_[i] * change_m;
    depth_m_ += change_m;
    return is_free;
  }
  double depth_m() const { return depth_m_; }

 private:
  void set_step(double dt_s) {
    dt_s_ = dt_s;
    decay_.clear();
    phi_.clear();
    for (const MaxwellTerm& term : series_.terms) {
      const double x = dt_s / term.relaxation_time_s;
      decay_.push_back(std::exp(-x));
      phi_.push_back(phi1(x));
    }
  }

  const PronySeries& series_;
  std::vector<double> q_m_, decay_, phi_;
  double depth_m_, rest_m_, dt_s_ = -1.0;
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

ContactCourse contact_course(std::span<const double> time_s, std::span<const double> depth_m,
                             double contact_m, std::size_t first, const PronySeries& series) {
  ContactCourse course;
  course.surface_m.assign(depth_m.begin(), depth_m.end());
  course.is_free.assign(depth_m.size(), 0);
  Surface surface(series, contact_m);
  double last_s = time_s[first > 0 ? first - 1 : first];
  for (std::size_t k = first; k < depth_m.size(); ++k) {
    course.is_free[k] = surface.advance(time_s[k] - last_s, depth_m[k]) ? 1 : 0;
    course.surface_m[k] = surface.depth_m();
    last_s = time_s[k];
  }
  course.n_contacts = count_contacts(course.is_free, first);
  return course;
}

}  // namespace viscard
