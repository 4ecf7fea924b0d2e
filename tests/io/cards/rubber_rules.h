#pragma once

#include "io/cards/hyperelastic/rubber_card.h"

#include <functional>
#include <string>
#include <vector>

namespace viscard::test {

// A law of rubber with its terms.
struct Rubber {
  HyperelasticLaw law;
  std::vector<RubberTerm> terms;
};
// Three materials, of one to three terms.
const std::vector<Rubber>& rubbers();
Rubber rubber_of(HyperelasticForm form, const std::vector<double>& moduli_Pa,
                 const std::vector<double>& shapes, const std::vector<RubberTerm>& terms);
std::string card_of(const Rubber& rubber, const std::string& target, bool may_approximate = false,
                    const std::string& elastic_only = "");

// viscard's nominal stress, MPa, at rule_times_s() of a ramp of half a second to a stretch of 1.8, and a hold.
std::vector<double> fitted_MPa(const Rubber& rubber);
const std::vector<double>& rule_times_s();

// The law of a card: energy in an axial stretch and that of the sides, and the terms beside it.
struct Written {
  std::function<double(double, double)> energy;
  std::vector<double> g, tau;

  // Difference of the axial and a side's Kirchhoff stress, by central differences.
  double difference(double stretch) const;
  // Deviatoric second Piola-Kirchhoff stresses of the law: axial, side.
  std::pair<double, double> piola(double stretch) const;
};

// Abaqus Theory Guide, eq. 4.8.2-4: tau(t) = tau_0(t) - dev sum g_i/tau_i int F_t^-1 tau_0(t - s) F_t^-T
// exp(-s/tau_i) ds; F_t is the deformation gradient of the state at t - s relative to that at t.
double abaqus_stress(const Written& card, double time_s);
// S = share S_e + sum g_i H_i with H_i <- exp(-x) H_i + gain(x) (S_new - S_old), x = dt/tau, in small steps.
struct Recursion {
  double share = 1.0;
  std::function<double(double)> gain;
};
double recursive_stress(const Written& card, const Recursion& rule, double time_s);

// Numbers of the lines below `mark`, up to a line that is none of numbers.
std::vector<double> numbers_below(const std::string& card, const std::string& mark);
// Ogden in a manual's own form: `of` gives the factor of a power sum from mu and alpha.
std::function<double(double, double)> ogden_energy(const std::vector<double>& mu,
                                                   const std::vector<double>& alpha,
                                                   const std::function<double(double, double)>& of);

// What stands in the cards, by their manuals.
Written abaqus_card(const Rubber& rubber);
Written ansys_card(const Rubber& rubber);
// FEBio: with the share g0 of the elastic child.
std::pair<Written, double> febio_card(const Rubber& rubber);

}  // namespace viscard::test
