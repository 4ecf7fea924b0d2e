#include "models/array/plane/pressed_row.h"

#include "models/answer/error_control.h"
#include "models/array/plane/array_analysis.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace viscard {
namespace {

constexpr double kShareOfContact = 0.25;  // of the tolerance
constexpr double kLeastLeft = 0.1;        // of it, for the meshes of the film

// Readings of a row under tractions on its tops.
ArrayAnswer answer_of_loads(const ArrayScene& scene, const Discretisation& mesh,
                            const Eigen::MatrixXd& loads_Pa, int* unknowns) {
  const auto count = static_cast<int>(loads_Pa.cols());
  const auto ports = static_cast<int>(loads_Pa.rows());
  const ArrayModel model = model_of(scene, mesh, {.top_degree = kTopDegree});
  if (unknowns != nullptr) *unknowns = model.unknowns();
  Eigen::VectorXd loads = Eigen::VectorXd::Zero(model.chain().port_count());
  if (scene.feels_neighbours) {
    for (int i = 0; i < count; ++i) {
      for (int port = 0; port < ports; ++port)
        loads[model.pillar_port(i, port)] = loads_Pa(port, i);
    }
    return array_answer(model, loads);
  }
  // Each pillar alone: its own response to each of its tractions.
  ArrayAnswer row;
  for (int port = 0; port < ports; ++port) {
    loads.setZero();
    loads[model.pillar_port(0, port)] = 1.0;
    const ArrayAnswer one = array_answer(model, loads);
    for (const auto value : {&ArrayAnswer::centre_V, &ArrayAnswer::mean_V,
                             &ArrayAnswer::electrode_V, &ArrayAnswer::electrode_C}) {
      if ((one.*value).size() == 0) continue;
      if (port == 0) row.*value = Eigen::VectorXd::Zero(count);
      row.*value += (one.*value)[0] * loads_Pa.row(port).transpose();
    }
  }
  return row;
}

SceneAnswer voltages_on(const ArrayScene& scene, const Discretisation& mesh,
                        const Eigen::MatrixXd& loads_Pa) {
  SceneAnswer answer;
  answer.discretisation = mesh;
  const ArrayAnswer row = answer_of_loads(scene, mesh, loads_Pa, &answer.unknowns);
  // Between pillars and at their middles as small as beside the largest mean or electrode voltage.
  double largest_V = 0.0;
  for (const Eigen::VectorXd* const values : {&row.centre_V, &row.mean_V, &row.electrode_V}) {
    if (values->size() > 0) largest_V = std::max(largest_V, values->cwiseAbs().maxCoeff());
  }
  const auto add = [&](const char* stem, const Eigen::VectorXd& values, const char* unit,
                       double scale) {
    for (Eigen::Index i = 0; i < values.size(); ++i) {
      const std::string name = std::string(stem) + "_" + std::to_string(i + 1);
      answer.results.push_back({name, values[i], unit, 0.0, scale, asks_for(scene, name)});
    }
  };
  add("centre_voltage", row.centre_V, "V", largest_V);
  add("mean_voltage", row.mean_V, "V", largest_V);
  add("electrode_voltage", row.electrode_V, "V", largest_V);
  add("midway_voltage", row.midway_V, "V", largest_V);
  const double largest_C = row.electrode_C.size() > 0 ? row.electrode_C.cwiseAbs().maxCoeff() : 0.0;
  add("electrode_charge", row.electrode_C, "C", largest_C);
  return answer;
}

// Adds what the last refinement of the tops changed in the voltages to their errors.
void add_change_of_loads(const ArrayScene& scene, const RowContact& contact, SceneAnswer& answer) {
  if (contact.load_changes_Pa.size() == 0) return;
  const SceneAnswer change = voltages_on(scene, answer.discretisation, contact.load_changes_Pa);
  for (std::size_t k = 0; k < answer.results.size(); ++k) {
    answer.results[k].error_estimate += std::abs(change.results[k].value);
  }
}

// Relative, of what the loads' tolerance refers to.
double relative_change(const RowContact& contact) {
  const double largest_Pa = contact.loads_Pa.cwiseAbs().maxCoeff();
  if (!(largest_Pa > 0.0) || contact.load_changes_Pa.size() == 0) return 0.0;
  return contact.load_changes_Pa.cwiseAbs().maxCoeff() / largest_Pa;
}

void add_contact(const ArrayScene& scene, const RowContact& contact, SceneAnswer& answer) {
  const double width_m = scene.geometry.diameter_m;
  const double largest = contact.largest_force_N_m();
  const auto add = [&](const std::string& name, double value, const char* unit, double error,
                       double scale, bool is_watched = true) {
    answer.results.push_back(
        {name, value, unit, error, scale, is_watched && asks_for(scene, name)});
  };
  for (std::size_t i = 0; i < contact.tops.size(); ++i) {
    const StripPressure& top = contact.tops[i];
    const StripPressure change =
        contact.top_changes.empty() ? StripPressure{} : contact.top_changes[i];
    const std::string number = "_" + std::to_string(i + 1);
    add("pillar_force" + number, top.force_N_m, "N/m", change.force_N_m, largest);
    add("moment" + number, top.moment_N, "N", change.moment_N, 0.25 * width_m * largest);
    if (scene.press->friction == Friction::kStick) {
      add("shear_force" + number, top.shear_N_m, "N/m", change.shear_N_m, 0.25 * largest);
    }
    if (!std::isnan(top.release_m)) {
      const double error_m = std::isnan(change.release_m) ? 0.0 : change.release_m;
      add("release_depth" + number, top.release_m, "m", error_m, 0.0, false);
    }
    add("contact_share_percent" + number, 100.0 * top.share, "%", 100.0 * change.share, 0.0, false);
  }
  double largest_Pa = 0.0, change_Pa = 0.0;
  for (std::size_t i = 0; i < contact.tops.size(); ++i) {
    largest_Pa = std::max(largest_Pa, contact.tops[i].force_N_m / width_m);
    if (contact.top_changes.empty()) continue;
    change_Pa = std::max(change_Pa, contact.top_changes[i].force_N_m / width_m);
  }
  add("contact_force", contact.force_N_m, "N/m", contact.force_change_N_m, largest);
  add("contacts", contact.contacts, "", contact.contact_change, 0.0, false);
  add("depth", contact.depth_m, "m", contact.depth_change_m, 0.0);
  add("largest_pressure", largest_Pa, "Pa", change_Pa, largest / width_m);
}

bool needs_film(const ArrayScene& scene) {
  return scene.feels_film && asks_for_voltages(scene);
}

void keep_wanted(const ArrayScene& scene, SceneAnswer& answer) {
  if (scene.wanted.empty()) return;
  std::erase_if(answer.results, [&](const SceneResult& one) { return !asks_for(scene, one.name); });
}

}  // namespace

