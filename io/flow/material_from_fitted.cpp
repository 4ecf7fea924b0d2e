#include "io/basics/atomic_file.h"
#include "io/basics/program.h"
#include "io/basics/written_path.h"
#include "io/flow/fit_file.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace viscard {
namespace {

ValidityWindow window_of(const FitResult& fit) {
  ValidityWindow window;
  if (fit.kind == FitKind::kIndentation) {
    window.t_min_s = fit.fastest_s;
    window.t_max_s = fit.fit_to_s - fit.fit_from_s;
    return window;
  }
  window.t_min_s = std::max(0.0, fit.fit_from_s);
  window.t_max_s = fit.fit_to_s - std::min(0.0, fit.fit_from_s);
  return window;
}

// The series of a law is valid in the window in which it was compared with the law.
void narrow_to_law(const FittedFile& fitted, ValidityWindow& window) {
  for (const FittedLaw& law : fitted.result.laws) {
    if (law.name != fitted.model) continue;
    window.t_min_s = std::max(window.t_min_s, law.t_min_s);
    window.t_max_s = std::min(window.t_max_s, law.t_max_s);
  }
}

// A temperature measured by a thermometer takes precedence over a noted one.
void set_temperature(const FittedFile& fitted, Material& material) {
  if (fitted.temperature) {
    material.T_ref_C = fitted.temperature->mean_C;
  } else if (!fitted.specimen.id.empty()) {
    material.T_ref_C = fitted.specimen.temperature_C;
  }
}

}  // namespace

Material material_from_fitted(const FittedFile& fitted, const MaterialRequest& request) {
  const Specimen& specimen = fitted.specimen;
  const bool has_contact = specimen.contact.punch_radius_m > 0.0;
  const double usual = has_contact ? specimen.contact.poisson_ratio : kUsualNu;
  const double nu = request.nu.value_or(fitted.modulus ? fitted.modulus->nu : usual);
  const bool is_converted = fitted.modulus && fitted.modulus->kind != ModulusKind::kTension;
  if (is_converted && nu != fitted.modulus->nu) {
    throw std::invalid_argument(
        "the moduli were converted to Young's modulus with a Poisson ratio of " +
        text_of(fitted.modulus->nu) +
        "; state another one where they are fitted (--poisson-ratio)");
  }
  Material material =
      material_from_fit(fitted.result, nu, request.rho_kg_m3.value_or(specimen.rho_kg_m3));
  const std::string& first = fitted.tests.empty() ? fitted.path : fitted.tests.front().path;
  material.name = specimen.id.empty() ? std::filesystem::path(first).stem().string() : specimen.id;
  set_temperature(fitted, material);
  material.mixing_ratio = specimen.mixing_ratio;
  material.specimen_id = fitted.specimen_id;
  if (fitted.master) {
    material.T_ref_C = fitted.master->T_ref_C;
    if (const TemperatureShift* shift = fitted.master->laws.better()) material.shift = *shift;
  }
  material.valid = window_of(fitted.result);
  narrow_to_law(fitted, material.valid);
  if (request.nu || (fitted.modulus && fitted.modulus->is_nu_stated)) {
    material.provenance.nu_origin = "stated";
  } else if (fitted.modulus && fitted.modulus->nu_95) {
    material.provenance.nu_origin = "measured";
  }
  material.provenance.created_by = program_with_version();
  material.provenance.created_at = request.created_at;
  material.provenance.command = request.command;
  std::vector<std::string> files;
  for (const TestFile& test : fitted.tests) {
    if (!test.is_in_memory) files.push_back(test.path);
  }
  if (fitted.tests.empty() && !fitted.is_in_memory) files.push_back(fitted.path);
  for (const std::string& file : files) {
    material.provenance.raw_files.push_back({file, sha256_as_read(file)});
  }
  write_paths_of(material.provenance.raw_files);
  return material;
}

}  // namespace viscard
