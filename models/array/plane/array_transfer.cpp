#include "models/array/plane/array_transfer.h"

#include "models/material/material.h"
#include "models/maths/dense.h"

#include <unsupported/Eigen/FFT>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace viscard {
namespace {

using Complex = std::complex<double>;

// Laplace transform of a history that is linear between its points and zero before the first; after
// the last point its value stays.
Complex transform_of(const Course& history, Complex s) {
  Complex sum = history.front().value * std::exp(-s * history.front().time_s) / s;
  for (std::size_t i = 1; i < history.size(); ++i) {
    const double dt_s = history[i].time_s - history[i - 1].time_s;
    const double change = history[i].value - history[i - 1].value;
    if (change == 0.0) continue;
    const Complex start = std::exp(-s * history[i - 1].time_s);
    if (dt_s == 0.0) {
      sum += change * start / s;
    } else {
      sum += change / dt_s * (start - std::exp(-s * history[i].time_s)) / (s * s);
    }
  }
  return sum;
}

}  // namespace

ArrayTransfer::ArrayTransfer(const ArrayModel& model, ArrayLoad load,
                             const std::vector<int>& loaded, const Material& pillar,
                             const ShapesInUse& in_use)
    : pillar_(pillar) {
  const int n = model.geometry().count;
  const int load_port = port_of(load);
  Eigen::VectorXd amplitude = Eigen::VectorXd::Zero(n);
  for (const int i : loaded) amplitude[i] = 1.0;
  std::vector<int> count, first;  // of each pillar's shapes
  int m = 0;
  for (int i = 0; i < n; ++i) {
    first.push_back(m);
    count.push_back(
        std::min(model.pillar().shapes, amplitude[i] != 0.0 ? in_use.of_loaded : in_use.of_others));
    m += count.back();
  }
  std::vector<int> mode_ports, top_ports, volt_ports;
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < count[static_cast<std::size_t>(i)]; ++k) {
      mode_ports.push_back(model.pillar_port(i, kFirstModePort + k));
    }
    top_ports.push_back(model.pillar_port(i, load_port));
    const int volt = std::max(model.centre_port(i), model.electrode_port(i));
    if (volt >= 0) volt_ports.push_back(volt);
  }
  voltages_ = static_cast<int>(volt_ports.size());
  std::vector<int> columns = mode_ports;
  columns.insert(columns.end(), top_ports.begin(), top_ports.end());
  const Eigen::MatrixXd all = model.chain().compliance(columns);

  // The compliance of a pillar on a fixed base scales with its own modulus; the rest is the film's.
  const Eigen::MatrixXd fixed = model.pillar().fixed_base_compliance();
  const Eigen::MatrixXd of_mode = fixed.bottomRows(model.pillar().shapes);
  Eigen::MatrixXd G = all(mode_ports, Eigen::all);
  Eigen::MatrixXd fixed_modes = Eigen::MatrixXd::Zero(m, m);
  Eigen::VectorXd in_fixed = Eigen::VectorXd::Zero(m);
  for (int i = 0; i < n; ++i) {
    const int at = first[static_cast<std::size_t>(i)];
    const int own = count[static_cast<std::size_t>(i)];
    fixed_modes.block(at, at, own, own) = of_mode.block(0, kFirstModePort, own, own);
    in_fixed.segment(at, own) = amplitude[i] * of_mode.col(load_port).head(own);
  }
  const Eigen::MatrixXd modal = G.leftCols(m);
  const EigenSystem system = symmetric_eigen(0.5 * (modal + modal.transpose()));
  const Eigen::MatrixXd& V = system.vectors;
  compliance_pillar_ = (V.transpose() * fixed_modes * V).diagonal();
  compliance_film_ = system.values - compliance_pillar_;
  in_pillar_ = V.transpose() * in_fixed;
  in_film_ = V.transpose() * (G.rightCols(n) * amplitude) - in_pillar_;
  highest_rad_s_ = 1.0 / std::sqrt(system.values[0]);

  const double to_m = metres_per_reading(load, model.geometry());
  const Eigen::Index outputs = n + voltages_;
  static_pillar_ = Eigen::VectorXd::Zero(outputs);
  static_film_.resize(outputs);
  out_pillar_ = Eigen::MatrixXd::Zero(outputs, m);
  out_film_.resize(outputs, m);
  for (int i = 0; i < n; ++i) {
    static_pillar_[i] = to_m * fixed(load_port, load_port) * amplitude[i];
    const int own = count[static_cast<std::size_t>(i)];
    out_pillar_.row(i).segment(first[static_cast<std::size_t>(i)], own) =
        to_m * of_mode.col(load_port).head(own).transpose();
    static_film_[i] = to_m * all.row(top_ports[static_cast<std::size_t>(i)]).tail(n) * amplitude;
    out_film_.row(i) = to_m * all.row(top_ports[static_cast<std::size_t>(i)]).head(m);
  }
  for (int i = 0; i < voltages_; ++i) {
    static_film_[n + i] = all.row(volt_ports[static_cast<std::size_t>(i)]).tail(n) * amplitude;
    out_film_.row(n + i) = all.row(volt_ports[static_cast<std::size_t>(i)]).head(m);
  }
  static_film_ -= static_pillar_;
  out_film_ = ((out_film_ - out_pillar_) * V).eval();
  out_pillar_ = (out_pillar_ * V).eval();
}