SceneAnswer pressed_row_on(const ArrayScene& scene, const Discretisation& mesh) {
  const RowContact contact = row_contact_on(scene, mesh.degree - 4);
  SceneAnswer answer;
  if (needs_film(scene)) answer = voltages_on(scene, mesh, contact.loads_Pa);
  answer.discretisation = mesh;
  answer.unknowns = std::max(answer.unknowns, contact.unknowns);
  add_contact(scene, contact, answer);
  return answer;
}

SceneAnswer simulate_pressed_row(const ArrayScene& scene,
                                 const std::vector<Discretisation>& meshes) {
  if (scene.progress) scene.progress(0.0, "which tops touch");
  const RowContact contact = row_contact_within(scene, kShareOfContact * scene.tolerance);
  refuse_missed_row_tips(scene, contact.depth_m);
  const double of_contact = relative_change(contact);
  SceneAnswer answer;
  const bool is_loaded = contact.loads_Pa.cwiseAbs().maxCoeff() > 0.0;
  if (needs_film(scene) && is_loaded) {
    const double left = std::max(scene.tolerance - 2.0 * of_contact, kLeastLeft * scene.tolerance);
    answer = answer_within({left, meshes, scene.progress}, [&](const Discretisation& mesh) {
      return voltages_on(scene, mesh, contact.loads_Pa);
    });
    add_change_of_loads(scene, contact, answer);
  } else {
    answer.discretisation = meshes.front();
    if (needs_film(scene)) answer = voltages_on(scene, answer.discretisation, contact.loads_Pa);
  }
  answer.unknowns = std::max(answer.unknowns, contact.unknowns);
  answer.largest_relative_error += of_contact;
  add_contact(scene, contact, answer);
  keep_wanted(scene, answer);
  answer.notes = row_contact_notes(scene, contact);
  return answer;
}

std::vector<std::string> pressed_row_names(const ArrayScene& scene) {
  std::vector<std::string> names = {"pillar_force",    "moment",   "contact_share_percent",
                                    "contact_force",   "contacts", "depth",
                                    "largest_pressure"};
  if (scene.press->friction == Friction::kStick) names.emplace_back("shear_force");
  if (scene.press->work_of_adhesion_J_m2 > 0.0) names.emplace_back("release_depth");
  if (!is_electric(scene)) return names;
  const bool is_read = !scene.electrodes.is_equipotential;
  names.emplace_back(is_read ? "centre_voltage" : "electrode_voltage");
  names.emplace_back(is_read ? "mean_voltage" : "electrode_charge");
  if (scene.geometry.count > 1) names.emplace_back("midway_voltage");
  return names;
}

}  // namespace viscard
