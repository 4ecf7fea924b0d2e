#include "models/pillar/time/modal_response.h"

#include "models/maths/dense.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace viscard {
namespace {

using Complex = std::complex<double>;

std::vector<MaterialTerm> sorted_terms(const std::vector<MaterialTerm>& terms) {
  std::vector<MaterialTerm> sorted;  // fastest first, equal times as one
  for (const MaterialTerm& term : terms) {
    if (term.g > 0.0) sorted.push_back(term);
  }
  std::sort(sorted.begin(), sorted.end(),
            [](const MaterialTerm& a, const MaterialTerm& b) { return a.tau_s < b.tau_s; });
  std::vector<MaterialTerm> merged;
  for (const MaterialTerm& term : sorted) {
    if (!merged.empty() && term.tau_s <= merged.back().tau_s * (1.0 + 1e-12)) {
      merged.back().g += term.g;
    } else {
      merged.push_back(term);
    }
  }
  return merged;
}

// D(s)/omega^2 at s = -1/tau_i + offset. Every 1 + s tau_j is computed as a difference of rates, so
// that offsets far below the rate itself keep their digits.
double characteristic(const std::vector<MaterialTerm>& terms, std::size_t i, double offset,
                      double omega) {
  const double rate = 1.0 / terms[i].tau_s;
  const double s = offset - rate;
  double value = 1.0 + (s / omega) * (s / omega);
  for (std::size_t j = 0; j < terms.size(); ++j) {
    const double apart = j == i ? 0.0 : 1.0 / terms[j].tau_s - rate;
    value -= terms[j].g / (terms[j].tau_s * (offset + apart));
  }
  return value;
}

// Distance of the real root from the pole -1/tau_i to its left. D runs from -inf to inf (or its
// value at 0) between that pole and the next. Bisects in the logarithm first: offsets may be tiny.
double root_offset(const std::vector<MaterialTerm>& terms, std::size_t i, double omega) {
  const double rate = 1.0 / terms[i].tau_s;
  const double width = i + 1 < terms.size() ? rate - 1.0 / terms[i + 1].tau_s : rate;
  double low = std::log(width) - 80.0;
  double high = std::log(width);
  for (int k = 0; k < 70 && high - low > 1e-15; ++k) {
    const double middle = 0.5 * (low + high);
    (characteristic(terms, i, std::exp(middle), omega) < 0.0 ? low : high) = middle;
  }
  return std::exp(0.5 * (low + high));
}

// int_0^1 exp(z (1 - x)) (1 - x or x) dx: the weights of the first and last value of a load.
struct Shares {
  Complex first, last;
};
Shares load_shares(Complex z) {
  if (std::abs(z) < 0.1) {  // series, because the closed forms cancel
    Complex term = 1.0;
    Complex first = 0.0;
    Complex last = 0.0;
    for (int k = 0; k < 12; ++k) {  // z^k/k! times int (1-x)^k (1-x), int (1-x)^k x
      first += term / (k + 2.0);
      last += term / ((k + 1.0) * (k + 2.0));
      term *= z / (k + 1.0);
    }
    return {first, last};
  }
  const Complex e = std::exp(z);
  const Complex last = (e - 1.0 - z) / (z * z);
  return {(e - 1.0) / z - last, last};
}

}  // namespace

RelaxingMode::RelaxingMode(double omega, const std::vector<MaterialTerm>& terms) {
  const std::vector<MaterialTerm> relaxing = sorted_terms(terms);
  double lasting = 1.0;
  double sum_of_offsets = 0.0;
  double product = 1.0;
  for (std::size_t i = 0; i < relaxing.size(); ++i) lasting -= relaxing[i].g;
  for (std::size_t i = 0; i < relaxing.size(); ++i) {
    const double offset = root_offset(relaxing, i, omega);
    const double rate = 1.0 / relaxing[i].tau_s;
    root_1_s_.emplace_back(offset - rate);
    sum_of_offsets += offset;
    product *= rate / (rate - offset);
  }
  // The factor without the real roots: s^2 + (sum of offsets) s + omega^2 E_inf/E_0 product.
  const double half = 0.5 * sum_of_offsets;
  const double rest = omega * omega * lasting * product;
  const double discriminant = half * half - rest;
  if (discriminant < 0.0) {
    root_1_s_.emplace_back(-half, std::sqrt(-discriminant));
  } else {
    const double fast = -half - std::sqrt(discriminant);
    root_1_s_.emplace_back(fast);
    root_1_s_.emplace_back(rest / fast);
  }
  for (const Complex& s : root_1_s_) {
    Complex slope = 2.0 * s;  // D'
    for (const MaterialTerm& term : relaxing) {
      const Complex one = 1.0 + s * term.tau_s;
      slope += omega * omega * term.g * term.tau_s / (one * one);
    }
    residue_.push_back((s.imag() != 0.0 ? 2.0 : 1.0) / slope);
  }
  convolved_.assign(root_1_s_.size(), 0.0);
}

