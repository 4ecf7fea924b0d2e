#include "fit/curves/joint_model.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace viscard {
namespace {

using Index = Eigen::Index;

}  // namespace

JointModel::JointModel(std::vector<JointMember> members, bool is_liquid)
    : members_(std::move(members)), with_equilibrium_(!is_liquid) {
  if (with_equilibrium_) common_.push_back({"E_inf", false});
  Index rows = 0;
  ln_tau_min_ = members_.front().model->ln_tau_min();
  ln_tau_max_ = members_.front().model->ln_tau_max();
  for (const JointMember& one : members_) {
    places_.push_back({rows, n_common(), n_nuisances(), -1});
    rows += one.model->n_rows();
    const std::vector<CommonColumn>& own = one.model->common();
    common_.insert(common_.end(), own.begin() + n_shared(), own.end());
    nuisances_.insert(nuisances_.end(), one.model->nuisances().begin(),
                      one.model->nuisances().end());
    ln_tau_min_ = std::min(ln_tau_min_, one.model->ln_tau_min());
    ln_tau_max_ = std::max(ln_tau_max_, one.model->ln_tau_max());
  }
  constexpr double kWidest = 12.0, kUsual = 0.1;  // of ln scale
  for (std::size_t k = 0; k < members_.size(); ++k) {
    if (!members_[k].has_scale) continue;
    places_[k].scale = n_nuisances();
    const double start = std::log(members_[k].scale_start);
    Nuisance scale{"ln_scale", start, start - kWidest, start + kWidest, kUsual};
    scale.prior_sd = members_[k].scale_prior_sd;
    nuisances_.push_back(scale);
  }
  gather_data();
}

void JointModel::gather_data() {
  data_.resize(places_.back().row + members_.back().model->n_rows());
  for (std::size_t k = 0; k < members_.size(); ++k) {
    const JointMember& one = members_[k];
    data_.segment(places_[k].row, one.model->n_rows()) = one.weight * one.model->data();
  }
}

void JointModel::set_weight(std::size_t k, double weight) {
  members_[k].weight = weight;
  gather_data();
}

double JointModel::scale_of(std::size_t k, const Eigen::VectorXd& nuisance) const {
  return places_[k].scale < 0 ? 1.0 : std::exp(nuisance[places_[k].scale]);
}

ModelColumns JointModel::columns(const Eigen::VectorXd& ln_tau, const Eigen::VectorXd& nuisance,
                                 bool with_slopes) const {
  const Index n_terms = ln_tau.size(), shared = n_shared();
  ModelColumns out;
  out.values = Eigen::MatrixXd::Zero(n_rows(), n_common() + n_terms);
  if (with_slopes) {
    out.term_slopes.resize(n_rows(), n_terms);
    out.nuisance_slopes.assign(static_cast<std::size_t>(n_nuisances()),
                               Eigen::MatrixXd::Zero(n_rows(), n_common() + n_terms));
  }
  for (std::size_t k = 0; k < members_.size(); ++k) {
    const JointMember& one = members_[k];
    const Place& at = places_[k];
    const Index rows = one.model->n_rows(), own = one.model->n_common() - shared;
    const double scale = scale_of(k, nuisance);
    // Puts the columns of one test where they belong, those of its moduli times the scale.
    const auto place = [&](const Eigen::MatrixXd& from, double of_own, Eigen::MatrixXd& to) {
      to.block(at.row, 0, rows, shared) = one.weight * scale * from.leftCols(shared);
      to.block(at.row, at.common, rows, own) = one.weight * of_own * from.middleCols(shared, own);
      to.block(at.row, n_common(), rows, n_terms) = one.weight * scale * from.rightCols(n_terms);
    };
    const ModelColumns part = one.model->columns(
        ln_tau, nuisance.segment(at.nuisance, one.model->n_nuisances()), with_slopes);
    place(part.values, 1.0, out.values);
    if (!with_slopes) continue;
    out.term_slopes.middleRows(at.row, rows) = one.weight * scale * part.term_slopes;
    for (std::size_t j = 0; j < part.nuisance_slopes.size(); ++j) {
      place(part.nuisance_slopes[j], 1.0,
            out.nuisance_slopes[static_cast<std::size_t>(at.nuisance) + j]);
    }
    if (at.scale >= 0) {
      place(part.values, 0.0, out.nuisance_slopes[static_cast<std::size_t>(at.scale)]);
    }
  }
  return out;
}

std::vector<std::size_t> JointModel::row_begins() const {
  std::vector<std::size_t> begins;
  std::size_t first = 0;
  for (const JointMember& one : members_) {
    const std::vector<std::size_t> own = one.model->row_begins();
    for (std::size_t i = 0; i + 1 < own.size(); ++i) begins.push_back(first + own[i]);
    first += own.back();
  }
  begins.push_back(first);
  return begins;
}

double JointModel::n_samples() const {
  double sum = 0.0;
  for (const JointMember& one : members_) sum += one.model->n_samples();
  return sum;
}

double JointModel::hidden_rss(const SpectralState& state) const {
  double sum = 0.0;
  for (std::size_t k = 0; k < members_.size(); ++k) {
    sum += std::pow(members_[k].weight, 2) * members_[k].model->hidden_rss(member_state(k, state));
  }
  return sum;
}

bool JointModel::has_creep() const {
  return std::any_of(members_.begin(), members_.end(),
                     [](const JointMember& one) { return one.creep != nullptr; });
}

void JointModel::refer_to(const PronySeries& series) {
  for (JointMember& one : members_) {
    if (one.creep != nullptr) one.creep->refer_to(series);
  }
  gather_data();
}

PronySeries JointModel::series_of(const SpectralState& state) const {
  PronySeries series{with_equilibrium_ ? state.coefficients[0] : 0.0, {}};
  for (Index i = 0; i < state.n_terms(); ++i) {
    series.terms.push_back({state.coefficients[n_common() + i], std::exp(state.ln_tau[i])});
  }
  return series;
}

SpectralState JointModel::member_state(std::size_t k, const SpectralState& state) const {
  const SpectralModel& model = *members_[k].model;
  const Index shared = n_shared(), own = model.n_common() - shared;
  const double scale = scale_of(k, state.nuisance);
  SpectralState part;
  part.ln_tau = state.ln_tau;
  part.nuisance = state.nuisance.segment(places_[k].nuisance, model.n_nuisances());
  part.coefficients.resize(model.n_common() + state.n_terms());
  part.coefficients << scale * state.coefficients.head(shared),
      state.coefficients.segment(places_[k].common, own),
      scale * state.coefficients.tail(state.n_terms());
  return part;
}

Eigen::VectorXd JointModel::moduli_part(std::size_t k, const SpectralState& state) const {
  const JointMember& one = members_[k];
  SpectralState part = member_state(k, state);
  if (one.creep != nullptr) return one.weight * one.creep->compliance_of(part);
  part.coefficients.segment(n_shared(), one.model->n_common() - n_shared()).setZero();
  return one.weight * one.model->fitted(part);
}

}  // namespace viscard
