#include "fit/chebyshev_series.h"

#include "models/maths/dense.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <utility>
#include <vector>

namespace viscard {
namespace {

// Parameters: ln E_inf, then pairs of ln E_i and ln tau_i. The logarithms keep all values positive.
using Parameters = Eigen::VectorXd;

constexpr double kFarLog = 1.2;         // times stay within a factor e^1.2 of the window
constexpr double kSmallestRest = 1e-6;  // relative to E_0, so that the reduced series stays a solid

struct Problem {
  Eigen::VectorXd time_s, modulus_Pa;  // logarithmic grid
  double ln_fastest = 0.0, ln_slowest = 0.0;
};

Problem make_problem(const PronySeries& series, double t_min_s, double t_max_s) {
  const double decades = std::log10(t_max_s / t_min_s);
  const int count = std::max(200, static_cast<int>(40.0 * decades));
  Problem problem;
  problem.time_s.resize(count);
  problem.modulus_Pa.resize(count);
  for (int i = 0; i < count; ++i) {
    problem.time_s[i] = t_min_s * std::pow(t_max_s / t_min_s, static_cast<double>(i) / (count - 1));
    problem.modulus_Pa[i] = relaxation_modulus_Pa(series, problem.time_s[i]);
  }
  problem.ln_fastest = std::log(t_min_s) - kFarLog;
  problem.ln_slowest = std::log(t_max_s) + kFarLog;
  return problem;
}

// r_j = E'(t_j)/E(t_j) - 1 and, unless jacobian is nullptr, dr/dp.
Eigen::VectorXd residuals(const Problem& problem, const Parameters& p, Eigen::MatrixXd* jacobian) {
  const Eigen::Index n = (p.size() - 1) / 2;
  const Eigen::ArrayXd scale = 1.0 / problem.modulus_Pa.array();
  Eigen::ArrayXd sum = std::exp(p[0]) * scale;
  if (jacobian != nullptr) {
    jacobian->resize(problem.time_s.size(), p.size());
    jacobian->col(0) = sum.matrix();
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::ArrayXd x = problem.time_s.array() * std::exp(-p[2 + 2 * i]);
    const Eigen::ArrayXd term = std::exp(p[1 + 2 * i]) * (-x).exp() * scale;
    sum += term;
    if (jacobian != nullptr) {
      jacobian->col(1 + 2 * i) = term.matrix();
      jacobian->col(2 + 2 * i) = (term * x).matrix();
    }
  }
  return (sum - 1.0).matrix();
}

void clamp(const Problem& problem, Parameters& p) {
  for (Eigen::Index i = 2; i < p.size(); i += 2) {
    p[i] = std::clamp(p[i], problem.ln_fastest, problem.ln_slowest);
  }
}

double largest(const Problem& problem, const Parameters& p) {
  return residuals(problem, p, nullptr).lpNorm<Eigen::Infinity>();
}

// Keeps the parameters with the smallest maximum error among all that were offered.
struct Best {
  Parameters p = {};
  double error = std::numeric_limits<double>::infinity();
  void offer(const Problem& problem, const Parameters& other) {
    const double its_error = largest(problem, other);
    if (p.size() > 0 && !(its_error < error)) return;
    error = its_error;
    p = other;
  }
};

// Levenberg-Marquardt on sum w r^2 with fixed weights.
Parameters least_squares(const Problem& problem, Parameters p, const Eigen::VectorXd& weights,
                         int iterations) {
  Eigen::MatrixXd jacobian;
  const auto cost = [&](const Parameters& at) {
    return (residuals(problem, at, nullptr).array() * weights.array()).square().sum();
  };
  double damping = 1e-3, now = cost(p);
  for (int step = 0; step < iterations && damping < 1e12; ++step) {
    const Eigen::VectorXd r = residuals(problem, p, &jacobian);
    const Eigen::MatrixXd weighted = weights.asDiagonal() * jacobian;
    Eigen::MatrixXd normal = weighted.transpose() * weighted;
    const Eigen::VectorXd gradient = weighted.transpose() * (r.array() * weights.array()).matrix();
    normal.diagonal() *= 1.0 + damping;
    normal.diagonal().array() += 1e-30 + 1e-14 * normal.diagonal().maxCoeff();
    Parameters trial = p - SymmetricFactor(normal).solve(gradient);
    clamp(problem, trial);
    const double then = cost(trial);
    if (then < now) {
      const bool is_done = now - then < 1e-10 * now;
      p = trial;
      now = then;
      damping = std::max(damping * 0.2, 1e-12);
      if (is_done) break;
    } else {
      damping *= 5.0;
    }
  }
  return p;
}

// Iterative reweighting to p-norms, p = 4, 8, ... 64; returns the parameters of least peak error.
Parameters sharpen(const Problem& problem, Parameters p) {
  Best best;
  best.offer(problem, p);
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(problem.time_s.size());
  for (int round = 0; round < 30; ++round) {
    const Eigen::ArrayXd r = residuals(problem, p, nullptr).array().abs();
    // Lawson's rule with a square root: the weight grows where the error is large.
    weights = (weights.array() * (r / r.maxCoeff() + 1e-3).sqrt()).matrix();
    weights /= weights.maxCoeff();
    p = least_squares(problem, p, weights, 8);
    best.offer(problem, p);
  }
  return best.p;
}

// The largest |r| in each interval of constant sign: the alternation of the error curve.
std::vector<Eigen::Index> peaks_of(const Eigen::VectorXd& r) {
  std::vector<Eigen::Index> peaks;
  for (Eigen::Index i = 0; i < r.size(); ++i) {
    if (peaks.empty() || (r[i] > 0.0) != (r[peaks.back()] > 0.0)) {
      peaks.push_back(i);
    } else if (std::abs(r[i]) > std::abs(r[peaks.back()])) {
      peaks.back() = i;
    }
  }
  return peaks;
}

// Remez exchange: Newton steps that equalise 2n + 2 alternating peaks. Returns the best parameters.
Parameters equalise(const Problem& problem, Parameters p) {
  Best best;
  best.offer(problem, p);
  for (int round = 0; round < 20; ++round) {
    Eigen::MatrixXd jacobian;
    const Eigen::VectorXd r = residuals(problem, p, &jacobian);
    std::vector<Eigen::Index> peaks = peaks_of(r);
    const auto wanted = static_cast<std::size_t>(p.size()) + 1;
    if (peaks.size() < wanted) break;
    // Remove the smaller end peak; inner pairs never occur in practice.
    while (peaks.size() > wanted) {
      peaks.erase(std::abs(r[peaks.front()]) < std::abs(r[peaks.back()]) ? peaks.begin()
                                                                         : peaks.end() - 1);
    }
    Eigen::MatrixXd system(p.size() + 1, p.size() + 1);
    Eigen::VectorXd right(p.size() + 1);
    for (std::size_t j = 0; j < wanted; ++j) {
      const auto row = static_cast<Eigen::Index>(j);
      system.row(row).head(p.size()) = jacobian.row(peaks[j]);
      system(row, p.size()) = r[peaks[j]] > 0.0 ? -1.0 : 1.0;
      right[row] = -r[peaks[j]];
    }
    Eigen::VectorXd step = PivotedQr(system).solve(right);
    const double size = step.head(p.size()).lpNorm<Eigen::Infinity>();
    if (!std::isfinite(size)) break;
    p += step.head(p.size()) * std::min(1.0, 0.3 / size);
    clamp(problem, p);
    best.offer(problem, p);
    if (size < 1e-9) break;
  }
  return best.p;
}

// Start values at the given times: E_inf is E at the end of the window, and the terms share equally
// what the series loses over the window.
Parameters start_from(const Problem& problem, const std::vector<double>& ln_tau) {
  const Eigen::Index last = problem.modulus_Pa.size() - 1;
  Parameters p(1 + 2 * static_cast<Eigen::Index>(ln_tau.size()));
  p[0] = std::log(problem.modulus_Pa[last]);
  const double lost_Pa =
      std::max(problem.modulus_Pa[0] - problem.modulus_Pa[last], 1e-12 * problem.modulus_Pa[0]);
  for (std::size_t i = 0; i < ln_tau.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    p[1 + 2 * at] = std::log(lost_Pa / static_cast<double>(ln_tau.size()));
    p[2 + 2 * at] = ln_tau[i];
  }
  return p;
}

Parameters best_parameters(const Problem& problem, int n_terms) {
  std::mt19937 random(20240607);  // fixed seed: the same result every time
  std::uniform_real_distribution<double> jitter(-0.45, 0.45);
  const double ln_from = std::log(problem.time_s[0]);
  const double ln_to = std::log(problem.time_s[problem.time_s.size() - 1]);
  const double gap = (ln_to - ln_from) / n_terms;
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(problem.time_s.size());
  std::vector<std::pair<double, Parameters>> found;
  for (int start = 0; start < 8; ++start) {
    std::vector<double> ln_tau;
    for (int i = 0; i < n_terms; ++i) {
      ln_tau.push_back(ln_from + gap * (i + 0.5 + (start > 0 ? jitter(random) : 0.0)));
    }
    const Parameters p = least_squares(problem, start_from(problem, ln_tau), ones, 60);
    found.emplace_back(residuals(problem, p, nullptr).squaredNorm(), p);
  }
  std::sort(found.begin(), found.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  Best best;
  for (std::size_t i = 0; i < 2; ++i) {
    best.offer(problem, equalise(problem, sharpen(problem, found[i].second)));
  }
  return best.p;
}

PronySeries series_from(const Parameters& p) {
  PronySeries series{std::exp(p[0]), {}};
  for (Eigen::Index i = 1; i < p.size(); i += 2) {
    series.terms.push_back({std::exp(p[i]), std::exp(p[i + 1])});
  }
  std::sort(series.terms.begin(), series.terms.end(),
            [](const auto& a, const auto& b) { return a.relaxation_time_s < b.relaxation_time_s; });
  series.equilibrium_modulus_Pa =
      std::max(series.equilibrium_modulus_Pa, kSmallestRest * instantaneous_modulus_Pa(series));
  return series;
}

}  // namespace

PronySeries chebyshev_series(const PronySeries& series, int n_terms, double t_min_s,
                             double t_max_s) {
  return series_from(best_parameters(make_problem(series, t_min_s, t_max_s), n_terms));
}

}  // namespace viscard