void RelaxingMode::prepare(double length_s) {
  prepared_s_ = length_s;
  decay_.clear();
  from_first_.clear();
  from_last_.clear();
  for (const Complex& s : root_1_s_) {
    const Shares shares = load_shares(s * length_s);
    decay_.push_back(std::exp(s * length_s));
    from_first_.push_back(length_s * shares.first);
    from_last_.push_back(length_s * shares.last);
  }
}

void RelaxingMode::advance(double length_s, double first, double last) {
  if (length_s != prepared_s_) prepare(length_s);
  for (std::size_t i = 0; i < convolved_.size(); ++i) {
    convolved_[i] = decay_[i] * convolved_[i] + from_first_[i] * first + from_last_[i] * last;
  }
}

double RelaxingMode::displacement() const {
  double q = 0.0;
  for (std::size_t i = 0; i < convolved_.size(); ++i) q += (residue_[i] * convolved_[i]).real();
  return q;
}

// The load's own part vanishes: the residues add up to 0, because D grows as s^2.
double RelaxingMode::velocity() const {
  double rate = 0.0;
  for (std::size_t i = 0; i < convolved_.size(); ++i) {
    rate += (residue_[i] * root_1_s_[i] * convolved_[i]).real();
  }
  return rate;
}

bool relaxes_alike(const ViscoelasticSystem& small) {
  const double elastic = small.elastic.coeffs().cwiseAbs().sum();
  const double bulk = small.bulk.coeffs().cwiseAbs().sum();
  return std::all_of(small.terms.begin(), small.terms.end(), [&](const MaterialTerm& term) {
    if (term.g == 0.0 && (term.k == 0.0 || bulk == 0.0)) return true;
    return elastic == 0.0 && (bulk == 0.0 || std::abs(term.g - term.k) <= 1e-14);
  });
}

TransientResult run_by_modes(const ViscoelasticSystem& small, const TransientRequest& r,
                             const Eigen::MatrixXd& observers) {
  const Eigen::MatrixXd stiffness = dense(small.elastic) + dense(small.shear) + dense(small.bulk);
  const EigenSystem pairs = generalized_eigen(stiffness, dense(small.mass));
  const Eigen::Index n = stiffness.rows();
  const Eigen::VectorXd push = pairs.vectors.transpose() * r.load;
  const Eigen::MatrixXd seen = observers * pairs.vectors;
  std::vector<RelaxingMode> modes;
  for (Eigen::Index k = 0; k < n; ++k) {
    modes.emplace_back(std::sqrt(std::max(pairs.values[k], 0.0)), small.terms);
  }
  const std::vector<TransientPiece> pieces = pieces_of(r);
  TransientMotion motion = empty_motion(pieces, observers.rows());
  Eigen::VectorXd q(n), rate(n);
  Eigen::Index end = 0;
  for (const TransientPiece& piece : pieces) {
    for (Eigen::Index k = 0; k < n; ++k) {
      RelaxingMode& mode = modes[static_cast<std::size_t>(k)];
      mode.advance(piece.length_s, push[k] * piece.first, push[k] * piece.last);
      q[k] = mode.displacement();
      rate[k] = mode.velocity();
    }
    motion.values.col(++end) = seen * q;
    motion.rates.col(end) = seen * rate;
  }
  TransientResult result = result_of(r, pieces, std::move(motion));
  result.steps = static_cast<int>(pieces.size());
  result.converged = true;
  return result;
}

}  // namespace viscard
