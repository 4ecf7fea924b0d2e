#include "models/array/sensing/heat_response.h"

#include "models/maths/bessel_orders.h"
#include "models/maths/gauss_legendre.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace viscard {
namespace {

using Complex = std::complex<double>;

double diffusivity_m2_s(const HeatConductor& one) {
  return one.conductivity_W_mK / one.capacity_J_m3K;
}

// tanh and 1/cosh of numbers with a positive real part, without overflow.
Complex tanh_of(Complex x) {
  const Complex e = std::exp(-2.0 * x);
  return (1.0 - e) / (1.0 + e);
}
Complex sech_of(Complex x) {
  const Complex e = std::exp(-x);
  return 2.0 * e / (1.0 + e * e);
}

// Distribution of the heat that enters the film over the foot: uniform flux, or uniform temperature
// of the foot. The real distribution lies between the two.
enum class Flux { kEven, kOneTemperature };

double flux_transform(Flux flux, double kR) {
  if (flux == Flux::kEven || kR < 1e-6) return disc_mean_of_wave(kR);
  return std::sin(kR) / kR;
}

// Mean temperature of the foot on a half-space times conductivity and radius, at 1 W: Carslaw & Jaeger,
// Conduction of Heat in Solids (1959), 8.2.
double half_space(Flux flux) {
  return flux == Flux::kEven ? 8.0 / (3.0 * std::numbers::pi * std::numbers::pi) : 0.25;
}

// How finely the integrals over k are taken.
struct Quadrature {
  int points = 10;
  double panel_1_R = 1.5;
  Flux flux = Flux::kEven;
};
constexpr Quadrature kFine{10, 1.5}, kCoarse{6, 2.5};
constexpr Quadrature kOneTemperature{10, 1.5, Flux::kOneTemperature};

// Responses to 1 W through the foot at the complex rate s: the mean temperature of the foot and readings.
struct FootResponse {
  Complex foot_K, own_V, away_V;
};

// Potential of the free face per heat flux of wave number k, the film's other face grounded and base and
// face cold (eq. H2): -(p t/(eps kf)) sinh((q + k) t/2) sinhc((q - k) t/2)/((q + k) cosh(q t) cosh(k t)).
Complex potential(const HeatPath& path, double k_1_m, Complex q_1_m) {
  const double t_m = path.thickness_m;
  const Complex sum = q_1_m + k_1_m, difference = q_1_m - k_1_m;
  const Complex x = 0.5 * difference * t_m, y = 0.5 * sum * t_m;
  // sinh(y) sinhc(x) times the decay exp(-(q + k) t) of the two cosines.
  const Complex decay = std::exp(-2.0 * y);
  const Complex of_y = 0.5 * (1.0 - decay);  // sinh(y) exp(-y)
  const Complex of_x = std::abs(x) < 1e-3 ? (1.0 + x * x / 6.0) * std::exp(-y)
                                          : 0.5 * (std::exp(x - y) - std::exp(-x - y)) / x;
  const Complex of_cosines =
      0.25 * (1.0 + std::exp(-2.0 * q_1_m * t_m)) * (1.0 + std::exp(-2.0 * k_1_m * t_m));
  return -path.pyroelectric_C_m2K / (path.permittivity_F_m * path.film.conductivity_W_mK) * t_m *
         of_y * of_x / (sum * of_cosines);
}

// The mean temperature of the foot is that on a half-space, minus the effects of the base and of
// the finite time.
FootResponse foot_response(const HeatPath& path, const ElectrodeWeight& weight, double distance_m,
                           Complex s_1_s, const Quadrature& quadrature) {
  const double R_m = path.radius_m, t_m = path.thickness_m;
  const Complex s_a = s_1_s / diffusivity_m2_s(path.film);
  const double largest = 30.0 / t_m + 8.0 * std::sqrt(std::abs(s_a));
  const double step = quadrature.panel_1_R / std::max(R_m, distance_m);
  const int panels = static_cast<int>(std::ceil(largest / step));
  const QuadratureRule rule = gauss_legendre(quadrature.points);
  FootResponse sum{half_space(quadrature.flux) / (R_m * path.film.conductivity_W_mK), 0.0, 0.0};
  for (int panel = 0; panel < panels; ++panel) {
    for (std::size_t i = 0; i < rule.points.size(); ++i) {
      const double k = (panel + rule.points[i]) * largest / panels;
      const Complex q = std::sqrt(k * k + s_a);
      const double disc = disc_mean_of_wave(k * R_m);
      const double flux = flux_transform(quadrature.flux, k * R_m);
      const double part = rule.weights[i] * largest / panels / (2.0 * std::numbers::pi);
      sum.foot_K +=
          part * disc * flux * (k * tanh_of(q * t_m) / q - 1.0) / path.film.conductivity_W_mK;
      if (k * t_m > 40.0) continue;
      const Complex reading = part * k * flux * weight(k) * potential(path, k, q);
      sum.own_V += reading;
      if (distance_m > 0.0) sum.away_V += reading * std::cyl_bessel_j(0.0, k * distance_m);
    }
  }
  return sum;
}

// Heat through the foot per kelvin at the top: a rod with the film at its end (eq. H3).
Complex heat_flow(const HeatPath& path, Complex foot_K_W, Complex s_1_s) {
  const double area_m2 = std::numbers::pi * path.radius_m * path.radius_m;
  const double kA = path.pillar.conductivity_W_mK * area_m2;
  if (s_1_s == 0.0) return 1.0 / (foot_K_W + path.length_m / kA);
  const Complex decay = std::sqrt(s_1_s / diffusivity_m2_s(path.pillar));
  const Complex x = decay * path.length_m;
  return sech_of(x) / (foot_K_W + tanh_of(x) / (kA * decay));
}

struct SteadyParts {
  double foot_K_W = 0.0, foot_K = 0.0, own_V = 0.0, away_V = 0.0;
};
SteadyParts steady_parts(const HeatPath& path, const ElectrodeWeight& weight, double distance_m,
                         const Quadrature& quadrature) {
  const FootResponse foot = foot_response(path, weight, distance_m, 0.0, quadrature);
  const double flow = heat_flow(path, foot.foot_K, 0.0).real();
  return {foot.foot_K.real(), flow * foot.foot_K.real(), flow * foot.own_V.real(),
          flow * foot.away_V.real()};
}

// Talbot's contour: Abate & Valko, IJNME 60 (2004) 979; about 0.6 M digits.
std::vector<double> step_values(const HeatPath& path, const ElectrodeWeight& weight,
                                const std::vector<double>& time_s, int nodes,
                                const Quadrature& quadrature) {
  std::vector<double> values;
  for (const double t_s : time_s) {
    const double r = 2.0 * nodes / (5.0 * t_s);
    Complex sum = 0.0;
    for (int j = 0; j < nodes; ++j) {
      const double theta = j * std::numbers::pi / nodes;
      const double cot = j == 0 ? 0.0 : 1.0 / std::tan(theta);
      const Complex s = j == 0 ? Complex(r) : r * theta * Complex(cot, 1.0);
      const FootResponse foot = foot_response(path, weight, 0.0, s, quadrature);
      const Complex answer = heat_flow(path, foot.foot_K, s) * foot.own_V / s;
      const Complex turn = Complex(1.0, theta + (theta * cot - 1.0) * cot);
      sum += std::exp(s * t_s) * answer * (j == 0 ? Complex(0.5) : turn);
    }
    values.push_back(r / nodes * sum.real());
  }
  return values;
}

}  // namespace

