#pragma once

#include "models/array/film/layered_film.h"

#include <Eigen/Core>

#include <vector>

namespace viscard {

// How the quarters of a disc read a potential: voltages = weights * potentials at the points (4 x points).
struct QuarterRule {
  std::vector<Eigen::Vector2d> points_m;  // from the middle of the disc
  Eigen::MatrixXd weights;
};

// Means over the quarters 1 (+,+), 2 (-,+), 3 (-,-), 4 (+,-) of a disc, by `count` squared Gauss points in each.
QuarterRule quarter_means(double radius_m, int count);

// A polynomial of the disc of radius 1, R_n^m(r) cos(m alpha) or sin(m alpha) (Zernike).
struct DiscFunction {
  int degree = 0;  // n
  int order = 0;   // m
  bool is_sine = false;
};

// How finely charges and potentials are resolved.
struct MetalQuartersAccuracy {
  int cells = 12;        // along each side of a quarter
  int polynomials = 10;  // degree of the potential over the disc
  int film_degree = 8;
};

// Quarters of a disc as four conductors with gaps between them, on the face of the film that is read (eq. S19,
// models/array/space): each at one voltage and without net charge. The film's potential per charge is averaged over the
// directions. Potentials are polynomials over the disc, charges what these read of them.
class MetalQuarters {
 public:
  // The gap is that between the straight edges of two quarters.
  MetalQuarters(const LayeredFilm& film, double radius_m, double gap_m,
                const MetalQuartersAccuracy& accuracy);

  // Coefficients of potential, the voltage of each quarter per charge on each.
  const Eigen::Matrix4d& potentials_V_C() const { return potentials_V_C_; }
  // Capacitance of a quarter between others that take no charge.
  double capacitance_F() const { return 1.0 / potentials_V_C_(0, 0); }

  const std::vector<DiscFunction>& functions() const { return functions_; }
  // Voltage of each quarter per amplitude of each polynomial: 4 x functions.
  const Eigen::MatrixXd& readings() const { return readings_; }
  // Charge that each potential induces on the quarters, C per V, functions x functions: the integral of the charge times
  // the first polynomial, the potential being the second one. Symmetric.
  const Eigen::MatrixXd& induced() const { return induced_; }
  // Amplitude of each polynomial in the wave J_m(k r) cos(m alpha), or sin.
  Eigen::VectorXd transforms(double k_1_m) const;
  // Weight of a wave around the middle in the mean of the four voltages.
  double weight(double k_1_m) const;

  // Points of the disc and what each quarter weighs them with; polynomials up to this degree, at most that of the accuracy.
  QuarterRule rule(int degree) const;
  // Amplitudes of the polynomials from the potentials at the points of the rule of the accuracy: functions x points.
  Eigen::MatrixXd amplitudes_from_points() const;

 private:
  double radius_m_;
  int degree_;
  std::vector<DiscFunction> functions_;
  Eigen::Matrix4d potentials_V_C_;
  Eigen::MatrixXd readings_, induced_;
};

// Potential of a point charge on the face that is read, V/C by distance.
class PointCharge {
 public:
  PointCharge(const LayeredFilm& film, double reach_m, int film_degree);
  // Of the film alone as a half-space limit/(2 pi r), without what the other face adds.
  double near_Vm_C() const { return near_Vm_C_; }
  double added_V_C(double distance_m) const;  // by the other face; smooth
  // The whole potential; distance_m > 0.
  double at(double distance_m) const { return near_Vm_C_ / distance_m + added_V_C(distance_m); }

 private:
  double near_Vm_C_ = 0.0, step_m_ = 0.0;
  std::vector<double> added_V_C_;  // at multiples of the step
};

}  // namespace viscard
