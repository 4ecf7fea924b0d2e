#pragma once

#include "fit/curves/creep_rows.h"
#include "fit/curves/spectral_model.h"
#include "models/material/prony_series.h"

#include <Eigen/Core>

#include <cstddef>
#include <memory>
#include <vector>

namespace viscard {

// One of several tests of a material. Its first common column is E_inf, unless it is a liquid.
struct JointMember {
  std::unique_ptr<SpectralModel> model;
  CreepRows* creep = nullptr;  // the model itself, if it is one of creep
  double weight = 1.0;         // of its rows: 1/(sigma sqrt(inflation))
  // A test of unknown geometry measures the modulus times an unknown factor, a nuisance.
  bool has_scale = false;
  double scale_start = 1.0;
  double scale_prior_sd = 0.0;  // of ln scale about 0; 0: unknown
};

// Several tests with one spectrum: their rows one below the other, each weighted by its own noise.
// Common columns: E_inf, then those that single tests have beside it (offset, drift, dashpot).
// Nuisances: those of the tests, then ln of the free scales.
class JointModel final : public SpectralModel {
 public:
  JointModel(std::vector<JointMember> members, bool is_liquid);

  ModelColumns columns(const Eigen::VectorXd& ln_tau, const Eigen::VectorXd& nuisance,
                       bool with_slopes) const override;
  std::vector<std::size_t> row_begins() const override;
  double n_samples() const override;
  double hidden_rss(const SpectralState& state) const override;
  double sample_variance() const override { return 1.0; }

  // Creep is linearised about a series (CreepRows).
  bool has_creep() const;
  void refer_to(const PronySeries& series);
  PronySeries series_of(const SpectralState& state) const;

  const JointMember& member(std::size_t k) const { return members_[k]; }
  Eigen::Index first_row(std::size_t k) const { return places_[k].row; }
  Eigen::Index scale_nuisance(std::size_t k) const { return places_[k].scale; }  // -1: none
  void set_weight(std::size_t k, double weight);

  // The state as one test sees it: its own nuisances and columns, moduli times its scale.
  SpectralState member_state(std::size_t k, const SpectralState& state) const;
  // What the moduli alone give at the rows of one test, weighted: without offset, drift and dashpot.
  Eigen::VectorXd moduli_part(std::size_t k, const SpectralState& state) const;

 private:
  struct Place {  // of one test in the whole
    Eigen::Index row = 0, common = 0, nuisance = 0, scale = -1;
  };
  double scale_of(std::size_t k, const Eigen::VectorXd& nuisance) const;
  Eigen::Index n_shared() const { return with_equilibrium_ ? 1 : 0; }
  void gather_data();

  std::vector<JointMember> members_;
  std::vector<Place> places_;
  bool with_equilibrium_ = true;
};

}  // namespace viscard
