#include "io/flow/design/closed_form.h"

#include "io/basics/words.h"
#include "models/maths/result_visitor.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace viscard {
namespace {

std::vector<DesignLimit> limits_of(const ClosedFormDesign& d) {
  return design_limits(d.geometry, d.material, d.requirements);
}

LongestPillar longest_of(const ClosedFormDesign& d) {
  return longest_pillar(d.geometry.diameter_m, d.geometry.spacing_m, d.material, d.requirements);
}

Lattice lattice_of(const std::string& word) {
  if (word == "square") return Lattice::kSquare;
  if (word == "hexagonal") return Lattice::kHexagonal;
  if (word == "plain") return Lattice::kPlain;
  throw std::invalid_argument("--lattice " + word + " is not known" +
                              did_you_mean(word, {"square", "hexagonal", "plain"}) +
                              " Use square, hexagonal or plain");
}

// Lengths in um, the rest as it is.
std::string shown(double value, const std::string& unit) {
  return unit == "m" ? fmt::format("{:.4g} um", value * 1e6) : fmt::format("{:.4g}", value);
}

}  // namespace

std::vector<DesignOption> options_of(ClosedFormDesign& d) {
  SensorMaterial& m = d.material;
  SensorRequirements& r = d.requirements;
  return {
      {"diameter", "m", "of a pillar", &d.geometry.diameter_m},
      {"spacing", "m", "between pillars, edge to edge", &d.geometry.spacing_m},
      {"length", "m", "of a pillar", &d.geometry.length_m},
      {"pressure", "Pa", "largest, mean over the sensor", &r.pressure_Pa},
      {"modulus", quantities::kModulus, "Young's modulus of the pillars", &m.young_modulus_Pa},
      {"poisson", quantities::kPoissonRatio, "Poisson ratio of the pillars", &m.poisson_ratio},
      {"surface-energy", "J/m2", "gamma of the pillars", &m.surface_energy_J_m2},
      {"work-of-adhesion", "J/m2", "w of the contact; twice gamma unless given",
       &m.work_of_adhesion_J_m2},
      {"strength", "Pa", "sigma_th, adhesion strength of the contact", &m.adhesion_strength_Pa},
      {"end-factor", "1", "K of Euler's formula: 0.5, 0.699, 1 or 2", &r.end_factor},
      {"film-thickness", "m", "of the piezoelectric film", &r.film_thickness_m},
      {"charge-constant", "C/N", "|d33| of the film", &m.charge_constant_C_N},
      {"permittivity", "1", "relative, of the film", &m.relative_permittivity},
      {"smallest-feature", "m", "narrowest pillar or gap that can be made", &r.smallest_feature_m},
      {"aspect-ratio", "1", "largest length over diameter that can be made",
       &r.largest_aspect_ratio},
      {"pitch", "m", "coarsest diameter plus spacing; 0: any", &r.coarsest_pitch_m},
      {"sensitivity", "1", "least one beside a film without pillars; 0: any",
       &r.least_relative_sensitivity}};
}

void refuse_negative(const std::string& name, double value, const std::string& typed) {
  if (value >= 0.0 || name.ends_with("poisson")) return;
  throw std::invalid_argument(name + " is " + typed + "; it must be positive");
}

ClosedFormDesign closed_form_design(
    const std::function<std::optional<double>(const char* name, const QuantityOrUnit& unit)>& given,
    const std::optional<std::string>& lattice) {
  ClosedFormDesign design;
  bool has_adhesion = false;
  for (const DesignOption& option : options_of(design)) {
    const std::optional<double> value = given(option.name, option.unit);
    if (!value) continue;
    *option.value = *value;
    has_adhesion = has_adhesion || option.value == &design.material.work_of_adhesion_J_m2;
  }
  if (!has_adhesion) {
    design.material.work_of_adhesion_J_m2 = 2.0 * design.material.surface_energy_J_m2;
  }
  if (lattice) design.requirements.lattice = lattice_of(*lattice);
  validate(design.geometry, design.material, design.requirements);
  return design;
}

void show_keys(ResultVisitor& v, const ClosedFormDesign& d) {
  const std::vector<DesignLimit> limits = limits_of(d);
  const LongestPillar longest = longest_of(d);
  const SensorGeometry& g = d.geometry;
  const double concentration =
      stress_concentration(g.diameter_m, g.spacing_m, d.requirements.lattice);
  v("admissible", is_admissible(limits), "whether all limits are met");
  v("limited_by", longest.limited_by, "the limit that decides");
  v.list("limits", "all limits", limits, [&](const DesignLimit& limit) {
    v("is_upper", limit.is_upper, "false: a lower limit");
    v("limit", limit.limit, "that it must keep");
    v("margin", limit.margin(), "relative distance to the limit");
    v("met", limit.is_met(), "whether it is kept");
    v("name", limit.name, "its name");
    v("unit", limit.unit, "of both");
    v("value", limit.value, "of this design");
  });
  v("longest_m", longest.length_m, "longest admissible pillar");
  v("pitch_m", g.diameter_m + g.spacing_m, "from pillar to pillar");
  v("pull_off_force_N", pull_off_force_N(g.diameter_m, d.material), "of a pillar");
  v("relative_sensitivity", concentration, "to a film without pillars");
  v("sensitivity_V_Pa", sensitivity_V_Pa(g.diameter_m, g.spacing_m, d.material, d.requirements),
    "volts for a pascal");
  v("stress_concentration", concentration, "pressure under a pillar over pressure on the sensor");
}

std::string text_from_design(const ClosedFormDesign& d) {
  const std::vector<DesignLimit> limits = limits_of(d);
  const LongestPillar longest = longest_of(d);
  std::string out;
  for (const DesignLimit& l : limits) {
    out +=
        fmt::format("  {:<16} {:>12} {} {:<12} {}\n", l.name, shown(l.value, l.unit),
                    l.is_upper ? "<=" : ">=", shown(l.limit, l.unit), l.is_met() ? "" : "NOT MET");
  }
  const SensorGeometry& g = d.geometry;
  out += fmt::format(
      "  sensitivity {:.4g} mV/kPa, {:.4g} times a film without pillars; pitch {:.4g} um\n",
      1e6 * sensitivity_V_Pa(g.diameter_m, g.spacing_m, d.material, d.requirements),
      stress_concentration(g.diameter_m, g.spacing_m, d.requirements.lattice),
      1e6 * (g.diameter_m + g.spacing_m));
  if (longest.length_m > 0.0) {
    out += fmt::format("  longest admissible pillar {:.4g} um, limited by {}\n",
                       longest.length_m * 1e6, longest.limited_by);
  } else {
    out += fmt::format("  no length is admissible: {} rules it out\n", longest.limited_by);
  }
  out += (is_admissible(limits) ? "  admissible\n" : "  not admissible\n");
  return out;
}

}  // namespace viscard
