#pragma once

#include "fit/curves/earlier_touch.h"
#include "fit/curves/spectral_model.h"
#include "fit/samples/fit_data.h"

#include <Eigen/Core>

#include <optional>
#include <span>
#include <vector>

namespace viscard {

// Response to a measured history of depth or strain, linear between samples (fit/README.md, eq. 2):
//   y(t) = c int E(t - s) d(input^power) + offset [+ drift t]
// The recursion of models/material/hereditary.h is exact and takes one pass over all samples for
// each relaxation time. Every sample up to the end of loading is a row. Later samples are averaged
// in log time, the data and the basis alike. With the stress as the input and the strain as the output it is
//   strain(t) = int J(t - s) d(stress),  J = J_g + sum J_j (1 - exp(-t/lambda_j)) [+ t/eta for a liquid],
// creep, recovery and any sequence of stresses (Boltzmann's superposition; fit/README.md, eq. 5).
// More than a Course: the samples of a test with what is known about it.
struct HistoryInput {
  std::vector<double> time_s;  // sorted
  std::vector<double> input;   // depth in m, or strain
  std::vector<double> output;  // force in N, or stress in Pa
  double factor = 1.0;         // c; moduli have the unit output/(c input^power)
  // 1.5 for a sphere, 2 for a cone. input^power is then taken as linear between samples, and the
  // input must not fall: Lee & Radok (models/contact/punch_contact.h).
  double power = 1.0;
  std::size_t contact = 0;  // first sample that may be in contact; before it the input counts as 0
  // The input was applied in a step at this time, before the first sample; none: at the first
  // sample. For records that begin under load (step_before).
  std::optional<double> step_s;
  // Contact position as a nuisance, in the unit of the input; none: contact at input 0.
  std::optional<double> contact_input;
  double contact_half_width = 0.0;
  bool with_offset = false;
  bool with_drift = false;
  // Last sample of the first loading; none: end_of_loading(input).
  std::optional<std::size_t> loaded;
  // For punches that lose contact (contact_course.h); empty: contact is kept. The force of a free
  // sample is zero; `input` is then the depth of the free surface.
  std::vector<char> is_free;
  // Samples at which the input has moved on: no average extends over them, and the log time of the
  // averages restarts there. Empty: none.
  std::vector<char> has_moved;
  bool is_creep = false;  // the input is the stress
  // The surface before the contact (earlier_touch.h), for which the contact must be a nuisance; empty: at rest.
  Course touch;
};

// First sample with at least 98 % of the largest input: the end of loading, despite later drift.
std::size_t end_of_loading(const std::vector<double>& input);

// Time for which the load rises: up to the end of loading, without the holds between several ramps.
// 0 for a step.
double loading_s(const HistoryInput& input);

// True for a record that does not show when its load came: at its first sample half of the largest is there. Values that
// are not finite do not count.
bool begins_under_load(double first, std::span<const double> input);

inline constexpr double kLatestStep = 0.1;  // of the length of the record, for step_before()

// Time of the step that a record beginning under load missed: t = 0, if that is before the first
// sample by at most a tenth of the record. None for other records.
std::optional<double> step_before(const std::vector<double>& time_s,
                                  const std::vector<double>& input);

// The shortest time between two rows in which the input changes at once, among its large changes: where in it, the
// table does not show. The sharpest of them decides E0; an unloading between rows far apart does not. A ramp of
// several rows is known. 0: there is none.
double sharpest_jump_s(const HistoryInput& input);

class HistoryModel final : public SpectralModel {
 public:
  HistoryModel(HistoryInput input, const FitOptions& options);

  ModelColumns columns(const Eigen::VectorXd& ln_tau, const Eigen::VectorXd& nuisance,
                       bool with_slopes) const override;
  std::vector<std::size_t> row_begins() const override { return row_begin_; }
  double n_samples() const override { return static_cast<double>(in_.time_s.size()); }
  double hidden_rss(const SpectralState& state) const override;
  Eigen::VectorXd residual_series(const SpectralState& state) const override;

  // Model at every sample.
  Eigen::VectorXd fitted_samples(const SpectralState& state) const;

  const std::vector<double>& row_time_s() const { return row_time_s_; }
  const HistoryInput& input() const { return in_; }

 private:
  // Sample columns at one choice of parameters, before averaging.
  ModelColumns sample_columns(const Eigen::VectorXd& ln_tau, const Eigen::VectorXd& nuisance,
                              bool with_slopes) const;
  Eigen::MatrixXd averaged(const Eigen::MatrixXd& samples) const;
  Eigen::VectorXd residual(const SpectralState& state) const;  // of every sample
  // The first sample in contact, the time between samples at which contact begins, and the input of
  // the surface at rest. The history counts from that time, at which a touch has left the depth.
  struct Onset {
    std::size_t first = 0;
    double time_s = 0.0, input = 0.0, depth = 0.0;
  };
  Onset onset_at(double contact_input) const;
  // One number per sample each; nullptr for derivatives that are not needed.
  struct Column {
    double *value, *by_ln_tau, *by_contact;
  };
  bool is_free(std::size_t sample) const { return !in_.is_free.empty() && in_.is_free[sample]; }
  void fill_equilibrium(const Onset& onset, Column into) const;
  void fill_flow(const Onset& onset, double* value) const;
  void fill_term(const Onset& onset, double tau_s, Column into) const;

  HistoryInput in_;
  std::vector<std::size_t> row_begin_;  // first sample of each row, and one past the last
  std::vector<double> row_time_s_;
  bool with_equilibrium_ = true;  // or an instantaneous compliance
  bool with_flow_ = false;
};

}  // namespace viscard
