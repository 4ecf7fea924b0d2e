#include "io/scenes/scene_fields.h"

#include "io/basics/named_file.h"
#include "io/materials/material_file.h"
#include "io/materials/material_json.h"
#include "models/material/liquid.h"
#include "models/material/series_band.h"
#include "models/pillar/system/rotated_medium.h"
#include "models/scene/effects.h"

#include <algorithm>
#include <cmath>

namespace viscard {

QuantityField length_key(const char* key, bool is_required) {
  return {.key = key, .unit = "m", .range = Range::kPositive, .is_required = is_required};
}

namespace {

void show_effects(FieldVisitor& v, EffectChoices& choices) {
  static const WordTable<EffectChoice> kWords = {
      {"auto", EffectChoice::kAuto}, {"on", EffectChoice::kOn}, {"off", EffectChoice::kOff}};
  for (const Effect& effect : effects()) {
    const auto known = choices.find(effect.name);
    std::optional<EffectChoice> chosen;
    if (known != choices.end()) chosen = known->second;
    v.choice({effect.name, "auto"}, kWords, chosen);
    if (chosen) choices[effect.name] = *chosen;
  }
}

void show_material(FieldVisitor& v, NamedMaterial& m, bool is_film) {
  m.judged = v.judged();
  v.text({"file", "pdms_1to10_seed.json"}, m.file);
  v.quantity({.key = "ratio", .range = Range::kPositive, .is_exact = true}, m.ratio);
  v.quantity({.key = "E", .unit = quantities::kModulus, .range = Range::kPositive}, m.E_Pa);
  v.quantity({.key = "nu", .unit = quantities::kPoissonRatio}, m.nu);
  v.quantity({.key = "rho", .unit = "kg/m3", .range = Range::kPositive}, m.rho_kg_m3);
  if (!is_film) return;
  v.quantity({.key = "resistivity", .unit = "ohm m", .range = Range::kPositive},
             m.resistivity_Ohm_m);
  v.quantity_pairs("dielectric", "s", "1", m.dielectric_s);
}

const NamedMaterial& named(const SceneFile& file, const std::string& name) {
  static const NamedMaterial kNone;
  const auto found = file.sources.materials.find(name);
  return found == file.sources.materials.end() ? kNone : found->second;
}

// Keys that mean nothing without others are refused.
void check_surroundings(const Surroundings& around, bool has_film) {
  const Surroundings usual;
  const bool expands = around.pillar_expansion_1_K != 0.0 || around.film_expansion_1_K != 0.0 ||
                       around.pyroelectric_C_m2K != 0.0;
  const bool is_made = !std::isnan(around.made_at_C);
  if ((expands || is_made) && (std::isnan(around.temperature_C) || !is_made)) {
    throw SceneMistake("surroundings",
                       "expansion and pyroelectric charge need temperature and made_at, such as "
                       "temperature = \"33 degC\" and made_at = \"23 degC\"");
  }
  if (is_made && !expands) {
    throw SceneMistake("surroundings.made_at",
                       "needs pillar_expansion, film_expansion or pyroelectric, such as "
                       "pillar_expansion = \"3e-4 1/K\"");
  }
  if (!has_film && (around.film_expansion_1_K != 0.0 || around.pyroelectric_C_m2K != 0.0)) {
    throw SceneMistake("surroundings", "film_expansion and pyroelectric need a film");
  }
  if (!around.air && (around.air_density_kg_m3 != usual.air_density_kg_m3 ||
                      around.air_viscosity_Pa_s != usual.air_viscosity_Pa_s)) {
    throw SceneMistake("surroundings.air", "air_density and air_viscosity need air = true");
  }
}

// Only a single pillar has all of it.
void show_surroundings(FieldVisitor& v, SceneFile& file) {
  Surroundings& around = common(file.scene).surroundings;
  const auto* pillar = std::get_if<PillarScene>(&file.scene);
  const bool is_pillar = pillar != nullptr;
  v.after_all_keys([&around, pillar] {
    if (pillar != nullptr) check_surroundings(around, pillar->film.has_value());
  });
  v.section("surroundings", [&](FieldVisitor& s) {
    s.quantity({.key = "temperature", .unit = "degC"}, around.temperature_C);
    if (!is_pillar) return;
    s.quantity({.key = "made_at", .unit = "degC"}, around.made_at_C);
    s.quantity({.key = "pillar_expansion", .unit = "1/K"}, around.pillar_expansion_1_K);
    s.quantity({.key = "film_expansion", .unit = "1/K"}, around.film_expansion_1_K);
    s.quantity({.key = "pyroelectric", .unit = "C/m2/K"}, around.pyroelectric_C_m2K);
    s.quantity({.key = "gravity", .unit = "m/s2"}, around.gravity_m_s2);
    s.boolean("air", around.air);
    s.quantity({.key = "air_density", .unit = "kg/m3", .range = Range::kPositive},
               around.air_density_kg_m3);
    s.quantity({.key = "air_viscosity", .unit = "Pa s", .range = Range::kPositive},
               around.air_viscosity_Pa_s);
  });
}

}  // namespace

void show_common(FieldVisitor& v, const char* wanted_example, SceneFile& file) {
  SceneCommon& scene = common(file.scene);
  v.quantity({.key = "tolerance", .range = Range::kPositive, .is_exact = true}, scene.tolerance);
  v.text({"compare", "layer_cylinder.toml"}, file.compare);
  show_surroundings(v, file);
  v.section("effects", [&](FieldVisitor& e) { show_effects(e, scene.effects); });
  v.section("want", [&](FieldVisitor& w) {
    w.texts({"quantities", wanted_example}, scene.wanted);
  });
  std::vector<PrintedValue>& printed = file.printed;
  v.list(
      "printed", printed.size(), [&](std::size_t n) { printed.resize(n); },
      [&](FieldVisitor& p, std::size_t i) {
        p.text({"name", "lateral 1", true}, printed[i].name);
        p.text({"value", "16103 Hz", true}, printed[i].value);
        p.text({"note", "the mesh of the source is coarse"}, printed[i].note);
      });
}

void show_materials(FieldVisitor& v, const char* body, SceneFile& file,
                    const std::function<void(FieldVisitor&)>& others) {
  SceneSources& sources = file.sources;
  std::vector<std::string> names = sources.of_classes;
  names.insert(names.begin(), {body, sources.film});
  v.section("materials", [&](FieldVisitor& m) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (names[i].empty() ||
          std::find(names.begin(), names.begin() + i, names[i]) != names.begin() + i)
        continue;
      m.section(names[i].c_str(), [&](FieldVisitor& one) {
        show_material(one, sources.materials[names[i]], names[i] == sources.film);
      });
    }
    if (others) others(m);
  });
  v.after_all_keys([&file, body] {
    SceneCommon& scene = common(file.scene);
    scene.pillar = pillar_material(file, body);
    scene.surroundings.shift_factor = bring_to_temperature(file, scene.pillar);
    if (!file.sources.film.empty()) set_film_loss(file);
  });
}

