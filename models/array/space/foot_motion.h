#pragma once

#include "models/array/contact/press_on_base.h"
#include "models/array/space/space_array.h"

#include <vector>

namespace viscard {

// How a film on a backing moves under the feet of pillars when forces and moments act on all of
// them: the work of each foot's traction on the film's displacement (eq. S11). The array must
// outlive this object.
class FootMotion {
 public:
  explicit FootMotion(const SpaceArray& array);

  // For some pillars of the array, which alone bear loads.
  YieldingBase under(const std::vector<std::size_t>& pillars) const;

  // Sinking under the pillar's own force, m/N.
  double own_sinking_m_N(int of_class) const;

 private:
  struct Foot {
    FootForces forces;
    double area_m2 = 0.0;
    double lever_m3 = 0.0;        // moment of the top per Pa of a tilting traction
    double turning_rad_Nm = 0.0;  // under its own moment
  };
  // Motions under pillars of all classes at an offset from a loaded one: sinking and two slopes of each
  // class x force and moments.
  Eigen::MatrixXd kernel(int of_class, double x_m, double y_m) const;
  double own_turning_J_Pa2(const FilmTable& film, const FootForces& foot) const;

  const SpaceArray* array_;
  std::vector<Foot> feet_;  // by class
  // By class of the pillar that moves, then of the one that is loaded: work on the film's motion, m^3/Pa,
  // of a foot under 1 Pa of pressure, per value of TopLoad.
  std::vector<std::vector<WideTable>> works_;
};

// How far the foot of a pillar sinks into the film under a pressure on its top, m/Pa: the work of its
// traction on the film (eq. S9).
double foot_settling_m_Pa(const LayeredFilm& film, const FootForces& foot);

}  // namespace viscard
