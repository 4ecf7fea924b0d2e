#include "models/maths/golden_section.h"
#include "models/maths/text_of_number.h"
#include "models/pillar/analyses/analysis.h"
#include "models/pillar/analyses/scene_body.h"
#include "models/pillar/analyses/simulate_pillar.h"
#include "models/pillar/analyses/top_load.h"
#include "models/pillar/analyses/wave_mesh.h"
#include "models/pillar/body/pillar_model.h"
#include "models/pillar/time/harmonic_response.h"
#include "models/pillar/time/model_reduction.h"

#include <cmath>
#include <complex>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <string>

namespace viscard {
namespace {

using Complex = std::complex<double>;

const HarmonicDrive& harmonic_drive(const PillarScene& scene) {
  return std::get<HarmonicDrive>(scene.drive);
}

constexpr double kTwoPi = 2.0 * std::numbers::pi;

// Up to this many frequencies are solved one by one on the whole body.
constexpr std::size_t kMostDirect = 16;

// Answers one frequency at a time. The tolerance of an output is relative to |y| + |omega
// dy/domega|: a curve must be right within the tolerance either in amplitude or in frequency. Near
// a pole no mesh can give more.
class Response {
 public:
  Response(const PillarScene& scene, const SceneBody& body, const ReducedBody& reduced)
      : is_base_(load_place(scene) == LoadPlace::kBase),
        solver_(reduced.system),
        mass_(dense(reduced.system.mass)) {
    const double area_m2 = top_area_m2(*body.model);
    const double sign = is_lateral(scene) ? 1.0 : -1.0;  // a pressure pushes down
    sides_.resize(reduced.basis.cols(), static_cast<Eigen::Index>(1 + body.outputs.size()));
    sides_.col(0) =
        is_base_
            ? reduced.load(-base_acceleration_m_s2(scene) * unit_acceleration_force(*body.model))
            : reduced.load(sign * pressure_Pa(scene) * area_m2 * body.system.load);
    for (std::size_t i = 0; i < body.outputs.size(); ++i) {
      sides_.col(static_cast<Eigen::Index>(i + 1)) = reduced.load(body.outputs[i].row);
    }
    base_acceleration_m_s2_ = base_acceleration_m_s2(scene);
  }

  // Adds the values of all outputs, and the reference values of the tolerance.
  void add(double frequency_Hz, std::vector<Sweep>& sweeps) const {
    const double omega = kTwoPi * frequency_Hz;
    const Eigen::MatrixXcd answers = solver_.solve(omega, sides_.cast<Complex>());
    const Eigen::VectorXcd inertia = 2.0 * omega * omega * (mass_ * answers.col(0));
    for (std::size_t i = 0; i < sweeps.size(); ++i) {
      const auto column = static_cast<Eigen::Index>(i + 1);
      Complex value = sides_.col(column).cast<Complex>().transpose() * answers.col(0);
      // The load's response to the dual load: omega dy/domega without the slope of the moduli.
      const Complex slope = answers.col(column).transpose() * inertia;
      double size = std::abs(value) + std::abs(slope);
      if (is_base_ && i == 0) {  // relative to the base so far
        value = (value - base_acceleration_m_s2_ / (omega * omega)) /
                (-base_acceleration_m_s2_ / (omega * omega));
        size = std::abs(value) + (2.0 * size) * omega * omega / std::abs(base_acceleration_m_s2_);
      }
      sweeps[i].value.push_back(value);
      sweeps[i].allowed.push_back(size);
    }
  }

  // Frequency near a peak of |y| on the grid where it is largest.
  double peak_between(double low_Hz, double high_Hz, std::size_t output) const {
    const auto minus_size = [&](double f) {
      std::vector<Sweep> one(static_cast<std::size_t>(sides_.cols() - 1));
      add(f, one);
      return -std::abs(one[output].value[0]);
    };
    return golden_section(minus_size, low_Hz, high_Hz, 1e-9 * high_Hz).middle();
  }

