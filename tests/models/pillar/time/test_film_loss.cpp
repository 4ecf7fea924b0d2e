// A film that leaks and whose polarisation follows late, against closed forms (eq. 37).
#include "models/material/film_loss.h"
#include "models/material/hereditary.h"
#include "models/pillar/time/readout.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <random>

using namespace viscard;

namespace {

using Complex = std::complex<double>;

constexpr double kElectrode_F = 12e-15;

double tan_delta(const FilmLoss& loss, double omega_rad_s) {
  const Complex eps = 1.0 + added_permittivity(loss, Complex(0.0, omega_rad_s));
  return -eps.imag() / eps.real();
}

// The voltage over that at once, from the charges themselves.
Complex by_charges(const Readout& readout, const FilmPort& film, double omega_rad_s) {
  const Complex s(0.0, omega_rad_s);
  const Complex taken_F = film.capacitance_F + readout.capacitance_F +
                          film.dielectric_F * added_permittivity(film.loss, s) +
                          1.0 / readout.resistance_Ohm / s;
  return film.capacitance_F / taken_F;
}

}  // namespace

TEST_CASE("a charge on a film that leaks decays with resistivity times permittivity", "[pillar]") {
  const FilmPort film{kElectrode_F, kElectrode_F, {.leakage_s = 1062.5}};
  const std::vector<double> time_s = {0.0, 0.0, 1.0, 1062.5, 1e4};
  const std::vector<double> voltage = reading_of(open_filter(film), time_s, {0, 3, 3, 3, 3});
  for (std::size_t i = 1; i < time_s.size(); ++i) {
    CHECK(voltage[i] == Approx(3.0 * std::exp(-time_s[i] / 1062.5)).epsilon(1e-12));
  }
  // What strain adds to the capacitance keeps its charge longer.
  const FilmPort stiffened{kElectrode_F, 0.8 * kElectrode_F, {.leakage_s = 100.0}};
  CHECK(open_filter(stiffened).time_constant_s == Approx(125.0).epsilon(1e-14));
}

TEST_CASE("one late polarisation gives the loss peak of Debye", "[pillar]") {
  const double added = 0.7, tau_s = 3e-4, at_last = 1.0 + added;
  const FilmLoss loss{.terms = {{added, tau_s}}};
  const double peak_rad_s = std::sqrt(at_last) / tau_s;  // w tau = sqrt(eps_s/eps_inf)
  const double peak = added / (2.0 * std::sqrt(at_last));
  CHECK(tan_delta(loss, peak_rad_s) == Approx(peak).epsilon(1e-14));
  CHECK(tan_delta(loss, 1.05 * peak_rad_s) < peak);
  CHECK(tan_delta(loss, peak_rad_s / 1.05) < peak);
  // The voltage of a charge that stays falls from 1 to eps_inf/eps_s with tau eps_inf/eps_s.
  const ReadoutFilter open = open_filter({kElectrode_F, kElectrode_F, loss});
  const std::vector<double> voltage =
      reading_of(open, {0.0, 0.0, tau_s / at_last, 1e3 * tau_s}, {0, 1, 1, 1});
  CHECK(voltage[1] == Approx(1.0).epsilon(1e-14));
  CHECK(voltage[2] ==
        Approx(1.0 / at_last + (1.0 - 1.0 / at_last) * std::exp(-1.0)).epsilon(1e-12));
  CHECK(voltage[3] == Approx(1.0 / at_last).epsilon(1e-12));
  CHECK(std::isinf(open.time_constant_s));
}

TEST_CASE("readings over frequency are those of the charges", "[pillar]") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int i = 0; i < 200; ++i) {
    FilmPort film{kElectrode_F, (0.5 + 0.5 * uniform(random)) * kElectrode_F};
    const int terms = 1 + static_cast<int>(20.0 * uniform(random));
    for (int k = 0; k < terms; ++k) {
      film.loss.terms.push_back({uniform(random), std::pow(10.0, 20.0 * uniform(random) - 10.0)});
    }
    Readout readout;
    if (i % 2 == 0) film.loss.leakage_s = std::pow(10.0, 12.0 * uniform(random) - 3.0);
    if (i % 3 == 0) readout.resistance_Ohm = std::pow(10.0, 6.0 + 8.0 * uniform(random));
    if (i % 5 == 0) readout.capacitance_F = 1e-12 * uniform(random);
    const ReadoutFilter filter = readout_filter(readout, film);
    for (double omega = 1e-9; omega < 1e10; omega *= 7.0) {
      const Complex expected = by_charges(readout, film, omega);
      CHECK(std::abs(response(filter, omega) - expected) <= 1e-9 * std::abs(expected));
      CHECK(expected.imag() >= 0.0);  // the film takes energy, and never gives any
    }
  }
}

