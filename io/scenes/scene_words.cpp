#include "io/scenes/scene_words.h"

#include "io/basics/named_file.h"
#include "io/materials/material_file.h"
#include "models/material/liquid.h"

#include <algorithm>

namespace viscard {

void show_material(FieldVisitor& v, RawMaterial& m) {
  m.judged = v.judged();
  v.text({"file", "pdms_1to10_seed.json"}, m.file);
  v.quantity({.key = "ratio", .range = Range::kPositive}, m.ratio);
  v.quantity({.key = "E", .unit = quantities::kModulus, .range = Range::kPositive}, m.E_Pa);
  v.quantity({.key = "nu", .unit = quantities::kPoissonRatio}, m.nu);
  v.quantity({.key = "rho", .unit = "kg/m3", .range = Range::kPositive}, m.rho_kg_m3);
}

void show_printed(FieldVisitor& v, std::vector<PrintedValue>& printed) {
  v.list(
      "printed", printed.size(), [&](std::size_t n) { printed.resize(n); },
      [&](FieldVisitor& p, std::size_t i) {
        p.text({"name", "lateral 1", true}, printed[i].name);
        p.text({"value", "16103 Hz", true}, printed[i].value);
        p.text({"note", "the mesh of the source is coarse"}, printed[i].note);
      });
}

namespace {

// Names under which people ask for the largest stress at the rim of the bond. There is none: it is
// infinite in an elastic body (Williams, J. Appl. Mech. 19 (1952) 526).
bool is_peak_stress(const std::string& name) {
  return name.find("peak_stress") != std::string::npos || name == "base_stress_max";
}

}  // namespace

void check_wanted(const std::vector<std::string>& wanted, const std::vector<std::string>& known) {
  for (const std::string& name : wanted) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    if (is_peak_stress(name)) {
      throw SceneMistake("want.quantities",
                         "the peak stress at the rim of the bond is infinite in an elastic body (a "
                         "clamped corner): it grows with every refinement. Ask for "
                         "base_stress_rim_mean, the mean over the outermost tenth of the radius, "
                         "or for base_stress_at_half_radius");
    }
    throw SceneMistake("want.quantities", "this analysis has no '" + name + "'" +
                                              did_you_mean(name, known) +
                                              " It has: " + listed(known));
  }
}

EffectChoices choices_of(const std::map<std::string, std::string>& effects) {
  EffectChoices choices;
  for (const auto& [name, word] : effects) {
    if (word.empty()) continue;
    choices[name] = choice<EffectChoice>(
        "effects." + name, word,
        {{"auto", EffectChoice::kAuto}, {"on", EffectChoice::kOn}, {"off", EffectChoice::kOff}});
  }
  return choices;
}

std::filesystem::path named_file(const std::string& key, const std::filesystem::path& folder,
                                 const std::string& name, FileKind wanted) {
  const std::string fault = fault_of_named_file(folder, name, wanted);
  if (!fault.empty()) throw SceneMistake(key, fault);
  return folder / name;
}

MediumFile film_medium(const std::string& key, const RawMaterial& raw,
                       const std::filesystem::path& folder) {
  if (!raw.file.empty()) {
    return read_medium(named_file(key + ".file", folder, raw.file, FileKind::kMedium), raw.judged);
  }
  if (!(raw.E_Pa > 0.0)) throw SceneMistake(key, "needs E (and nu, rho) or a file");
  try {
    return {.medium = isotropic_medium(raw.E_Pa, raw.nu, raw.rho_kg_m3)};
  } catch (const std::invalid_argument& error) {
    throw SceneMistake(key, error.what());
  }
}

std::optional<HyperelasticFile> pillar_rubber(const RawMaterial& raw,
                                              const std::filesystem::path& folder,
                                              const std::string& key) {
  if (raw.file.empty()) return std::nullopt;
  const auto path = named_file(key + ".file", folder, raw.file, FileKind::kMaterial);
  if (!looks_like_hyperelastic_file(path)) return std::nullopt;
  HyperelasticFile file = read_hyperelastic(path, raw.judged);
  if (!file.is_trustworthy) {
    const std::string why = file.defects.empty() ? "" : " (" + file.defects.front() + ")";
    throw SceneMistake(key + ".file", "the law of rubber in '" + raw.file +
                                          "' is not to be trusted" + why +
                                          "; fit another law, or more tests");
  }
  if (raw.E_Pa > 0.0 || raw.ratio > 0.0) {
    throw SceneMistake(key, "the modulus comes from the law of rubber; leave out E and ratio");
  }
  if (!(raw.nu > 0.0)) {
    throw SceneMistake(key,
                       "a law of rubber needs nu beside its file, such as nu = 0.499 (0.5: "
                       "incompressible), and rho where vibration counts");
  }
  return file;
}

namespace {

// Rubber at small strain. The terms take a share of all stress: nu stays in time, as in a fit of E(t).
Material linear_part(const HyperelasticFile& rubber, const RawMaterial& raw) {
  Material material;
  material.E0_Pa = rubber.E0_Pa;
  material.nu = raw.nu;
  material.rho_kg_m3 = raw.rho_kg_m3;
  for (const RubberTerm& term : rubber.terms) {
    material.terms.push_back({.g = term.g, .k = term.g, .tau_s = term.tau_s});
  }
  return material;
}

}  // namespace

Material pillar_material(const RawMaterial& raw, const std::filesystem::path& folder,
                         const std::string& key) {
  if (!raw.file.empty()) {
    const auto path = named_file(key + ".file", folder, raw.file, FileKind::kMaterial);
    if (const auto rubber = pillar_rubber(raw, folder, key)) {
      Material material = linear_part(*rubber, raw);
      refuse_liquid(material, raw.file);
      return material;
    }
    const bool is_joint = looks_like_ratio_file(path);
    if (is_joint != (raw.ratio > 0.0)) {
      throw SceneMistake(key, is_joint
                                  ? "the file is a joint fit over mixing ratios; name one, such as "
                                    "ratio = 10 (parts of base to one of curing agent)"
                                  : "the file holds one material, so ratio has no meaning");
    }
    Material material = is_joint ? material_at_ratio(read_ratio_fit(path, raw.judged), raw.ratio)
                                 : read_material(path, raw.judged).material;
    refuse_liquid(material, raw.file);
    return material;
  }
  if (!(raw.E_Pa > 0.0)) {
    throw SceneMistake(key, "needs E (and nu, rho) or a file");
  }
  Material material;
  material.E0_Pa = raw.E_Pa;
  material.nu = raw.nu;
  material.rho_kg_m3 = raw.rho_kg_m3;
  return material;
}

}  // namespace viscard