 private:
  bool is_base_;
  HarmonicSolver solver_;
  Eigen::MatrixXd mass_;
  Eigen::MatrixXd sides_;  // load, then outputs as dual loads
  double base_acceleration_m_s2_ = 0.0;
};

// Resonances of the first output inside the sweep.
void add_peaks(const PillarScene& scene, const Response& response, const std::string& name,
               const Sweep& sweep, SceneAnswer& answer) {
  const std::vector<double>& f = harmonic_drive(scene).frequencies_Hz;
  int number = 0;
  for (std::size_t i = 1; i + 1 < f.size() && number < 9; ++i) {
    const double here = std::abs(sweep.value[i]);
    if (here <= std::abs(sweep.value[i - 1]) || here < std::abs(sweep.value[i + 1])) continue;
    answer.results.push_back({name + "_resonance_" + std::to_string(++number),
                              response.peak_between(f[i - 1], f[i + 1], 0), "Hz"});
  }
}

// Notes frequencies at which the tolerance does not determine the amplitude.
void note_poles(const PillarScene& scene, const Sweep& sweep, SceneAnswer& answer) {
  std::string list;
  int count = 0;
  for (std::size_t i = 0; i < sweep.value.size(); ++i) {
    const double size = std::abs(sweep.value[i]);
    if (sweep.allowed[i] * scene.tolerance < 0.5 * size) continue;
    if (++count > 4) continue;
    list += (count > 1 ? ", " : "") + text_of(harmonic_drive(scene).frequencies_Hz[i], 8);
  }
  if (count == 0) return;
  // A coarse mesh may have a resonance where the pillar has none; every answer reaches degree 5.
  if (harmonic_drive(scene).frequencies_Hz.size() == 1 && answer.discretisation.degree >= 5) {
    throw std::runtime_error("at " + list +
                             " Hz the pillar is on a resonance, or a node between two, with too "
                             "little damping: the amplitude changes too sharply with frequency for "
                             "the tolerance. Choose another frequency, or a material with damping");
  }
  answer.notes.push_back(std::to_string(count) + " of the frequencies (" + list +
                         (count > 4 ? ", ..." : "") +
                         " Hz) lie on a resonance or a node too sharp for the tolerance; the error "
                         "column shows by how much");
}

Motion harmonic_motion(const PillarScene& scene) {
  return is_lateral(scene) ? lateral_motion(scene) : axial_motion(scene);
}

bool is_solved_one_by_one(const PillarScene& scene) {
  return harmonic_drive(scene).frequencies_Hz.size() <= kMostDirect;
}

std::vector<double> angular_frequencies(const PillarScene& scene) {
  std::vector<double> omega;
  for (const double f : harmonic_drive(scene).frequencies_Hz) omega.push_back(kTwoPi * f);
  return omega;
}

SceneBody harmonic_body(const PillarScene& scene, SceneAnswer& answer) {
  if (!scene.discretisation) {
    const WaveMesh mesh = wave_mesh(scene, harmonic_drive(scene).frequencies_Hz);
    answer.discretisation.longest_m = mesh.longest_m;
    answer.discretisation.skin_m = mesh.skin_m;
    answer.discretisation.skin_at_foot = load_place(scene) == LoadPlace::kBase;
  }
  return body_of(scene, harmonic_motion(scene), {.with_mass = true}, answer);
}

std::vector<Eigen::VectorXd> loads_of(const PillarScene& scene, const SceneBody& body) {
  std::vector<Eigen::VectorXd> loads = {body.system.load};
  if (load_place(scene) == LoadPlace::kBase) loads.push_back(unit_acceleration_force(*body.model));
  return loads;
}

// The voltage of a film is a small share of the energy, in which the errors of a basis are measured. With
// its dual solution in the basis too, it errs as the product of both errors.
std::vector<Eigen::VectorXd> loads_and_duals(const PillarScene& scene, const SceneBody& body) {
  std::vector<Eigen::VectorXd> sides = loads_of(scene, body);
  for (std::size_t i = 1; i < body.outputs.size(); ++i) {
    sides.push_back(output_of_motion(body.system, body.outputs[i].row));
  }
  return sides;
}

ReducedBody reduced_for(const PillarScene& scene, const SceneBody& body) {
  const bool is_electric = body.model->options().electrodes.has_value();
  if (const NearbyPillar* nearby = nearby_of(scene, harmonic_motion(scene), is_electric)) {
    return restricted_to(body.system, nearby->reduced().basis);
  }
  if (is_solved_one_by_one(scene)) {
    return reduce_at(body.system, loads_of(scene, body), angular_frequencies(scene));
  }
  const DynamicRange range{.lowest_rad_s = kTwoPi * harmonic_drive(scene).frequencies_Hz.front(),
                           .highest_rad_s = kTwoPi * harmonic_drive(scene).frequencies_Hz.back(),
                           .tolerance = 0.1 * scene.tolerance};
  ReducedBody reduced = reduce_dynamic(body.system, loads_and_duals(scene, body), range);
  if (reduced.sound_up_to_rad_s < range.highest_rad_s) {
    throw std::runtime_error(
        "a sweep over that many modes meets the tolerance up to about " +
        text_of(reduced.sound_up_to_rad_s / kTwoPi, 4) +
        " Hz only: end it there, or ask for at most " + std::to_string(kMostDirect) +
        " frequencies, which are solved one by one, or for a larger tolerance");
  }
  return reduced;
}

void check_harmonic(const PillarScene& scene) {
  const std::vector<double>& f = harmonic_drive(scene).frequencies_Hz;
  check_frequencies(f);
  if (load_place(scene) == LoadPlace::kTop ? pressure_Pa(scene) == 0.0
                                           : base_acceleration_m_s2(scene) == 0.0) {
    throw std::invalid_argument(
        "a harmonic analysis needs a pressure on the top or an acceleration of the base");
  }
  check_sideways_in_time(scene);
  wave_mesh(scene, f);  // refuses waves that no mesh can resolve
}

void run_harmonic(const PillarScene& scene, SceneAnswer& answer) {
  const std::vector<double>& f = harmonic_drive(scene).frequencies_Hz;
  const SceneBody body = harmonic_body(scene, answer);
  const ReducedBody reduced = reduced_for(scene, body);
  answer.step_error = reduced.error;
  const Response response(scene, body, reduced);
  std::vector<Sweep> sweeps(body.outputs.size());
  for (const double frequency_Hz : f) response.add(frequency_Hz, sweeps);
  const bool is_base = load_place(scene) == LoadPlace::kBase;
  const std::string first = is_base ? "transmissibility" : "top_displacement";
  add_sweep(first, is_base ? "1" : "m", f, sweeps[0], answer);
  if (!is_solved_one_by_one(scene)) add_peaks(scene, response, first, sweeps[0], answer);
  note_poles(scene, sweeps[0], answer);
  for (const BodyReading& reading : readings_of(scene, body, answer)) {
    Sweep read = sweeps[reading.output];
    for (std::size_t i = 0; i < read.value.size(); ++i) {
      const Complex gain = viscard::response(reading.filter, kTwoPi * f[i]);
      read.value[i] *= gain;
      read.allowed[i] *= std::abs(gain);
    }
    add_sweep(reading.name, reading.unit, f, read, answer);
    note_film_error(reading, answer);
  }
}

// With the solutions and the dual solutions at a few frequencies, which are solved one by one.
NearbyPillars harmonic_nearby(const PillarScene& scene, const Discretisation& mesh) {
  SceneAnswer scratch;
  scratch.discretisation = mesh;
  const SceneBody body = harmonic_body(scene, scratch);
  NearbyPillars nearby;
  if (!is_solved_one_by_one(scene) || !scene.fixed_bottom) return nearby;
  std::vector<Eigen::VectorXd> outputs;
  for (std::size_t i = 1; i < body.outputs.size(); ++i) outputs.push_back(body.outputs[i].row);
  const ReducedBody reduced =
      reduce_at(body.system, loads_and_duals(scene, body), angular_frequencies(scene));
  nearby.push_back(std::make_unique<NearbyPillar>(scene.geometry, scratch.discretisation,
                                                  media_of(scene), body.model->options()));
  if (scene.readout || !scene.film_loss.is_lossless()) nearby.back()->solve();
  nearby.back()->keep_reduced({nearby_basis(body.system, reduced.basis, outputs)});
  return nearby;
}

std::vector<std::string> harmonic_names(const PillarScene& scene) {
  const bool is_base = load_place(scene) == LoadPlace::kBase;
  std::vector<std::string> endings = {"_real",  "_imaginary", "_magnitude",
                                      "_phase", "_at_lowest", "_at_highest"};
  for (char number = '1'; number <= '9'; ++number) {
    endings.push_back(std::string("_resonance_") + number);
  }
  return moving_names(scene, is_base ? "transmissibility" : "top_displacement", endings);
}

// An oscillating load pushes half of the time with either sign.
double harmonic_push_Pa(const PillarScene& scene) {
  return std::abs(harmonic_drive(scene).pressure_Pa);
}

double lowest_frequency_Hz(const PillarScene& scene) {
  return harmonic_drive(scene).frequencies_Hz.front();
}

}  // namespace

Analysis harmonic_analysis() {
  return {.name = "harmonic",
          .drive = HarmonicDrive{},
          .has_inertia = true,
          .relaxes = true,
          .swings_from_Hz = lowest_frequency_Hz,
          .free_bottom = FreeBottom::kMoves,
          .check = check_harmonic,
          .result_names = harmonic_names,
          .run = run_harmonic,
          .push_Pa = harmonic_push_Pa,
          .solve_nearby = harmonic_nearby};
}

}  // namespace viscard
