#include "io/config/config_show.h"

#include <cmath>
#include <limits>
#include <stdexcept>

namespace viscard {
namespace {

using enum Range;

// [tip] may be omitted for a flat punch.
void show_tip(FieldVisitor& fields, PunchContact& contact) {
  std::string shape = contact.shape == TipShape::kSphere ? "sphere"
                      : contact.shape == TipShape::kCone ? "cone"
                                                         : "flat";
  fields.text({"shape", "flat"}, shape);
  if (shape != "flat" && shape != "sphere" && shape != "cone") {
    throw std::runtime_error("tip.shape is '" + shape +
                             "'; expected \"flat\", \"sphere\" or \"cone\"");
  }
  contact.shape = shape == "sphere" ? TipShape::kSphere
                  : shape == "cone" ? TipShape::kCone
                                    : TipShape::kFlat;
  fields.boolean("sticking", contact.is_sticking);
  if (shape == "sphere") {
    fields.quantity({"radius", quantities::kTipSize, kPositive, true}, contact.punch_radius_m);
    fields.quantity({"radius_u", "m", kNotNegative}, contact.punch_radius_u_m);
  }
  if (shape == "cone") {
    fields.quantity({"half_angle", "rad", kPositive, true}, contact.half_angle_rad);
    fields.quantity({"half_angle_u", "rad", kNotNegative}, contact.half_angle_u_rad);
  }
}

void show_contact(FieldVisitor& fields, PunchContact& contact) {
  if (contact.shape == TipShape::kFlat) {
    fields.quantity({"punch_diameter", quantities::kTipSize, kPositive, true, 2.0},
                    contact.punch_radius_m);
    fields.quantity(
        {.key = "punch_diameter_u", .unit = "m", .range = kNotNegative, .written_per_value = 2.0},
        contact.punch_radius_u_m);
  }
  // Required, because assuming a half-space overestimates the modulus of a thin layer.
  fields.quantity({.key = "layer_thickness",
                   .unit = quantities::kThickness,
                   .range = kPositive,
                   .is_required = true,
                   .word = "half-space",
                   .word_value = 0.0},
                  contact.layer_thickness_m);
  fields.quantity({"layer_thickness_u", "m", kNotNegative}, contact.layer_thickness_u_m);
  fields.quantity({.key = "poisson_ratio",
                   .unit = quantities::kPoissonRatio,
                   .range = kNotNegative,
                   .is_required = true},
                  contact.poisson_ratio);
  fields.quantity({"poisson_ratio_u", "1", kNotNegative}, contact.poisson_ratio_u);
}

void show_truth_material(FieldVisitor& fields, Material& material) {
  fields.text({"name", "PDMS 1:10"}, material.name);
  fields.quantity({"E0", quantities::kModulus, kPositive, true}, material.E0_Pa);
  fields.quantity({"poisson_ratio", quantities::kPoissonRatio}, material.nu);
  fields.quantity({"density", "kg/m3", kNotNegative}, material.rho_kg_m3);
  fields.list(
      "terms", material.terms.size(),
      [&](std::size_t size) {
        material.terms.assign(size, {0.0, std::numeric_limits<double>::quiet_NaN(), 0.0});
      },
      [&](FieldVisitor& inner, std::size_t i) {
        MaterialTerm& term = material.terms[i];
        inner.quantity({"g", "1", kNotNegative, true}, term.g);
        inner.quantity({"k", "1", kNotNegative}, term.k);
        inner.quantity({"tau", "s", kPositive, true}, term.tau_s);
        if (std::isnan(term.k)) term.k = term.g;  // constant Poisson ratio unless k is given
      });
}

}  // namespace

void show_specimen(FieldVisitor& fields, Specimen& specimen) {
  fields.text({"id", "pdms-1to10-a", true}, specimen.id);
  fields.text({"material", "PDMS"}, specimen.material);
  fields.quantity({"mixing_ratio", "1", kNotNegative}, specimen.mixing_ratio);
  fields.quantity({"modulus_guess", quantities::kModulus, kPositive, true},
                  specimen.modulus_guess_Pa);
  fields.quantity({"relaxation_guess", "1", kFraction}, specimen.relaxation_guess);
  fields.quantity({"density", "kg/m3", kNotNegative}, specimen.rho_kg_m3);
  fields.quantity({"temperature", "degC"}, specimen.temperature_C);
  fields.section("tip", [&](FieldVisitor& inner) { show_tip(inner, specimen.contact); });
  fields.section("contact", [&](FieldVisitor& inner) { show_contact(inner, specimen.contact); });
}

void show_truth(FieldVisitor& fields, EmulatedTruth& truth) {
  fields.integer("seed", 0, std::numeric_limits<std::int64_t>::max(), truth.seed);
  fields.section("contact", [&](FieldVisitor& inner) { show_contact(inner, truth.contact); });
  fields.section("material",
                 [&](FieldVisitor& inner) { show_truth_material(inner, truth.material); });
  fields.section("scatter", [&](FieldVisitor& inner) {
    inner.quantity({"specimen", "1", kNotNegative}, truth.specimen_scatter);
    inner.quantity({"alignment", "1", kNotNegative}, truth.alignment_scatter);
    inner.quantity({"surface", "m", kNotNegative}, truth.surface_scatter_m);
  });
  fields.section("rig", [&](FieldVisitor& inner) {
    inner.quantity({.key = "frame_stiffness",
                    .unit = "N/m",
                    .range = kPositive,
                    .word = "rigid",
                    .word_value = 0.0},
                   truth.frame_stiffness_N_m);
    inner.quantity({"surface_position", "m", kNotNegative}, truth.surface_position_m);
    inner.quantity({"force_noise", "N", kNotNegative}, truth.force_noise_N);
    inner.quantity({"force_offset", "N"}, truth.force_offset_N);
    inner.quantity({"drift_relative", "1/s"}, truth.drift_relative_per_s);
    inner.quantity({"cell_gain", "V/N", kNotNegative}, truth.cell_gain);
    inner.quantity({"cell_full_scale", "N", kPositive}, truth.cell_full_scale_N);
    inner.quantity({"cell_nonlinearity", "1"}, truth.cell_nonlinearity);
    inner.quantity({"cell_hysteresis", "1"}, truth.cell_hysteresis);
    inner.quantity({"overload", "N", kNotNegative}, truth.overload_N);
    inner.quantity({"sample_rate", "Hz", kPositive}, truth.sample_rate_Hz);
    inner.quantity({"steps", "1/m", kPositive}, truth.steps_per_m);
    inner.quantity({"acceleration", "m/s2", kPositive}, truth.acceleration_m_s2);
    inner.quantity({"max_rate", "m/s", kPositive}, truth.max_rate_m_s);
  });
}

}  // namespace viscard
