#pragma once

#include <Eigen/Core>

#include <vector>

namespace viscard {

// The decays behind laws of few parameters, as integrals over exponentials (H >= 0, known):
//   decay: phi(t) = int H(ln T) exp(-t/T) d ln T     growth: psi(t) = int H (1 - exp(-t/T)) d ln T
//   kStretched     phi = exp(-(t/tau)^beta), psi = 1 - phi                            (eq. 35)
//   kMittagLeffler phi = E_alpha(-(t/tau)^alpha), psi = 1 - phi                       (eq. 36)
//   kPowerLaw      phi = (t/tau)^-alpha/Gamma(1 - alpha), psi = (t/tau)^alpha/Gamma(1 + alpha)
// As sums over exponentials every response of a Prony series (to a ramp, to a history, to an
// oscillation) is a response of the law too. The trapezoidal rule in ln T converges exponentially.
enum class DecayShape { kStretched, kMittagLeffler, kPowerLaw };

class DecaySpectrum {
 public:
  // exponent: alpha or beta. Throws std::invalid_argument outside kLeastExponent ... kMostExponent.
  DecaySpectrum(DecayShape shape, double exponent, bool is_growth);

  // H at s = ln(T/tau).
  double density(double s) const;
  // A step of the trapezoidal rule for an error of about 1e-8, and the s at which H has decayed to
  // nothing beyond (infinite for a power law).
  double step() const;
  double slowest() const;
  double fastest() const;
  // density(slowest() - k step()), k = 0, 1 ... Empty for a power law.
  const std::vector<double>& samples() const { return samples_; }
  bool is_growth() const { return is_growth_; }
  DecayShape shape() const { return shape_; }

 private:
  void set_nodes();

  DecayShape shape_;
  double exponent_;
  bool is_growth_;
  std::vector<double> ln_A_, weight_;  // nodes of Zolotarev's integral, ascending; kStretched
  std::vector<double> samples_;
};
inline constexpr double kLeastExponent = 0.02, kMostExponent = 0.99;

// Even in ln T.
struct LogGrid {
  double ln_first = 0.0, step = 0.15;
  Eigen::Index count = 0;
  double at(Eigen::Index j) const { return ln_first + step * static_cast<double>(j); }
};
// The grid for times between these, with e^16 at either end.
LogGrid grid_for_times(double ln_t_min, double ln_t_max);

// Weights w_j of exponentials on the grid with phi = sum_j w_j exp(-t/T_j) or psi = sum_j w_j (1 -
// exp(-t/T_j)), to about 1e-6 for times that lie e^16 inside the grid. Each node of the integral is
// shared among eight columns by interpolation; weights may be negative. The parts beyond the ends
// are added to the end columns: fast parts keep their viscosity w T, slow ones their modulus w
// (growth: fast ones their compliance w, slow ones their fluidity w/T).
Eigen::VectorXd weights_on_grid(const DecaySpectrum& spectrum, double ln_tau, const LogGrid& grid);

// Positive weights at the points of a coarse grid, the trapezoidal rule with its step, and the sums
// beyond its ends.
struct CoarseSpectrum {
  Eigen::VectorXd weights;
  // Sums below the grid of w T and w T^2, and for a growth of w.
  double faster = 0.0, faster_T = 0.0, faster_T2 = 0.0;
  // Sums above the grid: of w for a decay, of w/T for a growth.
  double slower = 0.0, slower_per_T = 0.0;
};
CoarseSpectrum coarse_spectrum(const DecaySpectrum& spectrum, double ln_tau, const LogGrid& grid);

}  // namespace viscard