void show_film_material(FieldVisitor& v, SceneFile& file) {
  v.text({"material", "pvdf", true}, file.sources.film);
}

void show_poling(FieldVisitor& v, SceneFile& file) {
  v.choice({"poling", "+z"}, {{"+z", false}, {"-z", true}}, file.sources.film_is_reversed);
}

Medium film_of(const SceneFile& file) {
  const Medium film = film_medium(file, file.sources.film).medium;
  return file.sources.film_is_reversed ? with_reversed_poling(film) : film;
}

const WordTable<FilmFace>& grounded_by_electrode_face() {
  static const WordTable<FilmFace> kWords = {{"bottom", FilmFace::kTop},
                                             {"top", FilmFace::kBottom}};
  return kWords;
}

void show_electrode(FieldVisitor& v, FilmFace& grounded, SpaceElectrode& electrode,
                    double& radius_m, double* gap_m) {
  bool quadrants = has_quarters(electrode);
  if (quadrants) {
    electrode = is_metal(electrode) ? SpaceElectrode::kEquipotential : SpaceElectrode::kSampled;
  }
  v.choice({"face", "bottom"}, grounded_by_electrode_face(), grounded);
  v.choice(
      {"kind", "sampled"},
      {{"sampled", SpaceElectrode::kSampled}, {"equipotential", SpaceElectrode::kEquipotential}},
      electrode);
  v.quantity(length_key("radius"), radius_m);
  v.boolean("quadrants", quadrants);
  if (gap_m != nullptr) v.quantity(length_key("gap"), *gap_m);
  if (!quadrants) return;
  v.after_all_keys([is_refused = is_metal(electrode) && gap_m == nullptr] {
    if (!is_refused) return;
    throw SceneMistake("geometry.electrode.kind",
                       "quadrants under a layer are read on a charge-free face; write kind = "
                       "\"sampled\", or leave quadrants out");
  });
  electrode = is_metal(electrode) ? SpaceElectrode::kMetalQuadrants : SpaceElectrode::kQuadrants;
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

std::filesystem::path named_file(const std::string& key, const SceneFile& file,
                                 const std::string& name, FileKind wanted) {
  const std::filesystem::path& folder = file.sources.folder;
  const std::string fault = fault_of_named_file(folder, name, wanted);
  if (!fault.empty()) throw SceneMistake(key, fault);
  return folder / name;
}

MediumFile film_medium(const SceneFile& file, const std::string& name) {
  const NamedMaterial& raw = named(file, name);
  const std::string key = "materials." + name;
  if (!raw.file.empty()) {
    return read_medium(named_file(key + ".file", file, raw.file, FileKind::kMedium), raw.judged);
  }
  if (!(raw.E_Pa > 0.0)) throw SceneMistake(key, "needs E (and nu, rho) or a file");
  try {
    return {.medium = isotropic_medium(raw.E_Pa, raw.nu, raw.rho_kg_m3)};
  } catch (const std::invalid_argument& error) {
    throw SceneMistake(key, error.what());
  }
}

void set_film_loss(SceneFile& file) {
  const std::string& name = file.sources.film;
  const NamedMaterial& raw = named(file, name);
  FilmLoss& loss = common(file.scene).film_loss;
  loss = {};
  const bool is_stated = raw.resistivity_Ohm_m > 0.0 || !raw.dielectric_s.empty();
  const std::string key = "materials." + name;
  if (raw.file.empty()) {
    if (!is_stated) return;
    throw SceneMistake(key,
                       "resistivity and dielectric are those of a film from a file that states its "
                       "permittivity");
  }
  const MediumFile film = film_medium(file, name);
  loss = film.loss;
  const double at_once_F_m = film.medium.permittivity_F_m(2, 2);
  if (is_stated && !(at_once_F_m > 0.0)) {
    throw SceneMistake(key, "'" + raw.file +
                                "' states no relative_permittivity, beside which "
                                "resistivity and dielectric mean nothing");
  }
  if (raw.resistivity_Ohm_m > 0.0) loss.leakage_s = raw.resistivity_Ohm_m * at_once_F_m;
  if (!raw.dielectric_s.empty() && !loss.terms.empty()) {
    throw SceneMistake(key + ".dielectric",
                       "'" + raw.file +
                           "' states late polarisation itself, and its permittivity belongs to "
                           "that; leave dielectric out, or give a file without it");
  }
  for (const auto& [tau_s, added] : raw.dielectric_s) {
    loss.terms.push_back({added * kVacuumPermittivity_F_m / at_once_F_m, tau_s});
  }
  at_key((key + ".dielectric").c_str(), [&] { validate(loss); });
}

std::optional<HyperelasticFile> pillar_rubber(const SceneFile& file, const std::string& name) {
  const NamedMaterial& raw = named(file, name);
  const std::string key = "materials." + name;
  if (raw.file.empty()) return std::nullopt;
  const auto path = named_file(key + ".file", file, raw.file, FileKind::kMaterial);
  if (!looks_like_hyperelastic_file(path)) return std::nullopt;
  HyperelasticFile rubber = read_hyperelastic(path, raw.judged);
  if (!rubber.is_trustworthy) {
    const std::string why = rubber.defects.empty() ? "" : " (" + rubber.defects.front() + ")";
    throw SceneMistake(key + ".file", "the law of rubber in '" + raw.file +
                                          "' is not to be trusted" + why +
                                          "; fit another law, or more tests");
  }
  if (rubber.foam) {
    throw SceneMistake(key + ".file", "'" + raw.file +
                                          "' holds a foam, which scenes do not compute; give E and "
                                          "nu, or a law of rubber");
  }
  if (rubber.damage) {
    throw SceneMistake(key + ".file",
                       "the law of rubber in '" + raw.file + "' softens by its first loading (" +
                           kMullinsName +
                           "), which scenes do not compute; fit the loading of one cycle without "
                           "it: viscard fit --model " +
                           name_of(rubber.law.form) + " --cycle N");
  }
  if (raw.E_Pa > 0.0 || raw.ratio > 0.0) {
    throw SceneMistake(key, "the modulus comes from the law of rubber; leave out E and ratio");
  }
  if (!(raw.nu > 0.0)) {
    throw SceneMistake(key,
                       "a law of rubber needs nu beside its file, such as nu = 0.499 (0.5: "
                       "incompressible), and rho where vibration counts");
  }
  return rubber;
}

namespace {

// Rubber at small strain. The terms take a share of all stress: nu stays in time, as in a fit of E(t).
Material linear_part(const HyperelasticFile& rubber, const NamedMaterial& raw) {
  Material material;
  material.E0_Pa = rubber.E0_Pa;
  material.nu = raw.nu;
  material.rho_kg_m3 = raw.rho_kg_m3;
  for (const RubberTerm& term : rubber.terms) {
    material.terms.push_back({.g = term.g, .k = term.g, .tau_s = term.tau_s});
  }
  if (rubber.is_edited) material.flags.push_back({kEdited, 0, kEditedText});
  return material;
}

}  // namespace

double bring_to_temperature(const SceneFile& file, Material& material) {
  const double temperature_C = common(file.scene).surroundings.temperature_C;
  if (std::isnan(temperature_C) || !material.shift || material.terms.empty()) return 1.0;
  double shift_factor = 1.0;
  at_key("surroundings.temperature", [&] {
    shift_factor = std::exp(ln_shift_factor(*material.shift, temperature_C));
    material = material_at_temperature(material, temperature_C);
  });
  return shift_factor;
}

Material pillar_material(const SceneFile& file, const std::string& name) {
  const NamedMaterial& raw = named(file, name);
  const std::string key = "materials." + name;
  if (!raw.file.empty()) {
    const auto path = named_file(key + ".file", file, raw.file, FileKind::kMaterial);
    if (const auto rubber = pillar_rubber(file, name)) {
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
