#include "models/array/plane/array_analysis.h"

#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace viscard {

const std::vector<ArrayAnalysis>& array_analyses() {
  static const std::vector<ArrayAnalysis> kAnalyses = {
      array_static_analysis(), array_modal_analysis(), array_harmonic_analysis(),
      array_transient_analysis()};
  return kAnalyses;
}

const ArrayAnalysis& analysis_of(const ArrayScene& scene) {
  for (const ArrayAnalysis& analysis : array_analyses()) {
    if (analysis.drive.index() == scene.drive.index()) return analysis;
  }
  throw std::logic_error("this drive has no row in the table of analyses");
}

ArrayModel model_of(const ArrayScene& scene, const Discretisation& mesh, const PillarPorts& extra) {
  return {scene.feels_neighbours ? scene.geometry : lone(scene.geometry), scene.electrodes,
          media_of(scene), mesh, extra};
}

bool asks_for_voltages(const ArrayScene& scene) {
  if (!is_electric(scene) || !analysis_of(scene).is_loaded) return false;
  const auto is_voltage = [&](const std::string& name) {
    if (!scene.press) return !name.starts_with("top_displacement");
    return name.find("_voltage") != std::string::npos || name.starts_with("electrode");
  };
  return scene.wanted.empty() || std::any_of(scene.wanted.begin(), scene.wanted.end(), is_voltage);
}

int modes_for(const ArrayScene& scene, const Discretisation& mesh, double highest_Hz) {
  constexpr int kLeast = 3;  // linear elements have few modes that are accurate
  const int count = std::max(kLeast, 8 + 5 * (mesh.degree - 3));
  if (highest_Hz == 0.0) return count;
  const double shear_m_s =
      std::sqrt(scene.pillar.E0_Pa / (2.0 * (1.0 + scene.pillar.nu)) / scene.pillar.rho_kg_m3);
  const double waves = 2.0 * scene.geometry.length_m * highest_Hz / shear_m_s;
  return count + static_cast<int>(std::ceil(4.0 * waves));
}

double film_error(const ArrayScene& scene, const ArrayTransfer& transfer, double frequency_Hz) {
  const double speed_m_s = std::sqrt(scene.film.stiffness_Pa(4, 4) / scene.film.rho_kg_m3);
  const double ratio = frequency_Hz * 4.0 * scene.geometry.film_thickness_m / speed_m_s;
  const bool is_voltage = transfer.voltages() > 0 && asks_for_voltages(scene);
  const double error = ratio * ratio * (is_voltage ? 1.0 : transfer.film_share());
  refuse_moving_film(scene, error, "the answer at " + text_of(frequency_Hz, 4) + " Hz",
                     "lower frequencies or longer pulses");
  return error;
}

void let_film_lose(const ArrayScene& scene, ArrayTransfer& transfer) {
  if (scene.film_loss.is_lossless() || !is_electric(scene)) return;
  transfer.lose(bonded_port(scene.film, scene.film_loss));
}

double film_loss_error(const ArrayScene& scene, const ArrayTransfer& transfer) {
  if (transfer.voltages() == 0 || !asks_for_voltages(scene)) return 0.0;
  return bonded_error(scene.film, scene.film_loss, slowest_rad_s(scene));
}

void refuse_moving_film(const ArrayScene& scene, double error, const std::string& what,
                        const std::string& instead) {
  if (error <= scene.tolerance) return;
  throw std::runtime_error("the film's own inertia, which rows leave out, may change " + what +
                           " by a share of " + text_of(error, 2) + ", more than the tolerance of " +
                           text_of(scene.tolerance, 2) + "; ask for a larger tolerance or " +
                           instead + ", or for one pillar on its film (kind = \"pillar\")");
}

std::vector<int> loaded_of(const ArrayScene& scene) {
  std::vector<int> loaded;
  for (const int pillar : scene.loaded) loaded.push_back(pillar - 1);
  for (int i = 0; scene.loaded.empty() && i < scene.geometry.count; ++i) loaded.push_back(i);
  return loaded;
}

std::string name_of(const ArrayScene& scene, Eigen::Index output) {
  const int n = scene.geometry.count;
  const bool is_top = output < n;
  const char* stem = is_top                              ? "top_displacement_"
                     : scene.electrodes.is_equipotential ? "electrode_voltage_"
                                                         : "centre_voltage_";
  return stem + std::to_string((is_top ? output : output - n) + 1);
}

std::vector<std::string> names_in_time(const ArrayScene& scene) {
  std::vector<std::string> names = {"top_displacement"};
  if (!is_electric(scene)) return names;
  names.emplace_back(scene.electrodes.is_equipotential ? "electrode_voltage" : "centre_voltage");
  return names;
}

}  // namespace viscard