Complex ArrayTransfer::relative(Complex s) const {
  if (pillar_.terms.empty()) return 1.0;
  const double nu = pillar_.nu;
  const double G = pillar_.E0_Pa / (2.0 * (1.0 + nu));
  const RelativeModuli moduli = relative_moduli(pillar_.terms, s);
  const Complex shear = G * moduli.shear;
  if (nu == 0.5) return shear / G;
  const double K = pillar_.E0_Pa / (3.0 * (1.0 - 2.0 * nu));
  const Complex bulk = K * moduli.bulk;
  return 9.0 * bulk * shear / ((3.0 * bulk + shear) * pillar_.E0_Pa);
}

Eigen::VectorXcd ArrayTransfer::at(Complex s, Eigen::VectorXd* slope) const {
  const Complex soft = 1.0 / relative(s);
  Eigen::VectorXcd weight(in_film_.size());
  Eigen::VectorXcd steep(in_film_.size());
  for (Eigen::Index j = 0; j < weight.size(); ++j) {
    const Complex pole = 1.0 + s * s * (compliance_pillar_[j] * soft + compliance_film_[j]);
    weight[j] = -s * s * (in_pillar_[j] * soft + in_film_[j]) / pole;
    steep[j] = 2.0 * weight[j] / pole;
  }
  const auto out = [&](const Eigen::VectorXcd& of) {
    return Eigen::VectorXcd(soft * (out_pillar_ * of) + out_film_ * of);
  };
  Eigen::VectorXcd value =
      soft * static_pillar_.cast<Complex>() + static_film_.cast<Complex>() + out(weight);
  if (slope != nullptr) *slope = value.cwiseAbs() + out(steep).cwiseAbs();
  if (voltages_ == 0 || film_.loss.is_lossless()) return value;
  const Complex kept =
      1.0 / (1.0 + film_.dielectric_F / film_.capacitance_F * added_permittivity(film_.loss, s));
  value.tail(voltages_) *= kept;
  if (slope != nullptr) slope->tail(voltages_) *= std::abs(kept);
  return value;
}

double ArrayTransfer::film_share() const {
  const Eigen::Index tops = static_film_.size() - voltages_;
  return static_film_.head(tops).cwiseAbs().maxCoeff() /
         (static_film_ + static_pillar_).head(tops).cwiseAbs().maxCoeff();
}

Eigen::VectorXd ArrayTransfer::at_once() const {
  const Eigen::VectorXd weight =
      (in_pillar_ + in_film_).cwiseQuotient(compliance_pillar_ + compliance_film_);
  return static_pillar_ + static_film_ - (out_pillar_ + out_film_) * weight;
}

Eigen::MatrixXd response_in_time(const ArrayTransfer& transfer, const Course& history,
                                 double end_time_s, int outputs, int oversampling) {
  // The transform covers twice the time; the shift damps the part that is aliased to 1e-7.
  const int samples = 2 * outputs * oversampling;
  const double period_s = 2.0 * end_time_s;
  const double shift = std::log(1e7) / period_s;
  const Eigen::VectorXd at_once = transfer.at_once();
  Eigen::MatrixXcd spectrum = Eigen::MatrixXcd::Zero(at_once.size(), samples);
  for (int k = 0; k <= samples / 2; ++k) {
    const Complex s(shift, 2.0 * std::numbers::pi * k / period_s);
    spectrum.col(k) = (transfer.at(s) - at_once.cast<Complex>()) * transform_of(history, s);
    if (k > 0 && k < samples / 2) spectrum.col(samples - k) = spectrum.col(k).conjugate();
  }
  Eigen::FFT<double> fft;
  Eigen::MatrixXd response(at_once.size(), outputs + 1);
  for (Eigen::Index row = 0; row < at_once.size(); ++row) {
    const Eigen::VectorXcd transform = spectrum.row(row);
    Eigen::VectorXcd values;
    fft.inv(values, transform);
    for (int i = 0; i <= outputs; ++i) {
      const double time_s = end_time_s * i / outputs;
      response(row, i) =
          values[i * oversampling].real() * std::exp(shift * time_s) * samples / period_s +
          at_once[row] * value_at(history, time_s);
    }
  }
  return response;
}

}  // namespace viscard
