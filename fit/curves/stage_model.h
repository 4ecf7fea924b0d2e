#pragma once

#include "fit/curves/averaged_run.h"
#include "fit/curves/earlier_touch.h"
#include "fit/curves/spectral_model.h"
#include "fit/samples/fit_data.h"
#include "fit/samples/noise_model.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace viscard {

// Force of a punch driven by known stage moves through a frame spring. Specimen and frame in series
// are again a generalised Maxwell solid, so the force follows the position of the *stage*:
//   F(t) = int R(t - s) dz(s) + offset + drift t + creep t z,   z counted from contact
// (fit/README.md, eq. 4) with stiffnesses R_inf, R_i in N/m. specimen_series() removes the frame
// afterwards. The input z has no noise, so the residual is the force noise itself. The samples out
// of contact determine the drift of the zero; the long hold determines the creep of the load cell
// under load (a share of the force).
//
// Nuisances: one start time per move (only roughly known on the amplifier's clock; the prior of a
// correction is that it is as late as the ramp), the contact position, and the logarithm of the true
// speed of all moves over the commanded one, because the stage's clock is its own; its prior is
// normal, 0 +- 0.2 %. The kinks of the force determine all of them sharply. Out of contact the force
// is zero. z begins as the touch of the approach has left the surface (earlier_touch.h).
class StageModel final : public SpectralModel {
 public:
  // nuisance_start: shifts of the starts first (s), then the contact position (m), then the
  // logarithm of the speed. The half-widths of the bounds of the first two come from the data.
  StageModel(const IndentationData& data, const Eigen::VectorXd& nuisance_start,
             const StageNoise& noise, const FitOptions& options, Course touch = {});
  // Of a long run whose readings are averaged; both must outlive the model.
  StageModel(const AveragedRun& run, const IndentationData& readings,
             const Eigen::VectorXd& nuisance_start, const StageNoise& noise,
             const FitOptions& options, Course touch = {});

  ModelColumns columns(const Eigen::VectorXd& ln_tau, const Eigen::VectorXd& nuisance,
                       bool with_slopes) const override;

  // True for samples taken while the stage moves, according to the start values.
  const std::vector<bool>& is_moving() const { return is_moving_; }
  bool has_drift() const { return with_drift_; }
  const std::vector<bool>& is_out_of_contact() const { return is_out_of_contact_; }
  // Standard deviation of one reading of each row, and of the row's mean.
  const Eigen::VectorXd& sigma_N() const { return sigma_N_; }
  Eigen::VectorXd row_sigma() const override { return sigma_N_.cwiseQuotient(root_count_); }
  Eigen::VectorXd in_unit_of_samples(const Eigen::VectorXd& rows) const override {
    return rows.cwiseProduct(sigma_N_);
  }
  std::vector<std::size_t> row_begins() const override;
  double n_samples() const override;
  double hidden_rss(const SpectralState& state) const override;
  double hidden_rss_in_unit(const SpectralState& state) const override;
  Eigen::VectorXd residual_series(const SpectralState& state) const override;
  // Root mean square residual of the readings of each row, N; of a row of one reading with its sign.
  Eigen::VectorXd reading_residuals_N(const SpectralState& state) const;

 private:
  void set_up(const IndentationData& data, double dt_s, const Eigen::VectorXd& start,
              const StageNoise& noise, const FitOptions& options);
  struct Drive;
  // Sum of squares within each average about the fitted force, which is straight there.
  Eigen::VectorXd squares_within(const SpectralState& state) const;
  Eigen::VectorXd slopes_N_s(const Eigen::VectorXd& fitted_N) const;
  Drive drive(const Eigen::VectorXd& ln_tau, const Eigen::VectorXd& nuisance) const;
  void add_depth(Eigen::MatrixXd& matrix, Eigen::Index row, double depth_m) const;
  void add_move(const Drive& drive, std::size_t m, Eigen::Index row, bool with_slopes,
                ModelColumns& out) const;
  void add_touch(const Drive& drive, Eigen::Index row, bool with_slopes, ModelColumns& out) const;

  std::vector<double> time_s_;
  std::vector<StageMove> moves_;
  Course touch_;
  std::vector<bool> is_moving_;
  std::vector<bool> is_out_of_contact_;
  Eigen::VectorXd sigma_N_;
  Eigen::VectorXd root_count_;                 // of the readings of each row
  const AveragedRun* run_ = nullptr;           // nullptr: every row is one reading
  const IndentationData* readings_ = nullptr;  // of run_
  double ramp_s_ = 0.0;                        // time from which drift and creep count
  bool with_drift_ = false;
  bool with_equilibrium_ = true;
};

// A move that starts later and goes exp(ln_speed) times as fast.
StageMove timed(StageMove move, double shift_s, double ln_speed);

// A correction of the position while a force is held: shorter than a twentieth of the way of the
// ramp from contact (m). Relaxation changes the force as much, so the force shows neither when it
// starts nor what is fast in the specimen.
bool is_correction(const StageMove& move, const StageMove& ramp, double contact_m);

// Start values of StageModel's nuisances from the force curve alone: ramp start and contact from
// contact_onset(); each later move starts where the force passes half of its change. A correction
// starts as late as the ramp, and so does a move whose force relaxes so much that its middle gives a
// time which cannot be; the speed is the commanded one.
Eigen::VectorXd nuisance_start(const IndentationData& data);

}  // namespace viscard
