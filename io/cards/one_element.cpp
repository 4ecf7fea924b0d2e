#include "io/cards/one_element.h"

#include "models/material/retardation_spectrum.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

// A + sum B_i exp(-t/T_i), a step response.
struct Decay {
  double constant = 0.0;
  std::vector<MaxwellTerm> terms;

  // The response to a linear rise: the mean over the last `ramp_s` before t, or during the ramp the
  // integral over 0..t divided by ramp_s. Written as products to avoid cancellation at long times.
  double after_ramp(double t_s, double ramp_s) const {
    const double rise_s = std::min(t_s, ramp_s), held_s = t_s - rise_s;
    double sum = constant * rise_s;
    for (const MaxwellTerm& term : terms) {
      const double tau_s = term.relaxation_time_s;
      sum += term.modulus_Pa * tau_s * std::exp(-held_s / tau_s) * -std::expm1(-rise_s / tau_s);
    }
    return sum / ramp_s;
  }
};

// K(t) + 4 G(t)/3, without terms that do not relax.
PronySeries confined_series(const Material& material) {
  const DerivedModuli moduli = derived_moduli(material);
  PronySeries series{moduli.K0_Pa + 4.0 / 3.0 * moduli.G0_Pa, {}};
  for (const MaterialTerm& term : material.terms) {
    const double relaxes_Pa = term.k * moduli.K0_Pa + 4.0 / 3.0 * term.g * moduli.G0_Pa;
    series.equilibrium_modulus_Pa -= relaxes_Pa;
    if (relaxes_Pa > 0.0) series.terms.push_back({relaxes_Pa, term.tau_s});
  }
  return series;
}

// One length of all increments: a ramp of some of them and a hold. The ramp is longer than half the
// shortest relaxation time if the increments are.
void add_equal_increments(const ElementTestOptions& options, int ramp_steps, double end_s,
                          ElementTest& test) {
  const double step_s = std::max(test.ramp_s / ramp_steps, end_s / options.most_equal_increments);
  test.ramp_s = ramp_steps * step_s;
  const int hold_steps = static_cast<int>(std::ceil(end_s / step_s)) - ramp_steps;
  test.blocks = {{test.ramp_s, ramp_steps}, {test.ramp_s + hold_steps * step_s, hold_steps}};
}

}  // namespace

ElementTest element_test(const Material& material, const ElementTestOptions& options) {
  ElementTest test{options.kind, options.amplitude, 0.0, {}};
  double shortest_s = 1.0, longest_s = 0.1;
  for (std::size_t i = 0; i < material.terms.size(); ++i) {
    const double tau_s = material.terms[i].tau_s;
    shortest_s = i == 0 ? tau_s : std::min(shortest_s, tau_s);
    longest_s = i == 0 ? tau_s : std::max(longest_s, tau_s);
  }
  test.ramp_s = options.ramp_in_tau * shortest_s;
  if (options.most_ramps > 0.0) {  // the last block ends before 20 times the longest time
    test.ramp_s = std::max(test.ramp_s, 20.0 * longest_s / options.most_ramps);
  }
  const int ramp_steps = std::max(1, options.steps_per_tau / 2);
  if (options.most_equal_increments > 0) {
    add_equal_increments(options, ramp_steps, 10.0 * longest_s, test);
    return test;
  }
  test.blocks.push_back({test.ramp_s, ramp_steps});
  if (!options.rises) test.blocks.push_back({3.0 * shortest_s, 5 * ramp_steps});
  while (test.end_s() < 10.0 * longest_s) {  // each block doubles the time
    const TimeBlock& last = test.blocks.back();
    test.blocks.push_back({2.0 * last.end_s, options.rises ? ramp_steps : 5 * ramp_steps,
                           options.rises ? last.load + 1.0 : last.load});
  }
  return test;
}

double exact_response(const Material& material, const ElementTest& test, double time_s) {
  const PronySeries relaxation =
      test.is_confined() ? confined_series(material) : young_series(material);
  Decay decay{relaxation.equilibrium_modulus_Pa, relaxation.terms};
  if (test.is_creep()) {
    // J(t) = J_g + sum J_j - sum J_j exp(-t/lambda_j)
    const RetardationSpectrum creep = retardation_from_relaxation(relaxation);
    decay = {creep.instantaneous_compliance_1_Pa, {}};
    for (const RetardationTerm& term : creep.terms) {
      decay.constant += term.compliance_1_Pa;
      decay.terms.push_back({-term.compliance_1_Pa, term.retardation_time_s});
    }
  }
  double response = 0.0, from_s = 0.0, load = 0.0;
  for (const TimeBlock& block : test.blocks) {
    if (time_s <= from_s) break;
    if (block.load != load) {
      response += (block.load - load) * decay.after_ramp(time_s - from_s, block.end_s - from_s);
    }
    from_s = block.end_s;
    load = block.load;
  }
  return test.is_creep() ? response * material.E0_Pa : response / material.E0_Pa;
}

std::string expected_curve_csv(const Material& material, const ElementTest& test,
                               double time_factor, const std::string& header) {
  std::string out = header;
  double from_s = 0.0;
  for (const TimeBlock& block : test.blocks) {
    constexpr int kPoints = 4;
    for (int i = 1; i <= kPoints; ++i) {
      const double time_s = from_s + (block.end_s - from_s) * i / kPoints;
      out += fmt::format("{},{}\n", time_s * time_factor, exact_response(material, test, time_s));
    }
    from_s = block.end_s;
  }
  return out;
}

}  // namespace viscard
