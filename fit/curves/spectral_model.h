#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace viscard {

// Data and a model that is linear in all parameters except relaxation times and a few nuisances:
//   y = sum_j x_j A_j(nuisance) + sum_i E_i b(tau_i, nuisance)      (fit/README.md, eq. 1)
// The x_j are common to all orders: equilibrium modulus, force offset, drift. Every kind of test is
// one such model. Rows are weighted by 1/sigma, so that residuals have unit variance.

// The model's columns at given times and nuisances. Rows are those of data().
struct ModelColumns {
  Eigen::MatrixXd values;                        // rows x (n_common + n_terms)
  Eigen::MatrixXd term_slopes;                   // rows x n_terms, d b_i/d ln tau_i
  std::vector<Eigen::MatrixXd> nuisance_slopes;  // one per nuisance, each with the shape of values
};

// A column that every order has. The coefficient of a column that is not free must not be negative.
struct CommonColumn {
  std::string name;  // "E_inf_Pa", "offset_N", ...
  bool is_free = true;
};

// Name of the common column of a drift in a table, in the unit of the data per second.
inline constexpr const char* kDriftName = "drift";

// A nuisance parameter: it enters non-linearly and is uncertain, but its value is not a result.
// Examples: the start of a stage move, the contact position.
struct Nuisance {
  std::string name;
  double start = 0.0;
  double low = 0.0, high = 0.0;  // bounds
  double scale = 1.0;            // typical size of a change; the search divides the parameter by it
  // Mean and standard deviation of a normal prior, which counts as one more reading; 0: none.
  double prior = 0.0, prior_sd = 0.0;
};

// Values of all parameters of a SpectralModel.
struct SpectralState {
  Eigen::VectorXd ln_tau;  // ln s, ascending after refine()
  Eigen::VectorXd nuisance;
  Eigen::VectorXd coefficients;  // common columns, then the terms' moduli
  double rss = 0.0;              // weighted
  bool is_converged = true;

  Eigen::Index n_terms() const { return ln_tau.size(); }
};

// The same state with its terms sorted by ascending time.
SpectralState sorted_by_time(SpectralState state, Eigen::Index n_common);

class SpectralModel {
 public:
  virtual ~SpectralModel() = default;

  const Eigen::VectorXd& data() const { return data_; }
  Eigen::Index n_rows() const { return data_.size(); }
  const std::vector<CommonColumn>& common() const { return common_; }
  const std::vector<Nuisance>& nuisances() const { return nuisances_; }
  Eigen::Index n_common() const { return static_cast<Eigen::Index>(common_.size()); }
  Eigen::Index n_nuisances() const { return static_cast<Eigen::Index>(nuisances_.size()); }
  bool may_be_negative() const { return may_be_negative_; }  // for moduli of terms

  // Parameters at this state: the common ones, a modulus and a time of each term, the nuisances.
  Eigen::Index n_parameters(const SpectralState& state) const {
    return n_common() + 2 * state.n_terms() + n_nuisances();
  }

  // Range of relaxation times that the data can determine, ln s.
  double ln_tau_min() const { return ln_tau_min_; }
  double ln_tau_max() const { return ln_tau_max_; }
  // True at either end of that range, where a time is not determined.
  bool is_shortest(double ln_tau) const { return ln_tau <= ln_tau_min_ + kTouch; }
  bool is_longest(double ln_tau) const { return ln_tau >= ln_tau_max_ - kTouch; }

  // Columns at these times (ln s) and nuisances (in their own units); slopes only on request.
  virtual ModelColumns columns(const Eigen::VectorXd& ln_tau, const Eigen::VectorXd& nuisance,
                               bool with_slopes) const = 0;

  // The model's rows at these parameters.
  Eigen::VectorXd fitted(const SpectralState& state) const {
    return columns(state.ln_tau, state.nuisance, /*with_slopes=*/false).values * state.coefficients;
  }

  // Pointer to a member of Nuisance, for instance &Nuisance::scale, collected over all nuisances.
  Eigen::VectorXd of_nuisances(double Nuisance::*member) const;
  Eigen::VectorXd nuisance_start() const { return of_nuisances(&Nuisance::start); }
  // Distance of each nuisance from the mean of its prior, in standard deviations; 0 without one.
  Eigen::VectorXd prior_residual(const Eigen::VectorXd& nuisance) const;
  // Derivative of prior_residual() by the nuisance itself: 1/prior_sd, or 0.
  Eigen::VectorXd prior_weight() const;

  // For rows that are averages of samples: the samples of each row, their number, and the weighted
  // sum of squares about the model within the averages. By default each row is one sample.
  // First sample of each row, and one past the last.
  virtual std::vector<std::size_t> row_begins() const;
  virtual double n_samples() const { return static_cast<double>(n_rows()); }
  virtual double hidden_rss(const SpectralState& /*state*/) const { return 0.0; }
  // The information that averaging removes, as further rows: the shape of data and model within
  // each average. Empty if rows are samples. With these rows the optimum is that of all samples.
  struct HiddenRows {
    Eigen::VectorXd data;
    ModelColumns columns;
  };
  virtual HiddenRows hidden_rows(const Eigen::VectorXd& /*ln_tau*/) const { return {}; }
  // The same in the square of the unit of the data, for models with row_sigma().
  virtual double hidden_rss_in_unit(const SpectralState& /*state*/) const { return 0.0; }
  // For a last polish: the sum of squares over all samples and its negative gradient, J^T (data -
  // model), with respect to the coefficients and ln tau. Nothing if rows are samples, or if
  // averaging loses no information.
  struct SampleSums {
    double rss = 0.0;
    Eigen::VectorXd descent;
  };
  virtual std::optional<SampleSums> sample_sums(const SpectralState& /*state*/) const {
    return std::nullopt;
  }
  // Variance of a weighted sample, estimated within averages; 0: unknown before a fit. The search
  // ignores changes of the sum of squares that are much smaller.
  virtual double sample_variance() const { return 0.0; }
  // The same data in fewer rows, accurate enough for the search; nullptr if that saves nothing. The
  // result must not outlive this model.
  virtual std::unique_ptr<SpectralModel> coarse() const { return nullptr; }
  // Standard deviation by which each row was divided; empty: rows are in the unit of the data.
  virtual Eigen::VectorXd row_sigma() const { return {}; }
  // Rows times that standard deviation: in the unit of the data, and of an average of n samples sqrt(n)
  // times its mean.
  virtual Eigen::VectorXd in_unit_of_samples(const Eigen::VectorXd& rows) const {
    return rows.cwiseProduct(row_sigma());
  }
  // Weighted residuals of consecutive samples (some, in long records), for their autocorrelation.
  virtual Eigen::VectorXd residual_series(const SpectralState& state) const;

 protected:
  Eigen::VectorXd data_;
  std::vector<CommonColumn> common_;
  std::vector<Nuisance> nuisances_;
  bool may_be_negative_ = false;
  static constexpr double kTouch = 1e-6;
  double ln_tau_min_ = 0.0;
  double ln_tau_max_ = 0.0;
};

// The columns with coefficients of either sign: free common ones, and terms if the model allows it.
std::vector<bool> free_columns(const SpectralModel& model, Eigen::Index n_terms);

}  // namespace viscard
