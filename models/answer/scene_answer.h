#pragma once

#include "models/answer/discretisation.h"

#include <complex>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace viscard {

class ResultVisitor;

// One number that a scene gives.
struct SceneResult {
  std::string name;
  double value = 0.0;  // in the unit
  std::string unit;
  double error_estimate = 0.0;  // absolute, in the unit
  double scale = 0.0;           // the error is relative to the larger of |value| and this
  bool is_wanted = true;        // false: not asked for, and its error is not watched
  // Relative error that the solution itself shows without other meshes; part of the estimate.
  double unresolved = 0.0;
  // The curve from which it is read; its error is at least the curve's there.
  std::string curve = {};
  double x = 0.0;         // where on the curve
  double left_out = 0.0;  // error that every mesh has, in the unit; part of the estimate
};

// One mode of vibration.
struct SceneMode {
  std::string family;
  int harmonic = 0;
  double frequency_Hz = 0.0;
  double error_estimate = 0.0;          // Hz
  double unresolved = 0.0;              // as that of a result
  std::optional<double> damping_ratio;  // of a material that relaxes; the error is absolute
  double damping_error = 0.0;           // of damping_ratio, absolute
};

// Decision of the plan on one effect.
struct SceneEffect {
  std::string name;
  bool on = false;
  std::string reason;
  double estimate = 0.0;    // relative error of leaving it out
  std::string number;       // the number that decides
  double value = 0.0;       // of that number
  bool is_forced = false;   // by the scene
  bool is_counted = false;  // left out, and its estimate is part of the reported error
  bool is_choice = false;   // the plan or the scene chose; others are needed or have no part in it
  bool is_outside = false;  // no analysis can compute it; the estimate is a warning
};

// A quantity against time or frequency. A scene's curves have the same abscissa on every mesh.
struct SceneCurve {
  std::string name;  // of the second column
  std::string unit;
  std::vector<double> x;
  std::vector<double> value;  // at each x, in the unit
  std::string x_name = "time_s";
  std::vector<double> error;    // estimate at each point, in the unit
  std::vector<double> allowed;  // size at each point that the tolerance refers to; empty: the peak
  bool is_watched = true;       // false: derived from a watched curve, which sets its error
  // Two meshes may agree at a point because their curves cross there, never over this stretch of x:
  // the error at a point is the largest one within it on either side. 0: each point by itself.
  double span = 0.0;
  // Error at each point that the answer itself shows, in the unit; part of the estimate.
  std::vector<double> left_out = {};
};

// A pillar of an array in the plane, and the load on its top.
struct ScenePillar {
  int row = 1, column = 1;  // from 1
  double x_m = 0.0, y_m = 0.0, diameter_m = 0.0;
  double pressure_Pa = 0.0, shear_x_Pa = 0.0, shear_y_Pa = 0.0;
  bool is_loaded() const { return pressure_Pa != 0.0 || shear_x_Pa != 0.0 || shear_y_Pa != 0.0; }
};

// The array that the maps of an answer belong to.
struct SceneArray {
  int rows = 0, columns = 0;              // places where no pillar stands have no entry below
  double cell_x_m = 0.0, cell_y_m = 0.0;  // room of one pillar
  double left_m = 0.0, right_m = 0.0, low_m = 0.0, high_m = 0.0;  // the film
  std::vector<ScenePillar> pillars;                               // ascending by row, then column
};

// A quantity that pillars of an array have.
struct SceneMap {
  std::string name, unit;
  std::vector<std::size_t> pillar;  // of each value, as index into SceneArray::pillars
  std::vector<double> value;        // in the unit
  std::vector<double> error;        // estimate of each value, in the unit
  double scale = 0.0;      // errors are relative to the largest magnitude, or to this if larger
  bool is_watched = true;  // false: its error has another source than the mesh, or does not count
};

// All that a scene gives.
struct SceneAnswer {
  std::vector<SceneResult> results;
  std::vector<SceneMode> modes;
  std::vector<SceneEffect> effects;
  std::vector<SceneCurve> curves;
  SceneArray array;  // without pillars unless there are maps
  std::vector<SceneMap> maps;
  std::vector<std::string> notes;  // remarks for the reader, plain sentences
  Discretisation discretisation;   // that met the tolerance
  int unknowns = 0;                // of the largest system
  double largest_relative_error = 0.0;
  bool within_tolerance = true;  // every error estimate; set by simulate()
  double step_error = 0.0;  // relative, of time steps and reduced bases; part of the errors above
};

// The keys of a list "effects"; an effect that has nothing to act on has no estimate.
bool acts(const SceneEffect& effect);
void show_keys(ResultVisitor& v, const SceneEffect& effect);
// An answer in parts, because a command shows others between them: mesh, effects, maps and modes, then
// notes, places of pillars, then results, each in the order of names.
void show_solution(ResultVisitor& v, const SceneAnswer& answer);
void show_notes(ResultVisitor& v, const SceneAnswer& answer);
void show_results(ResultVisitor& v, const SceneAnswer& answer);
// Numbers of a map by pillar, NaN for pillars without one.
// numbers: one for each pillar, in the unit of the map.
std::vector<double> by_pillar(const SceneArray& array, const SceneMap& map,
                              const std::vector<double>& numbers);

// Adds a complex amplitude over frequency: curves of its real and imaginary part, magnitude and
// phase, and the magnitude at either end. `allowed` is the size that the tolerance refers to.
struct Sweep {
  // Amplitude at each frequency and the size that the tolerance refers to, in the unit.
  std::vector<std::complex<double>> value;
  // As above.
  std::vector<double> allowed;
};
// Adds the curves of a sweep to the answer.
void add_sweep(const std::string& name, const std::string& unit,
               const std::vector<double>& frequencies_Hz, const Sweep& sweep, SceneAnswer& answer);

// Sets what a curve lacks, from `parts`, the curves with a share of its modes or basis vectors each, and
// these `shares`. A load with
// kinks excites what lies beyond N of them as 1/N: what is left out is as much as the second half
// changed, a third of what the last three quarters did, and so on; the largest of these.
void set_left_out(std::span<const double> shares, const std::vector<std::vector<double>>& parts,
                  SceneCurve& curve);

// Largest magnitude of the values.
double largest_size(const std::vector<double>& values);
// The size that the tolerance of a map refers to.
double size_of(const SceneMap& map);

}  // namespace viscard