TEST_CASE("a slow or fast time of the film leaves nothing or all", "[pillar]") {
  for (const double share : {0.02, 1.0}) {
    const FilmPort slow{kElectrode_F, kElectrode_F, {.terms = {{share, 1e12}}}};
    const FilmPort fast{kElectrode_F, kElectrode_F, {.terms = {{share, 1e-12}}}};
    const auto after_1_s = [](const FilmPort& film) {
      return reading_of(open_filter(film), {0.0, 1.0}, {0.0, 1.0}).back();
    };
    CHECK(after_1_s(slow) == Approx(1.0).epsilon(1e-11));
    CHECK(after_1_s(fast) == Approx(1.0 / (1.0 + share)).epsilon(1e-11));
  }
}

TEST_CASE("a voltage in time has the spectrum that frequency gives", "[pillar]") {
  // The response to an oscillation since long ago, between samples so close that they may be joined by lines.
  const FilmPort film{
      kElectrode_F, 0.9 * kElectrode_F, {.leakage_s = 0.4, .terms = {{0.3, 0.02}, {0.2, 0.5}}}};
  const ReadoutFilter filter = readout_filter({.capacitance_F = 5e-15}, film);
  const double omega = 9.0;
  std::vector<double> time_s, voltage;
  for (int i = 0; i <= 40000; ++i) {
    time_s.push_back(5e-4 * i);
    voltage.push_back(std::sin(omega * time_s.back()));
  }
  const std::vector<double> reading = reading_of(filter, time_s, voltage);
  const Complex gain = response(filter, omega);
  for (std::size_t i = 38000; i < reading.size(); i += 123) {
    CHECK(reading[i] ==
          Approx((gain * std::exp(Complex(0.0, omega * time_s[i]))).imag()).margin(3e-6));
  }
}

TEST_CASE("the film takes up the charge that the voltage lacks", "[pillar]") {
  const FilmPort film{kElectrode_F, 0.9 * kElectrode_F, {.terms = {{0.3, 0.02}, {0.2, 0.5}}}};
  std::vector<double> time_s, open_V;
  for (int i = 0; i <= 5000; ++i) {
    time_s.push_back(1e-3 * i);
    open_V.push_back(std::min(1.0, 2.0 * time_s.back()));
  }
  const std::vector<double> voltage = reading_of(open_filter(film), time_s, open_V);
  const std::vector<double> charge = film_charge_of({}, film, time_s, voltage);
  for (std::size_t i = 0; i < charge.size(); i += 100) {
    CHECK(charge[i] ==
          Approx(open_V[i]).margin(1e-5));  // the voltage is no straight line between samples
  }
}

TEST_CASE("terms have the loss tangents of the table, and none is negative", "[pillar]") {
  const std::vector<double> frequency_Hz = {1.0, 1e3, 1e5, 1e7};
  const std::vector<double> wanted = {0.05, 0.02, 0.015, 0.04};
  const FilmLoss loss{.terms = terms_from_tan_delta(frequency_Hz, wanted)};
  double last = 1e300;
  for (double f = 1.0; f <= 1e7; f *= 1.3) {
    const double omega = 2.0 * std::numbers::pi * f;
    const double real = added_permittivity(loss, Complex(0.0, omega)).real();
    CHECK(real <= last);  // the permittivity falls with frequency
    last = real;
    CHECK(tan_delta(loss, omega) > 0.01);
  }
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const double now = tan_delta(loss, 2.0 * std::numbers::pi * frequency_Hz[i]);
    CHECK(std::abs(now - wanted[i]) <= 0.03 * wanted[i]);
  }
  for (const FilmTerm& term : loss.terms) CHECK(term.share > 0.0);
  CHECK(terms_from_tan_delta({1.0, 10.0}, {0.0, 0.0}).empty());
  // Narrower than one relaxation, or falling faster: no film has it.
  CHECK_THROWS_WITH(terms_from_tan_delta({1, 10, 12, 15, 100}, {1e-3, 1e-3, 0.1, 1e-3, 1e-3}),
                    Catch::Matchers::Contains("no sum of relaxations"));
  CHECK_THROWS_AS(terms_from_tan_delta({1.0, 1.0}, {0.1, 0.1}), std::invalid_argument);
  CHECK_THROWS_AS(terms_from_tan_delta({1.0}, {-0.1}), std::invalid_argument);
}

TEST_CASE("the time constant of a circuit is the area under its step, not its slowest term",
          "[pillar]") {
  const double C_F = 2e-12;
  const Readout circuit{.resistance_Ohm = 1e10, .capacitance_F = 1e-12};
  const FilmPort film{C_F, C_F, {.terms = {{0.01, 0.5}, {0.01, 5.0}}}};
  const ReadoutFilter filter = readout_filter(circuit, film);
  CHECK(filter.time_constant_s == Approx(0.03).epsilon(1e-14));
  double area_s = 0.0;
  for (const MaxwellTerm& term : filter.step.terms) {
    area_s += term.modulus_Pa * term.relaxation_time_s;
  }
  CHECK(area_s == Approx(filter.time_constant_s).epsilon(1e-9));
}