SteadyHeat steady_heat(const HeatPath& path, const ElectrodeWeight& weight) {
  const SteadyParts fine = steady_parts(path, weight, 0.0, kFine);
  const SteadyParts coarse = steady_parts(path, weight, 0.0, kCoarse);
  const SteadyParts other = steady_parts(path, weight, 0.0, kOneTemperature);
  const double area_m2 = std::numbers::pi * path.radius_m * path.radius_m;
  return {.foot_K_W = fine.foot_K_W,
          .pillar_K_W = path.length_m / (path.pillar.conductivity_W_mK * area_m2),
          .foot_K = fine.foot_K,
          .own_V = fine.own_V,
          .quadrature_error = std::max(std::abs(coarse.foot_K / fine.foot_K - 1.0),
                                       std::abs(coarse.own_V / fine.own_V - 1.0)),
          .flux_error = std::max(std::abs(other.foot_K / fine.foot_K - 1.0),
                                 std::abs(other.own_V / fine.own_V - 1.0))};
}

double heat_at_distance_V(const HeatPath& path, const ElectrodeWeight& weight, double distance_m) {
  return steady_parts(path, weight, distance_m, kFine).away_V;
}

HeatCurve heat_step(const HeatPath& path, const ElectrodeWeight& weight,
                    const std::vector<double>& time_s) {
  HeatCurve curve{step_values(path, weight, time_s, 18, kFine), 0.0};
  const std::vector<double> coarse = step_values(path, weight, time_s, 14, kCoarse);
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    curve.error_V = std::max(curve.error_V, std::abs(coarse[i] - curve.value_V[i]));
  }
  return curve;
}

double uniform_heat_V(const HeatPath& path) {
  return path.pyroelectric_C_m2K * path.thickness_m / path.permittivity_F_m;
}

double film_time_s(const HeatPath& path) {
  return std::pow(path.thickness_m / std::numbers::pi, 2) / diffusivity_m2_s(path.film);
}

double pillar_time_s(const HeatPath& path) {
  return 4.0 * std::pow(path.length_m / std::numbers::pi, 2) / diffusivity_m2_s(path.pillar);
}

double drift_left_V(const HeatPath& path, const DummyElectrode& dummy) {
  return (1.0 - dummy.ratio * (1.0 + dummy.mismatch)) * uniform_heat_V(path);
}

double touch_left_V(const HeatPath& path, const ElectrodeWeight& weight,
                    const DummyElectrode& dummy, double distance_m) {
  const SteadyParts parts = steady_parts(path, weight, distance_m, kFine);
  return parts.own_V - dummy.ratio * (1.0 + dummy.mismatch) * parts.away_V;
}

}  // namespace viscard
