#include "models/array/space/simulate_space.h"

#include "models/answer/error_control.h"
#include "models/answer/scene_mistake.h"
#include "models/array/space/contact_maps.h"
#include "models/array/space/space_maps.h"
#include "models/array/space/touch_curves.h"
#include "models/maths/text_of_number.h"
#include "models/pillar/analyses/analysis.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

namespace viscard {
namespace {

// At least this share of the tolerance is reserved for the errors that finer accuracies reduce.
constexpr double kShareOfAccuracy = 0.2;

SpaceAccuracy accuracy_for(const SpaceScene& scene, const SpaceArray& array,
                           const Discretisation& mesh, const ElectrodeCoupling& coupling) {
  const std::vector<SpaceAccuracy> all = space_accuracies(array);
  const auto found = std::find_if(all.begin(), all.end(), [&](const SpaceAccuracy& one) {
    return one.foot.degree >= mesh.degree;
  });
  SpaceAccuracy accuracy = found == all.end() ? all.back() : *found;
  accuracy.coupling.settled = coupling.settled;
  if (!coupling.is_on) accuracy.coupling.harmonics = 0;
  // Electrodes do not overlap: within its own one, a pillar reads itself alone.
  if (!scene.feels_neighbours) accuracy.potential.reach_m = 2.0 * array.electrode_radius_m;
  return accuracy;
}

}  // namespace

std::vector<std::string> result_names(const SpaceScene& scene) {
  std::vector<std::string> names = sensed_maps(scene);
  for (const std::string& of_quarters : sensed_results(scene)) names.push_back(of_quarters);
  if (scene.quadrants.measured_V.size() > 0) return names;
  std::ranges::move(voltage_names(scene.electrode), std::back_inserter(names));
  if (has_crosstalk(scene)) names.emplace_back(kCrosstalk);
  if (square_pitch_m(scene) > 0.0 && !scene.backing) {
    names.insert(names.end(), {"voltage_per_pressure", "voltage_per_height"});
  }
  for (const std::string& of_sensing : sensing_results(scene)) names.push_back(of_sensing);
  if (!scene.press) return names;
  for (const auto& of_contact : {contact_maps(scene), contact_results()}) {
    names.insert(names.end(), of_contact.begin(), of_contact.end());
  }
  for (const std::string& of_touch : touch_results(scene)) names.push_back(of_touch);
  return names;
}

std::vector<Discretisation> space_meshes(const SpaceScene& scene) {
  std::vector<Discretisation> meshes;
  for (const SpaceAccuracy& one : space_accuracies(array_of(scene))) meshes.push_back(one.foot);
  return meshes;
}

namespace {

// What pillars beyond the reach would add, relative to the reference value of the tolerance.
// Comparing two accuracies does not show it for a pillar that neither of them reaches.
double beyond_reach(const SpaceScene& scene, const SpaceResponse& response,
                    const TopLoads& loads_Pa, const Eigen::MatrixXd& readings_V,
                    const SceneAnswer& answer) {
  const Eigen::VectorXd beyond_V = response.beyond_reach_V(loads_Pa);
  const std::vector<std::string> names = voltage_names(scene.electrode);
  double share = 0.0;
  for (const SceneMap& map : answer.maps) {
    if (map.name == kCrosstalk && size_of(map) > 0.0) {
      // Per cent of the reading of a disc (space_maps.cpp).
      const Eigen::Index disc = whole_reading(scene.electrode);
      const double own_V = readings_V.col(disc).cwiseAbs().maxCoeff();
      if (own_V > 0.0) share = std::max(share, 100.0 * beyond_V[disc] / own_V / size_of(map));
    }
    for (std::size_t r = 0; r < names.size(); ++r) {
      if (map.name != names[r] || !(size_of(map) > 0.0)) continue;
      share = std::max(share, beyond_V[static_cast<Eigen::Index>(r)] / size_of(map));
    }
  }
  return share;
}

SceneAnswer voltages_on(const SpaceScene& scene, const TopLoads& loads_Pa,
                        const Discretisation& mesh, const ElectrodeCoupling& coupling,
                        const TouchCourse* course = nullptr) {
  const SpaceArray array = array_of(scene);
  const SpaceAccuracy accuracy = accuracy_for(scene, array, mesh, coupling);
  const SpaceResponse response(array, accuracy);
  SceneAnswer answer;
  answer.discretisation = accuracy.foot;
  answer.unknowns = response.unknowns();
  answer.array = array_of_answer(scene, loads_Pa);
  const bool is_measured = scene.quadrants.measured_V.size() > 0;
  Eigen::MatrixXd readings_V;
  if (!is_measured) {
    readings_V = response.voltages_V(loads_Pa);
    answer.maps = maps_of(scene, response, loads_Pa, readings_V);
  }
  if (senses_forces(scene)) add_sensed(scene, response, loads_Pa, readings_V, answer);
  if (course != nullptr) add_voltage_curves(scene, response, *course, answer);
  if (scene.feels_neighbours)
    answer.step_error = beyond_reach(scene, response, loads_Pa, readings_V, answer);
  set_results(scene, answer);
  add_transfer(scene, response, accuracy.potential.reach_m, answer);
  return answer;
}

// Change of the voltages by the last refinement of the tops, as part of their errors.
void add_change_of_loads(const SpaceScene& scene, const SpaceContact& contact,
                         SceneAnswer& answer) {
  if (contact.change_Pa.isZero(0.0)) return;
  const SceneAnswer change = voltages_on(scene, contact.change_Pa, space_meshes(scene)[1], {});
  for (std::size_t m = 0; m < answer.maps.size(); ++m) {
    for (std::size_t at = 0; at < answer.maps[m].value.size(); ++at) {
      answer.maps[m].error[at] += std::abs(change.maps[m].value[at]);
    }
  }
}

// Values are sums over pillars and over the points of a top, so that one that vanishes by symmetry is known to the
// rounding of the largest. Tops that nothing touches have exact zeros.
void add_rounding(SceneAnswer& answer) {
  constexpr double kRoundings = 4.0;       // of each term
  constexpr double kPointsOfTop = 1000.0;  // about
  const double terms = kPointsOfTop + static_cast<double>(answer.array.pillars.size());
  const double relative = kRoundings * std::numeric_limits<double>::epsilon() * terms;
  for (SceneMap& map : answer.maps) {
    const double rounding = relative * size_of(map);
    for (std::size_t at = 0; at < map.error.size(); ++at) {
      if (map.value[at] != 0.0) map.error[at] += rounding;
    }
  }
}

// Shares of the tolerance: below the first no finer grid of the tops is tried, the second is the
// most that the finest grid may leave.
constexpr double kShareOfContact = 0.25;
constexpr double kMostOfContact = 0.7;

void refuse_coarse_tops(const SpaceScene& scene, double error) {
  if (error <= kMostOfContact * scene.tolerance) return;
  const std::string what = scene.touch && scene.touch->is_path()
                               ? "grid of the tops and the finest steps of the path leave"
                               : "grid of the tops leaves";
  throw std::runtime_error("the finest " + what + " a relative error of about " +
                           text_of(error, 2) +
                           " in the forces and moments, where a top is touched in part; ask for a "
                           "tolerance of " +
                           text_of(1.1 * error / kMostOfContact, 2) + " or more");
}

SpaceContact settled_contact(const SpaceScene& scene) {
  SpaceContact contact = contact_within(scene, kShareOfContact * scene.tolerance);
  refuse_missed_tips(scene, contact.pressed.depth_m);
  refuse_coarse_tops(scene, contact_error(contact));
  return contact;
}

TouchCourse settled_course(const SpaceScene& scene) {
  TouchCourse course = touch_course(scene, kShareOfContact * scene.tolerance);
  refuse_coarse_tops(scene, course.relative_error);
  return course;
}

std::string note_of_course(const SpaceScene& scene, const TouchCourse& course) {
  const std::string at_s = text_of(course.time_s[course.shown_at], 4) + " s";
  if (scene.touch->is_path()) {
    return "the shape moves: maps and single values are those at " + at_s +
           ", the end of its path, or the largest force if less than half of it is left there; "
           "slip is that up to the end" +
           (course.slip_m.empty() ? ""
                                  : ". Tops turn freely while they are dragged; a slender pillar "
                                    "whose top stays level under the shape is up to four times as "
                                    "stiff sideways");
  }
  return "contact shrinks in this touch, which is followed step by step; maps and single values "
         "are those of the largest force, at " +
         at_s;
}

SceneAnswer touch_answer_on(const SpaceScene& scene, const Discretisation& mesh) {
  const TouchCourse course = touch_course(scene, kShareOfContact * scene.tolerance);
  SceneAnswer answer =
      voltages_on(scene, course.shown.loads_Pa, mesh, electrode_coupling(scene), &course);
  add_contact(scene, course.shown, answer);
  add_slip(scene, course, answer);
  set_results(scene, answer);
  for (SceneCurve& curve : answer.curves) curve.error.assign(curve.x.size(), 0.0);
  finish_curves(scene, course, 0.0, answer);
  answer.step_error = course.relative_error;
  return answer;
}

SceneAnswer pressed_answer_on(const SpaceScene& scene, const Discretisation& mesh) {
  const SpaceContact contact = contact_on(scene, (mesh.degree - 3) / 2);
  SceneAnswer answer = voltages_on(scene, contact.loads_Pa, mesh, electrode_coupling(scene));
  add_contact(scene, contact, answer);
  set_results(scene, answer);
  return answer;
}

// The error that does not fall with the accuracy; refused if it leaves too little of the tolerance.
double refuse_if_large(const SpaceScene& scene, const ConstantErrors& parts) {
  const double constant = largest_constant_error(scene, parts);
  if (constant > (1.0 - kShareOfAccuracy) * scene.tolerance)
    refuse_constant(scene, constant, parts);
  return constant;
}

}  // namespace

SceneAnswer space_answer_on(const SpaceScene& scene, const Discretisation& mesh) {
  SceneAnswer answer = scene.touch ? touch_answer_on(scene, mesh)
                       : scene.press
                           ? pressed_answer_on(scene, mesh)
                           : voltages_on(scene, loads_of(scene), mesh, electrode_coupling(scene));
  add_heat_and_noise(scene, answer);
  if (senses_forces(scene)) finish_sensed(scene, answer);
  return answer;
}

SceneAnswer simulate_space(const SpaceScene& scene) {
  validate(scene);
  ConstantErrors parts = constant_errors(scene);
  refuse_if_large(scene, parts);
  std::optional<SpaceContact> contact;
  std::optional<TouchCourse> course;
  if (scene.press && scene.progress) scene.progress(0.0, "which tops touch");
  if (scene.touch) course = settled_course(scene);
  if (scene.press) contact = course ? course->shown : settled_contact(scene);
  const bool is_measured = scene.quadrants.measured_V.size() > 0;
  const TopLoads loads_Pa = contact       ? contact->loads_Pa
                            : is_measured ? measured_loads_Pa(scene)
                                          : loads_of(scene);
  const bool is_path = scene.touch && scene.touch->is_path();
  if (contact || is_measured) {
    set_edge_errors(scene, is_path ? largest_loads(*course, scene.pillars.size()) : loads_Pa,
                    parts);
  }
  const double constant = refuse_if_large(scene, parts);
  double of_contact = contact ? contact_error(*contact) : 0.0;
  if (course) of_contact = std::max(of_contact, course->relative_error);
  BackingEffect backing;
  if (scene.backing && scene.feels_backing) backing = backing_effect(scene, loads_Pa);
  check_edge(scene, backing, constant, (1.0 - kShareOfAccuracy) * scene.tolerance);
  const double left = std::max(scene.tolerance - constant - of_contact - backing.edge,
                               0.5 * kShareOfAccuracy * scene.tolerance);
  SceneAnswer answer = answer_within({.tolerance = left,
                                      .meshes = space_meshes(scene),
                                      .progress = scene.progress,
                                      .step_error_falls = true},  // with the reach, which grows
                                     [&](const Discretisation& mesh) {
                                       return voltages_on(scene, loads_Pa, mesh, parts.coupling,
                                                          course ? &*course : nullptr);
                                     });
  if (contact) add_change_of_loads(scene, *contact, answer);
  for (SceneMap& map : answer.maps) {
    const double of_all = common_error_of(map, parts) + backing.edge * edge_size_of(map);
    const double edge_size = edge_size_of(map);
    for (std::size_t at = 0; at < map.value.size(); ++at) {
      map.error[at] += of_all + edge_size * parts.edge[map.pillar[at]];
    }
  }
  for (SceneMap& map : answer.maps) {
    // Errors of the voltages at this accuracy that the change of the forces does not show.
    if (!map.name.starts_with("sensed_") || is_measured) continue;
    const double of_voltages = answer.largest_relative_error * size_of(map);
    for (double& error : map.error) error += of_voltages;
  }
  answer.largest_relative_error += constant + of_contact + backing.edge;
  if (contact) add_contact(scene, *contact, answer);
  if (course) add_slip(scene, *course, answer);
  add_rounding(answer);
  if (senses_forces(scene)) add_reading_noise(scene, answer);
  set_results(scene, answer);
  if (course) finish_curves(scene, *course, constant, answer);
  add_heat_and_noise(scene, answer);
  if (senses_forces(scene)) finish_sensed(scene, answer);
  if (contact) answer.notes = contact_notes(scene, course ? course->largest : *contact);
  if (course && course->has_shrunk) answer.notes.push_back(note_of_course(scene, *course));
  if (senses_forces(scene))
    std::ranges::move(sensed_notes(scene), std::back_inserter(answer.notes));
  add_stretching_note(scene, backing, answer);
  if (scene.electrode == SpaceElectrode::kMetalQuadrants) {
    answer.notes.push_back("each quarter is a conductor with one voltage, with gaps of " +
                           micrometres(scene.electrode_gap_m, 3) +
                           " between them; without metal (kind = \"sampled\") quarters read means "
                           "over their areas");
  }
  return answer;
}

}  // namespace viscard
