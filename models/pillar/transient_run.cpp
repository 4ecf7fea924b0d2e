#include "models/pillar/inertial_stepper.h"

#include <unsupported/Eigen/FFT>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>

namespace viscard {
namespace {

// Load factor just after (before) a time that may be a jump.
double factor_at(const TransientRequest& r, double time_s, bool after) {
  const auto& t = r.corner_time_s;
  const auto next = after ? std::upper_bound(t.begin(), t.end(), time_s)
                          : std::lower_bound(t.begin(), t.end(), time_s);
  if (next == t.begin()) return after || t.front() > time_s ? 0.0 : r.corner_value.front();
  const auto i = static_cast<std::size_t>(next - t.begin());
  if (next == t.end()) return r.corner_value.back();
  const double share = (time_s - t[i - 1]) / (t[i] - t[i - 1]);
  return r.corner_value[i - 1] + share * (r.corner_value[i] - r.corner_value[i - 1]);
}

// Times at which a step must end: outputs, and corners between them.
struct Stop {
  double time_s = 0.0;
  bool is_output = false;
};

std::vector<Stop> stops_of(const TransientRequest& r) {
  const double spacing_s = r.end_s / r.outputs;
  std::vector<Stop> stops;
  for (int i = 1; i <= r.outputs; ++i) stops.push_back({spacing_s * i, true});
  for (const double corner_s : r.corner_time_s) {
    const double nearest_s = spacing_s * std::round(corner_s / spacing_s);
    const bool is_new = corner_s > 0.0 && corner_s < r.end_s;
    if (is_new && std::abs(corner_s - nearest_s) > 1e-9 * spacing_s) {
      stops.push_back({corner_s, false});
    }
  }
  std::sort(stops.begin(), stops.end(),
            [](const Stop& a, const Stop& b) { return a.time_s < b.time_s; });
  return stops;
}

Eigen::MatrixXd run_once(const ViscoelasticSystem& small, const TransientRequest& r,
                         const std::vector<Stop>& stops, const Eigen::MatrixXd& observers,
                         int refinement, int& steps) {
  InertialStepper stepper(small);
  Eigen::MatrixXd values = Eigen::MatrixXd::Zero(observers.rows(), r.outputs + 1);
  const double spacing_s = r.end_s / r.outputs;
  double at_s = 0.0;
  Eigen::Index output = 0;
  for (const Stop& stop : stops) {
    double length_s = stop.time_s - at_s;
    if (std::abs(length_s - spacing_s) <= 1e-9 * spacing_s) length_s = spacing_s;
    const int n = refinement * std::max(1, static_cast<int>(std::ceil(length_s / r.first_step_s)));
    stepper.set_step(length_s / n);
    const double first = factor_at(r, at_s * (1.0 + 1e-12), true);
    const double last = factor_at(r, stop.time_s * (1.0 - 1e-12), false);
    for (int i = 0; i < n; ++i) {
      const double a = first + (last - first) * i / n;
      const double b = first + (last - first) * (i + 1) / n;
      stepper.advance(a * r.load, b * r.load);
    }
    steps += n;
    at_s = stop.time_s;
    if (stop.is_output) values.col(++output) = observers * stepper.displacement();
  }
  return values;
}

double largest_change(const Eigen::MatrixXd& now, const Eigen::MatrixXd& before) {
  double largest = 0.0;
  for (Eigen::Index row = 0; row < now.rows(); ++row) {
    const double size = now.row(row).cwiseAbs().maxCoeff();
    if (size == 0.0) continue;
    largest = std::max(largest, (now.row(row) - before.row(row)).cwiseAbs().maxCoeff() / size);
  }
  return largest;
}

}  // namespace

TransientResult run_transient(const ViscoelasticSystem& small, const TransientRequest& r,
                              const Eigen::MatrixXd& observers) {
  if (!(r.end_s > 0.0) || r.outputs < 2 || !(r.first_step_s > 0.0) || r.corner_time_s.empty() ||
      r.corner_time_s.size() != r.corner_value.size() ||
      !std::is_sorted(r.corner_time_s.begin(), r.corner_time_s.end())) {
    throw std::invalid_argument(
        "a transient needs an end, at least two outputs and a load whose times do not go back");
  }
  const std::vector<Stop> stops = stops_of(r);
  TransientResult result;
  for (int i = 0; i <= r.outputs; ++i) result.time_s.push_back(r.end_s / r.outputs * i);
  Eigen::MatrixXd last;
  int refinement = 1;
  for (int level = 0; !result.converged; ++level, refinement *= 2) {
    const Eigen::MatrixXd run = run_once(small, r, stops, observers, refinement, result.steps);
    if (level > 0) {
      const Eigen::MatrixXd better = (4.0 * run - last) / 3.0;
      if (level > 1) {
        result.error_estimate = largest_change(better, result.values);
        result.converged = result.error_estimate <= r.tolerance;
      }
      result.values = better;
    }
    last = run;
    if (!result.converged && 3 * result.steps > r.most_steps) break;
  }
  return result;
}

Spectrum amplitude_spectrum(const std::vector<double>& samples, double dt_s) {
  const std::size_t n = samples.size();
  if (n < 4 || !(dt_s > 0.0)) throw std::invalid_argument("a spectrum needs at least four samples");
  double mean = 0.0;
  for (const double x : samples) mean += x / static_cast<double>(n);
  std::vector<double> windowed(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double phase = 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n);
    windowed[i] = (samples[i] - mean) * (1.0 - std::cos(phase));  // Hann, of mean one
  }
  std::vector<std::complex<double>> transform;
  Eigen::FFT<double> fft;
  fft.fwd(transform, windowed);
  Spectrum spectrum;
  for (std::size_t k = 0; k <= n / 2; ++k) {
    spectrum.frequency_Hz.push_back(static_cast<double>(k) / (static_cast<double>(n) * dt_s));
    spectrum.amplitude.push_back(2.0 * std::abs(transform[k]) / static_cast<double>(n));
  }
  return spectrum;
}

}  // namespace viscard
