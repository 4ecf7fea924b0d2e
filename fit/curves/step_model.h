#pragma once

#include "fit/curves/bin_arrays.h"
#include "fit/curves/spectral_model.h"
#include "fit/samples/cycle.h"
#include "fit/samples/fit_data.h"
#include "fit/samples/log_bins.h"
#include "fit/samples/reading_noise.h"

#include <Eigen/Core>

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace viscard {

enum class StepShape { kRelaxation, kCreep };

// Response to a step at t = 0: relaxation, value = E_inf + sum E_i exp(-t/tau_i), or creep, value =
// J_g + sum J_j (1 - exp(-t/lambda_j)) [+ t/eta for a liquid] (fit/README.md, eq. 5). Relaxation may
// have a drift of the instrument, + d t. Long records are averaged in log time, the data and the
// model alike.
class StepModel final : public SpectralModel {
 public:
  // Times must be sorted and all values finite. The model does not copy them; both must outlive it.
  // cycle: a periodic disturbance that was subtracted from the values; its amplitudes and frequency
  // become parameters, so that the intervals contain its uncertainty.
  // noise: if it grows with the value, every row is weighed by it; otherwise all samples weigh alike.
  StepModel(std::span<const double> time_s, std::span<const double> value, StepShape shape,
            const FitOptions& options, const ReadingNoise& noise = {},
            const std::optional<Cycle>& cycle = {});

  ModelColumns columns(const Eigen::VectorXd& ln_tau, const Eigen::VectorXd& nuisance,
                       bool with_slopes) const override;
  std::vector<std::size_t> row_begins() const override;
  double n_samples() const override { return static_cast<double>(time_s_.size()); }
  double hidden_rss(const SpectralState& state) const override;
  double sample_variance() const override { return sample_variance_; }
  HiddenRows hidden_rows(const Eigen::VectorXd& ln_tau) const override;
  std::optional<SampleSums> sample_sums(const SpectralState& state) const override;
  std::unique_ptr<SpectralModel> coarse() const override;
  Eigen::VectorXd residual_series(const SpectralState& state) const override;
  // Of weighed rows; otherwise empty.
  Eigen::VectorXd row_sigma() const override;
  Eigen::VectorXd in_unit_of_samples(const Eigen::VectorXd& rows) const override;
  double hidden_rss_in_unit(const SpectralState& state) const override;
  bool is_weighed() const { return is_weighed_; }
  // Standard deviation of a sample of each row over that of all.
  Eigen::VectorXd relative_sigma() const;

  const std::vector<LogBin>& bins() const { return bins_; }
  std::vector<double> row_time_s() const { return {arrays_.time_s.begin(), arrays_.time_s.end()}; }
  double sampling_s() const { return sampling_s_; }  // shortest step between samples

 private:
  StepModel(const StepModel& fine, double bins_per_decade);
  void set_rows();
  // Sum of squares within averages, in units of each sample's standard deviation or of the data.
  double squares_within(const SpectralState& state, bool in_unit) const;
  struct SampleChunk;
  void add_samples(std::size_t begin, std::size_t count, const SpectralState& state,
                   SampleChunk& chunk, SampleSums& sums) const;

  std::span<const double> time_s_, value_;
  double sampling_s_ = 0.0;
  StepShape shape_;
  std::vector<LogBin> bins_;
  BinArrays arrays_;
  BinShapes shapes_;
  double sample_variance_ = 0.0;
  bool has_averages_ = false;
  bool is_weighed_ = false;
  bool is_liquid_ = false;
  bool with_constant_ = true;
  std::optional<Cycle> cycle_;
  Eigen::MatrixXd cycle_rows_;     // its cosine, sine and derivative by the frequency
  Eigen::Index first_cycle_ = -1;  // common column of the first of them; -1: none
  Eigen::Index line_ = -1;         // common column that is proportional to time; -1: none
};

}  // namespace viscard
