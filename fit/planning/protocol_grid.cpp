#include "fit/planning/protocol_study.h"

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

constexpr double kFactorOfModulus = 1.3;
constexpr double kFactorOfTerms = 2.0;

using Change = std::function<void(MaterialTerm&)>;

Material with_terms(Material material, const Change& change) {
  double sum = 0.0;
  for (MaterialTerm& term : material.terms) {
    change(term);
    sum += term.g;
  }
  // A material relaxes by less than everything.
  constexpr double kMost = 0.95;
  for (MaterialTerm& term : material.terms) {
    if (sum > kMost) term.g *= kMost / sum;
    term.k = term.g;
  }
  return material;
}

// Two standard errors as a factor; the usual factor without a standard error.
double factor_of(double relative_error, double otherwise) {
  return relative_error > 0.0 ? std::exp(std::min(2.0 * relative_error, std::log(4.0))) : otherwise;
}

double factor_of_modulus(const Material& guess) {
  if (!guess.uncertainty) return kFactorOfModulus;
  const MaterialUncertainty& known = *guess.uncertainty;
  const double half = 0.5 * (known.E0_Pa_95.high - known.E0_Pa_95.low) / guess.E0_Pa;
  return factor_of(std::hypot(half / kNormal95, known.systematic_relative), kFactorOfModulus);
}

}  // namespace

std::vector<TestPlan> protocol_grid(const ProtocolOptions& options) {
  std::vector<TestPlan> plans;
  for (const double depth : {0.5, 1.0}) {
    for (const double ramp_s : {0.25, 0.5, 1.0, 2.0}) {
      for (const double hold_s : {5.0, 10.0, 20.0, 40.0, 60.0, 120.0, 300.0, 600.0}) {
        for (const double recovery_s : {0.0, 5.0, 10.0, 20.0, 60.0, 120.0}) {
          if (recovery_s > hold_s) continue;
          for (const double unload : {0.1, 0.4}) {
            if (recovery_s == 0.0 && unload > 0.1) continue;
            TestPlan plan = options.base;
            plan.protocol = "ramp-hold";
            plan.preload_N = 0.0;
            plan.depth_m = depth * options.deepest_m;
            plan.ramp_s = ramp_s;
            plan.hold_s = hold_s;
            plan.recovery_s = recovery_s;
            plan.unload_to_fraction = unload;
            plans.push_back(plan);
          }
        }
      }
    }
  }
  return plans;
}

std::vector<Material> guesses_about(const Material& guess) {
  std::vector<Material> guesses{guess};
  const auto term_of = [&](std::size_t i) {
    return guess.uncertainty && i < guess.uncertainty->terms.size() ? guess.uncertainty->terms[i]
                                                                    : TermUncertainty{};
  };
  for (const int sign : {-1, 1}) {
    const auto off = [&](double factor) { return sign > 0 ? factor : 1.0 / factor; };
    Material other = guess;
    other.E0_Pa *= off(factor_of_modulus(guess));
    guesses.push_back(other);
    std::size_t i = 0;
    guesses.push_back(with_terms(guess, [&](MaterialTerm& term) {
      const TermUncertainty known = term_of(i++);
      const double g = term.g;
      term.g *= off(factor_of(known.modulus_se_Pa / (g * guess.E0_Pa), kFactorOfTerms));
    }));
    i = 0;
    guesses.push_back(with_terms(guess, [&](MaterialTerm& term) {
      term.tau_s *= off(factor_of(term_of(i++).ln_tau_se, kFactorOfTerms));
    }));
  }
  return guesses;
}

}  // namespace viscard
