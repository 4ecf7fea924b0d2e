// Codes with one Young's modulus and viscous damping: the reduction to a band of frequencies
// (models/material/frequency_band.h). Sources: MuJoCo XML reference, flexcomp/elasticity (damping:
// "Rayleigh's damping coefficient, units of time", it scales the stiffness) and
// engine_passive.c; PhysX 5.6, softBody.cu (elasticityDamping/dt is the gamma of XPBD, so the stress
// is C (strain + elasticityDamping strain rate), the volume term of the co-rotational model damped
// by 2 mu instead of lambda) and the USD schema PhysxDeformableBodyMaterialAPI. None ran here.
#include "io/basics/patterns.h"
#include "io/cards/card_values.h"
#include "io/cards/list_differences.h"
#include "io/cards/named_values.h"
#include "io/cards/targets/card_targets.h"

#include <fmt/format.h>

#include <stdexcept>

namespace viscard {
namespace {

std::string in_words(const LossDeviation& deviation) {
  return fmt::format("off by up to {:.2g}, at {:.3g} Hz, where it is {:.2g}", deviation.value,
                     deviation.at_Hz, deviation.loss_factor);
}

std::string storage_note(const BandReduction& reduced) {
  return fmt::format(
      "E' differs from the constant E by up to {:.1e} over the band, where it grows "
      "{:.3g} times",
      reduced.storage_change, reduced.storage_ratio);
}

// One modulus that is off by half says nothing about the material any more.
constexpr double kWorstStorageChange = 0.5;

std::string band_refusal(const CardBody& body) {
  const BandReduction reduced = reduce_to_band(body.material, body.band());
  if (reduced.storage_change <= kWorstStorageChange) return "";
  return fmt::format(
      "from {:g} to {:g} Hz the storage modulus of this material grows {:.3g} times, so one "
      "Young's modulus is up to {:.3g} % wrong; name a narrower --band, choose a target that takes "
      "the whole series or a table, or pass --approximate to write it all the same",
      body.band().from_Hz, body.band().to_Hz, reduced.storage_ratio,
      100.0 * reduced.storage_change);
}

// E, nu and the density.
std::vector<CardValue> elastic_values(const BandReduction& reduced, const CardBody& body) {
  std::vector<CardValue> out{{"E", to_card(reduced.young_Pa, body.units.stress_exponent)},
                             {"nu", reduced.poisson}};
  const bool has_density = body.target.states_density && body.numbers.density > 0.0;
  if (has_density) out.push_back({"density", body.numbers.density});
  return out;
}

std::vector<CardValue> rayleigh_values(const CardBody& body) {
  const BandReduction reduced = reduce_to_band(body.material, body.band());
  std::vector<CardValue> out = elastic_values(reduced, body);
  out.push_back({"loss_factor", reduced.loss_factor});
  out.push_back({"rayleigh_alpha", to_card(reduced.alpha_1_s, -body.units.time_exponent)});
  out.push_back({"rayleigh_beta", to_card(reduced.beta_s, body.units.time_exponent)});
  return out;
}

std::string rayleigh_note(const CardBody& body) {
  const BandReduction reduced = reduce_to_band(body.material, body.band());
  return storage_note(reduced) + "; the loss factor of alpha and beta is " +
         in_words(reduced.of_rayleigh) + "; the constant one is " +
         in_words(reduced.of_loss_factor);
}

std::string write_rayleigh(const CardBody& body) {
  std::string out;
  for (const CardValue& value : rayleigh_values(body)) {
    out += fmt::format("{} = {}\n", value.name, value.value);
  }
  return out;
}

void read_rayleigh(const std::string& text, ReadCard& card) {
  for (const CardLine& line : card_lines(text, "#")) {
    if (trimmed(line.text).empty()) continue;
    const auto match = first_match(line.text, "^\\s*(\\w+)\\s*=\\s*(\\S+)\\s*$");
    if (!match) throw std::runtime_error(at_line(line, "name = number expected"));
    const double value = card_number(match->group[2], line, match->group[1]);
    card.values.push_back({match->group[1], value});
  }
  if (card.values.empty()) throw std::runtime_error("the card has no lines name = number");
}

// E, nu, damping in proportion to the stiffness: beta alone.
std::vector<CardValue> beta_values(const CardBody& body) {
  const BandReduction reduced = reduce_to_band(body.material, body.band());
  std::vector<CardValue> out = elastic_values(reduced, body);
  out.push_back({"damping", to_card(reduced.beta_alone_s, body.units.time_exponent)});
  return out;
}

std::string beta_note(const CardBody& body) {
  const BandReduction reduced = reduce_to_band(body.material, body.band());
  return storage_note(reduced) + "; the loss factor omega times damping is " +
         in_words(reduced.of_beta_alone);
}

std::string write_mujoco(const CardBody& body) {
  const std::vector<CardValue> values = beta_values(body);
  return fmt::format("<elasticity young=\"{}\" poisson=\"{}\" damping=\"{}\"/>\n",
                     value_of(values, "E"), value_of(values, "nu"), value_of(values, "damping"));
}

// The names of an attribute and of its value.
struct AttributeName {
  const char* attribute;
  const char* value;
};

void add_attribute(const std::string& text, const NamedNumbers& named, const AttributeName& name,
                   ReadCard& card) {
  if (named.count(name.attribute) == 0) return;
  check_single_element(text, std::string("\\b") + name.attribute + "\\s*=", name.attribute, card);
  card.values.push_back({name.value, one_of(named, name.attribute)});
}

void read_mujoco(const std::string& commented, ReadCard& card) {
  std::string text;
  for (const CardLine& line : card_lines(commented, "<!--")) text += line.text + "\n";
  const auto element = first_match(text, "<elasticity\\b([^<>]*)/?>");
  if (!element) throw std::runtime_error("the card has no <elasticity .../>");
  check_single_element(text, "<elasticity\\b", "<elasticity .../>", card);
  const NamedNumbers named =
      named_lists(element->group[1], "\\b(young|poisson|damping)\\s*=\\s*(\"[^\"]*\"|'[^']*')");
  for (const AttributeName& name :
       {AttributeName{"young", "E"}, {"poisson", "nu"}, {"damping", "damping"}}) {
    add_attribute(element->group[1], named, name, card);
  }
}

constexpr const char* kPhysxPrefix = "physxDeformableBodyMaterial:";

std::string write_physx(const CardBody& body) {
  const UnitSystem& units = body.units;
  if (units.time_exponent != 0) {
    throw std::invalid_argument(
        "USD and PhysX count time in seconds; choose a unit system with s (--units SI, mm-t-s, "
        "um-kg-s or cgs)");
  }
  const int mass_exponent = units.density_exponent + 3 * units.length_exponent;
  std::string out =
      fmt::format("(\n    metersPerUnit = {}\n    kilogramsPerUnit = {}\n)\n",
                  from_card(1.0, units.length_exponent), from_card(1.0, mass_exponent));
  out += fmt::format(
      "def Material \"{}\" (\n    prepend apiSchemas = "
      "[\"PhysxDeformableBodyMaterialAPI\"]\n)\n{{\n",
      body.name);
  const auto row = [&](const char* name, double value) {
    out += fmt::format("    float {}{} = {}\n", kPhysxPrefix, name, value);
  };
  for (const CardValue& value : beta_values(body)) {
    if (value.name == "E") row("youngsModulus", value.value);
    if (value.name == "nu") row("poissonsRatio", value.value);
    if (value.name == "density") row("density", value.value);
    if (value.name == "damping") row("elasticityDamping", value.value);
  }
  return out + fmt::format("    float {}dampingScale = 1\n}}\n", kPhysxPrefix);
}

void read_physx(const std::string& commented, ReadCard& card) {
  const std::string text = without_line_comments(commented, "#");
  const auto name = first_match(text, "def\\s+Material\\s+\"(\\w+)\"");
  if (!name) throw std::runtime_error("the card has no def Material \"name\"");
  card.name = name->group[1];
  check_single_element(text, "def\\s+Material\\b", "def Material", card);
  const NamedNumbers named = named_lists(text, "(\\w+)\\s*=\\s*([-+.\\deE]+)\\s*(?:\\n|$)");
  for (const AttributeName& attribute : {AttributeName{"youngsModulus", "E"},
                                         {"poissonsRatio", "nu"},
                                         {"density", "density"},
                                         {"elasticityDamping", "damping"}}) {
    add_attribute(text, named, attribute, card);
  }
  if (named.count("dampingScale") > 0 && one_of(named, "dampingScale") != 1.0) {
    card.add("damping-scale", "dampingScale is not 1: the damping is scaled down");
  }
  const auto is_other = [&](const char* unit, double exponent_of_ten) {
    return named.count(unit) > 0 && relative_mismatch(one_of(named, unit), exponent_of_ten) > 1e-9;
  };
  const int mass_exponent = card.units.density_exponent + 3 * card.units.length_exponent;
  if (is_other("metersPerUnit", from_card(1.0, card.units.length_exponent)) ||
      is_other("kilogramsPerUnit", from_card(1.0, mass_exponent))) {
    card.add("stage-units",
             std::string("metersPerUnit or kilogramsPerUnit is not that of ") + card.units.name);
  }
  if (!first_match(text, "PhysxDeformableBodyMaterialAPI")) {
    card.add("missing-schema", "PhysxDeformableBodyMaterialAPI is not applied: nothing is read");
  }
}

}  // namespace

CardTarget rayleigh_target() {
  return {.name = "rayleigh",
          .code = "any code with E, nu and Rayleigh damping or a loss factor",
          .extension = ".txt",
          .comment = "#",
          .write = write_rayleigh,
          .read = read_rayleigh,
          .takes_incompressible = true,
          .evidence_note = "read back by viscard",
          .advice =
              "C = alpha M + beta K, or K (1 + i loss_factor): one of the two. Abaqus *DAMPING, "
              "ALPHA=, BETA=; ANSYS MP,ALPD and MP,BETD; a damping ratio is half a loss factor.",
          .cannot_represent =
              "relaxation and creep, the change of E with frequency, damping "
              "outside the band",
          .conventions =
              "constant E and nu of the storage moduli; loss factor of K (1 + i eta), or "
              "C = alpha M + beta K by least squares over the band",
          .values = rayleigh_values,
          .band_note = rayleigh_note,
          .band_refusal = band_refusal};
}

CardTarget mujoco_target() {
  return {.name = "mujoco",
          .code = "MuJoCo flexcomp",
          .extension = ".xml",
          .comment = "<!--",
          .write = write_mujoco,
          .read = read_mujoco,
          .states_density = false,
          .evidence = Evidence::kSource,
          .evidence_note = "XML reference and engine_passive.c; not run",
          .advice =
              "Put the element into <flexcomp dim=\"3\">, whose mass is that of the whole "
              "body. MuJoCo has no units: lengths, masses and times must be of this system.",
          .cannot_represent =
              "relaxation and creep: damping in proportion to the stiffness rises "
              "with frequency, that of a polymer does not",
          .conventions =
              "constant E and nu of the storage moduli; damping is beta in units of time, "
              "the damping matrix is beta times the stiffness",
          .values = beta_values,
          .band_note = beta_note,
          .band_refusal = band_refusal};
}

CardTarget physx_target() {
  return {.name = "physx",
          .code = "PhysX deformable body (USD)",
          .extension = ".usda",
          .comment = "#",
          .write = write_physx,
          .read = read_physx,
          .evidence = Evidence::kSource,
          .evidence_note = "softBody.cu and the USD schema; not run",
          .advice =
              "Without USD: createDeformableVolumeMaterial(E, nu, friction) and "
              "setElasticityDamping(damping); before 5.5 createFEMSoftBodyMaterial and "
              "setDamping. Newer schemas call the first two omniphysics:youngsModulus and "
              "omniphysics:poissonsRatio. Friction is not of the material; set it.",
          .cannot_represent =
              "relaxation and creep: damping in proportion to the stiffness rises "
              "with frequency, that of a polymer does not; numbers are floats",
          .first_line = "#usda 1.0\n",
          .conventions =
              "constant E and nu of the storage moduli; elasticityDamping is beta in s, "
              "the stress of a strain rate is beta times that of the strain",
          .values = beta_values,
          .band_note = beta_note,
          .band_refusal = band_refusal};
}

}  // namespace viscard
