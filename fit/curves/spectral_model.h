#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace viscard {

// Data and a model of them that is linear in everything but the relaxation times and a few
// nuisances:
//   y = sum_j x_j A_j(nuisance) + sum_i E_i b(tau_i, nuisance)      (fit/README.md, eq. 1)
// The x_j are what all orders share: equilibrium modulus, force offset, drift. Every kind of test
// is one such model. Rows are weighted by 1/sigma, so that residuals have unit variance.

// What the model looks like at one choice of times and nuisances. Rows are those of data().
struct ModelColumns {
  Eigen::MatrixXd values;                        // rows x (n_common + n_terms)
  Eigen::MatrixXd term_slopes;                   // rows x n_terms, d b_i/d ln tau_i
  std::vector<Eigen::MatrixXd> nuisance_slopes;  // one per nuisance, each like values
};

// A column that every order has. Columns that are not free may not be negative.
struct CommonColumn {
  std::string name;  // "E_inf_Pa", "offset_N", ...
  bool is_free = true;
};

// A parameter that enters non-linearly and is of no interest itself, but uncertain: the start of a
// stage move, the contact position.
struct Nuisance {
  std::string name;
  double start = 0.0;
  double low = 0.0, high = 0.0;  // bounds
  double scale = 1.0;            // typical size of a change; parameters are divided by it
};

class SpectralModel {
 public:
  virtual ~SpectralModel() = default;

  const Eigen::VectorXd& data() const { return data_; }
  Eigen::Index n_rows() const { return data_.size(); }
  const std::vector<CommonColumn>& common() const { return common_; }
  const std::vector<Nuisance>& nuisances() const { return nuisances_; }
  Eigen::Index n_common() const { return static_cast<Eigen::Index>(common_.size()); }
  Eigen::Index n_nuisances() const { return static_cast<Eigen::Index>(nuisances_.size()); }
  bool may_be_negative() const { return may_be_negative_; }  // moduli of terms

  // Range of relaxation times that the data can say anything about, ln s.
  double ln_tau_min() const { return ln_tau_min_; }
  double ln_tau_max() const { return ln_tau_max_; }

  // Columns at these times (ln s) and nuisances (in their own units); slopes only if asked for.
  virtual ModelColumns columns(const Eigen::VectorXd& ln_tau, const Eigen::VectorXd& nuisance,
                               bool with_slopes) const = 0;

  Eigen::VectorXd nuisance_start() const;

  // Where rows are averages of samples: how many there are, and the weighted sum of squares about
  // the model that averaging hides. By default rows are samples.
  virtual std::vector<std::size_t> row_begins()
      const;  // first sample of each row, and one past the last
  virtual double n_samples() const { return static_cast<double>(n_rows()); }
  virtual double hidden_rss(const Eigen::VectorXd& ln_tau, const Eigen::VectorXd& nuisance,
                            const Eigen::VectorXd& coefficients) const;
  // What averages hide, as further rows: shape of data and model within each average. None where
  // rows are samples. With them the optimum is that of all samples.
  struct HiddenRows {
    Eigen::VectorXd data;
    ModelColumns columns;
  };
  virtual HiddenRows hidden_rows(const Eigen::VectorXd& ln_tau) const;
  // Variance of a weighted sample as seen within averages; 0: not known before a fit. What changes
  // the sum of squares by much less than this is not worth searching for.
  virtual double sample_variance() const { return 0.0; }
  // The same data in fewer rows, good enough to search with; nothing where that saves nothing. Must
  // not outlive this model.
  virtual std::unique_ptr<SpectralModel> coarse() const { return nullptr; }
  // Standard deviation that each row was divided by; empty: rows are in the unit of the data.
  virtual Eigen::VectorXd row_sigma() const { return {}; }
  // Consecutive weighted residuals of samples (a stretch of them if there are very many), for their
  // autocorrelation.
  virtual Eigen::VectorXd residual_series(const Eigen::VectorXd& ln_tau,
                                          const Eigen::VectorXd& nuisance,
                                          const Eigen::VectorXd& coefficients) const;

 protected:
  Eigen::VectorXd data_;
  std::vector<CommonColumn> common_;
  std::vector<Nuisance> nuisances_;
  bool may_be_negative_ = false;
  double ln_tau_min_ = 0.0;
  double ln_tau_max_ = 0.0;
};

}  // namespace viscard
