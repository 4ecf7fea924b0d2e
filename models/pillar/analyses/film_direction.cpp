#include "models/answer/scene_mistake.h"
#include "models/maths/text_of_number.h"
#include "models/pillar/analyses/analysis.h"
#include "models/pillar/analyses/simulate_pillar.h"
#include "models/pillar/analyses/top_load.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace viscard {
namespace {

// Contribution of the film's direction to one result, and the error of that contribution.
struct DirectionChange {
  std::string name;
  std::string unit;
  double mean_value = 0.0;  // of the averaged film
  double change = 0.0;
  double error = 0.0;
  double relative() const { return mean_value == 0.0 ? 0.0 : change / mean_value; }
};

bool is_electric_unit(const std::string& unit) {
  return unit == "V" || unit == "C" || unit == "F" || unit == "m/V";
}

std::vector<SceneResult> results_of_harmonics(const PillarScene& scene, const Discretisation& mesh,
                                              int highest) {
  PillarMedia media = media_of(scene);
  media.film = scene.directional_film;
  ModelOptions options = options_of(scene, Motion::kLongitudinal);
  options.electrodes = scene.electrodes;
  SceneAnswer answer;
  add_film_results(scene, directional_static(scene.geometry, mesh, media, options, highest),
                   answer);
  return answer.results;
}

// The change of each result by harmonic 2, on one mesh.
struct MeshChange {
  std::vector<SceneResult> mean, with_2;
  double of(std::size_t i) const { return with_2[i].value - mean[i].value; }
};

MeshChange change_on(const PillarScene& scene, const Discretisation& mesh) {
  return {results_of_harmonics(scene, mesh, 0), results_of_harmonics(scene, mesh, 2)};
}

// From this tolerance on two coarse meshes are enough: they leave at most 5e-5 of a voltage.
constexpr double kLoose = 5e-4;

// The change is small, so coarse meshes give it to a few per cent. Its error is the difference of
// the last two meshes, but at least a tenth of the difference before (error_control.h), plus the
// contribution of harmonic 4. Higher harmonics contribute less, each by the same small factor
// again.
std::vector<DirectionChange> axial_changes(const PillarScene& scene) {
  const std::vector<Discretisation> meshes = mesh_sequence(scene.geometry);
  const std::vector<std::size_t> used =
      scene.tolerance < kLoose ? std::vector<std::size_t>{0, 1, 3} : std::vector<std::size_t>{0, 2};
  std::vector<MeshChange> on;
  for (const std::size_t mesh : used) on.push_back(change_on(scene, meshes[mesh]));
  const MeshChange &last = on.back(), &before = on[on.size() - 2];
  const std::vector<SceneResult> with_4 =
      results_of_harmonics(scene, meshes[used[on.size() - 2]], 4);
  std::vector<DirectionChange> changes;
  for (std::size_t i = 0; i < last.mean.size(); ++i) {
    double error = std::abs(last.of(i) - before.of(i));
    if (on.size() > 2) {
      error = std::max(error, ErrorControl::kShareLeft * std::abs(before.of(i) - on.front().of(i)));
    }
    const double by_4 = with_4[i].value - before.with_2[i].value;
    changes.push_back({.name = last.mean[i].name,
                       .unit = last.mean[i].unit,
                       .mean_value = last.mean[i].value,
                       .change = last.of(i) + by_4,
                       .error = error + std::abs(by_4)});
  }
  return changes;
}

// Charge on one quadrant toward +x that the direction of a film adds, all quadrants shorted, to
// first order in e31 - e32. Between shorted faces the charge is the mean over the thickness of
// e S, and e31 S_xx + e32 S_yy differs from its mean film by (e31 - e32)/2 (S_xx - S_yy), with
//   S_xx - S_yy = (S_rr - S_tt) cos 2t - S_rt sin 2t,  S_rr, S_tt ~ cos t, S_rt ~ sin t,
// whose integrals over a quadrant are 1/3 (S_rr - S_tt) - 2/3 S_rt.
double charge_of_direction_C(const PillarModel& model, const Eigen::VectorXd& u, double e_C_m2,
                             double radius_m) {
  const Section& section = model.mesh().section;
  const std::vector<OperatorRow>& strain = model.system().kinematics().strain;
  const std::vector<OperatorRow> rows = {strain[0], strain[1], strain[5]};
  double sum = 0.0;
  for (const SectionElement& element : section.elements()) {
    if (element.region != kFilmRegion) continue;
    const LineMesh::ElementRule in_x = section.x().rule(element.column);
    const LineMesh::ElementRule in_z = section.z().rule(element.row);
    if (in_x.x[0] > radius_m) continue;
    for (Eigen::Index k = 0; k < in_x.x.size(); ++k) {
      for (Eigen::Index l = 0; l < in_z.x.size(); ++l) {
        const Eigen::VectorXd S = model.system().rows_at(rows, u, element, in_x.x[k], in_z.x[l]);
        sum += in_x.weight[k] * in_z.weight[l] * in_x.x[k] * ((S[0] - S[1]) - 2.0 * S[2]) / 3.0;
      }
    }
  }
  return 0.5 * e_C_m2 * sum / model.geometry().film->thickness_m;
}

// Sideways the direction has an effect of first order: quadrants read e31 along x and e32 along y.
// The motion per volt changes by the same share (reciprocity). A charge-free face is assumed to
// change as an electrode under the whole pillar does.
std::vector<DirectionChange> sideways_changes(const PillarScene& scene) {
  ModelOptions options = options_of(scene, Motion::kLateral);
  options.rigid_top = false;
  options.electrodes = scene.electrodes;
  double& radius_m = options.electrodes->electrode_radius_m;
  if (radius_m == 0.0) radius_m = 0.5 * scene.geometry.diameter_m;
  options.electrodes->quadrants = true;
  const PillarModel model(scene.geometry, mesh_sequence(scene.geometry)[2], media_of(scene),
                          options);
  const QuadrantAnswer unit = piezo_quadrants(model, 1.0);
  const PiezoMatrix& e = scene.directional_film->piezo_C_m2;
  const double change_C =
      charge_of_direction_C(model, unit.shorted.unknowns, e(2, 0) - e(2, 1), radius_m);
  return {
      {.name = "quadrant_charge", .unit = "C", .mean_value = unit.charge_C, .change = change_C}};
}

// Two digits are enough; "-0.037 %".
std::string percent_of(double share) {
  return text_of(100.0 * share, 2) + " %";
}

std::string above_tolerance(double error, const PillarScene& scene) {
  return error > scene.tolerance ? "; the errors are more than the tolerance" : "";
}

void correct_results(const PillarScene& scene, const std::vector<DirectionChange>& changes,
                     SceneAnswer& answer) {
  const DirectionChange* largest = nullptr;
  for (SceneResult& result : answer.results) {
    for (const DirectionChange& one : changes) {
      if (one.name != result.name) continue;
      result.value += one.change;
      result.error_estimate += one.error;
      const double size = std::max(std::abs(result.value), result.scale);
      if (result.is_wanted && size > 0.0) {
        answer.largest_relative_error =
            std::max(answer.largest_relative_error, result.error_estimate / size);
      }
      if (!result.is_wanted || !is_electric_unit(one.unit)) continue;
      if (largest == nullptr || std::abs(one.relative()) > std::abs(largest->relative())) {
        largest = &one;
      }
    }
  }
  if (largest == nullptr) return;
  answer.notes.push_back(
      "the film differs along x and y in its plane: the harmonics 2 and 4 that "
      "it excites change " +
      largest->name + " by " + percent_of(largest->relative()) +
      " against its mean over all directions (film.directional)" +
      above_tolerance(answer.largest_relative_error, scene));
}

// Adds relative errors to voltages and charges, and to all other results.
void enlarge_errors(double electric, double other, SceneAnswer& answer) {
  const auto share = [&](const std::string& unit) {
    return is_electric_unit(unit) ? electric : other;
  };
  for (SceneResult& result : answer.results) {
    const double size = std::max(std::abs(result.value), result.scale);
    result.error_estimate += share(result.unit) * size;
    if (result.is_wanted && size > 0.0) {
      answer.largest_relative_error =
          std::max(answer.largest_relative_error, result.error_estimate / size);
    }
  }
  for (SceneCurve& curve : answer.curves) {
    const double peak = largest_size(curve.value);
    for (double& error : curve.error) error += share(curve.unit) * peak;
  }
}

void report_as_error(const PillarScene& scene, const std::vector<DirectionChange>& changes,
                     SceneAnswer& answer) {
  double electric = 0.0, other = 0.0;
  for (const DirectionChange& one : changes) {
    double& largest = is_electric_unit(one.unit) ? electric : other;
    largest = std::max(largest, std::abs(one.relative()));
  }
  enlarge_errors(electric, other, answer);
  const bool is_declared =
      std::any_of(scene.effects.begin(), scene.effects.end(),
                  [](const auto& one) { return one.second == EffectChoice::kOff; });
  if (electric > scene.tolerance && !is_declared) {
    throw SceneMistake("geometry.film.directional",
                       "the film differs along x and y, and this analysis takes its mean over all "
                       "directions: voltages may be wrong by " +
                           percent_of(electric) +
                           ", more than the tolerance. Ask for a tolerance of " +
                           text_of(1.5 * electric, 2) +
                           ", or write directional = false for a film that is the same in all "
                           "directions");
  }
  answer.notes.push_back(
      "the film differs along x and y in its plane, and this analysis takes its mean over all "
      "directions: voltages and charges may be wrong by " +
      percent_of(electric) + ", which the error estimates contain" +
      above_tolerance(answer.largest_relative_error, scene));
}

bool has_electric_results(const SceneAnswer& answer) {
  return std::any_of(answer.results.begin(), answer.results.end(), [](const SceneResult& result) {
    return result.is_wanted && is_electric_unit(result.unit);
  });
}

}  // namespace

void add_film_direction(const PillarScene& scene, SceneAnswer& answer) {
  if (!scene.directional_film || !scene.film || !scene.electrodes || scene.plane) return;
  if (!has_electric_results(answer)) return;
  if (is_lateral(scene)) return report_as_error(scene, sideways_changes(scene), answer);
  const bool is_static = std::holds_alternative<StaticDrive>(scene.drive);
  if (is_static && !scene.one_way_potential) {
    return correct_results(scene, axial_changes(scene), answer);
  }
  // For moving loads and one-way fields: the relative change of the same results at rest.
  PillarScene at_rest = scene;
  if (!is_static) at_rest.drive = StaticDrive{.pressure_Pa = 1.0};
  at_rest.one_way_potential = false;
  report_as_error(scene, axial_changes(at_rest), answer);
}

}  // namespace viscard
