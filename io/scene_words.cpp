#include "io/scene_words.h"

#include "io/material_file.h"

namespace viscard {

void show_material(FieldVisitor& v, RawMaterial& m) {
  v.text({"file", "pdms_1to10_seed.json"}, m.file);
  v.quantity({.key = "E", .unit = "Pa", .range = Range::kPositive}, m.E_Pa);
  v.quantity({.key = "nu"}, m.nu);
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

Material pillar_material(const RawMaterial& raw, const std::filesystem::path& folder) {
  if (!raw.file.empty()) return read_material(folder / raw.file).material;
  if (!(raw.E_Pa > 0.0)) {
    throw SceneMistake("materials.pillar", "needs E (and nu, rho) or a file");
  }
  Material material;
  material.E0_Pa = raw.E_Pa;
  material.nu = raw.nu;
  material.rho_kg_m3 = raw.rho_kg_m3;
  return material;
}

}  // namespace viscard
