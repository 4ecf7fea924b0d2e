#include "models/pillar/analyses/scene_body.h"

#include "models/pillar/analyses/analysis.h"
#include "models/pillar/body/piezo_static.h"
#include "models/pillar/body/pillar_model.h"
#include "models/pillar/body/pillar_modes.h"
#include "models/pillar/mesh/pillar_mesh.h"
#include "models/pillar/time/viscoelastic_pillar.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

namespace viscard {
namespace {

// Holds an unknown without load at zero by removing its row and column except for the diagonal.
// Only the elastic part has entries of the film's potential.
void hold_at_zero(int dof, SymmetricSparse& matrix) {
  for (int column = 0; column < matrix.outerSize(); ++column) {
    for (SymmetricSparse::InnerIterator entry(matrix, column); entry; ++entry) {
      const bool is_own = entry.row() == dof || entry.col() == dof;
      if (is_own && entry.row() != entry.col()) entry.valueRef() = 0.0;
    }
  }
}

// A linear function of the potential on the face that is not grounded, as a vector.
Eigen::VectorXd row_on_free_face(const PillarScene& scene, const PillarModel& model,
                                 const std::function<double(const PillarState&)>& of) {
  const DiscreteSystem& system = model.system();
  const Section& section = model.mesh().section;
  const bool is_below = scene.electrodes->grounded == FilmFace::kTop;
  PillarState state;
  state.unknowns = Eigen::VectorXd::Zero(system.size());
  Eigen::VectorXd row = state.unknowns;
  for (const int node : nodes_on_break(section, is_below ? 0 : model.mesh().bond_row, 0,
                                       section.x().element_count())) {
    const int dof = system.dofs().dof(system.kinematics().potential_field, node);
    if (dof < 0) continue;
    state.unknowns[dof] = 1.0;
    row[dof] = of(state);
    state.unknowns[dof] = 0.0;
  }
  return row;
}

// Output of an electrode in quadrants under a sideways motion (piezo_static.h).
void add_quadrants(const PillarScene& scene, SceneBody& body) {
  const PillarModel* model = body.model.get();
  if (model->electrode_dof() < 0) {
    const double z_m = free_face_m(scene);
    body.outputs.push_back(
        {"quadrant_voltage", "V", row_on_free_face(scene, *model, [&](const PillarState& state) {
           return quadrant_mean_V(*model, state, z_m, model->radius_m());
         })});
    return;
  }
  const Eigen::VectorXd row = quadrant_charge_row(*model, body.system.elastic);
  hold_at_zero(model->electrode_dof(), body.system.elastic);
  body.outputs.push_back({"quadrant_charge", "C", row});
}

}  // namespace

SceneBody body_of(const PillarScene& scene, Motion motion, const SceneBodyOptions& options,
                  SceneAnswer& answer) {
  ModelOptions model_options = options_of(scene, motion);
  model_options.rigid_top = options.rigid_top;
  const bool is_axial = motion == axial_motion(scene);
  if (is_axial || reads_quadrants(scene)) model_options.electrodes = scene.electrodes;
  SceneBody body;
  const NearbyPillar* nearby = nearby_of(scene, motion, model_options.electrodes.has_value());
  body.model =
      std::make_unique<PillarModel>(scene.geometry, answer.discretisation, media_of(scene),
                                    model_options, nearby == nullptr ? nullptr : &nearby->model(),
                                    nearby == nullptr ? nullptr : &nearby->solutions());
  count_unknowns(*body.model, answer);
  body.system = viscoelastic_system(*body.model, scene.pillar, options.with_mass);
  body.system.load = unit_top_force(*body.model);
  if (!scene.fixed_bottom) {
    body.system.rigid = rigid_motions(*body.model);
    body.system.free_shift_1_s2 = free_shift_1_s2(*body.model);
  }
  body.outputs.push_back({"top_displacement", "m", body.system.load});
  const PillarModel* model = body.model.get();
  if (!model->options().electrodes) return body;
  if (!is_axial) {
    add_quadrants(scene, body);
    return body;
  }
  if (model->electrode_dof() >= 0) {
    body.outputs.push_back(
        {"electrode_voltage", "V",
         model->potential_scale_V() *
             Eigen::VectorXd::Unit(model->system().size(), model->electrode_dof())});
    return body;
  }
  const double z_m = free_face_m(scene);
  body.outputs.push_back(
      {"potential_at_centre", "V", row_on_free_face(scene, *model, [&](const PillarState& state) {
         return potential_at_V(*model, state, 0.0, z_m);
       })});
  return body;
}

namespace {

// A charge amplifier on a quadrant: -Q/C_f, through R_f C_f.
ReadoutFilter quadrant_filter(const Readout& readout) {
  return decaying(-1.0 / readout.capacitance_F, readout.resistance_Ohm * readout.capacitance_F);
}

FilmPort electrode_port(const PillarScene& scene, const SceneBody& body) {
  const PiezoAnswer at_rest = piezo_static(*body.model, 1.0);
  if (scene.film_loss.is_lossless()) return {at_rest.capacitance_F, at_rest.capacitance_F};
  const PermittivityChange change = permittivity_change(*body.model, at_rest);
  // The charge grows by q x/(1 + x), q = charge_share, which an open electrode shows as if C' were by 1 + q less. What
  // remains, compared with films of 1.1 to 100 times the permittivity, is 0.04 to 0.08 q for PVDF, 1.8 to 2.1 q for
  // PZT-5H. A circuit reads the charge itself.
  const double ratio = at_rest.capacitance_F / change.dielectric_F;
  const double q = std::abs(change.charge_share);
  return {.capacitance_F = at_rest.capacitance_F,
          .dielectric_F = change.dielectric_F / (1.0 + change.charge_share),
          .loss = scene.film_loss,
          .error = q * (ratio * ratio - 0.9),
          .error_in_circuit = 1.1 * q * ratio * ratio};
}

}  // namespace

std::vector<BodyReading> readings_of(const PillarScene& scene, const SceneBody& body,
                                     SceneAnswer& answer) {
  std::vector<BodyReading> readings;
  for (std::size_t i = 1; i < body.outputs.size(); ++i) {
    readings.push_back({i, body.outputs[i].name, body.outputs[i].unit});
  }
  const bool has_electrode = body.model->electrode_dof() >= 0;
  if (scene.readout && !has_electrode) {
    throw std::invalid_argument("a readout needs an electrode with a radius");
  }
  if (readings.empty() || !(scene.readout || !scene.film_loss.is_lossless())) return readings;
  if (reads_quadrants(scene) && has_electrode) {  // at 0 V, where a film loses nothing
    if (!scene.readout) return readings;
    readings.push_back({1, "reading", "V", quadrant_filter(*scene.readout)});
    add_time_constant(readings.back().filter.time_constant_s, answer);
    return readings;
  }
  const FilmPort port =
      has_electrode ? electrode_port(scene, body) : bonded_port(*scene.film, scene.film_loss);
  const double lost =
      scene.film_loss.is_lossless() ? 0.0 : lost_share(scene.film_loss, slowest_rad_s(scene));
  readings.front().filter = open_filter(port);
  readings.front().film_error = port.error * lost;
  if (!scene.readout) return readings;
  const bool is_held = scene.readout->kind == ReadoutKind::kCharge;  // at 0 V: nothing is lost
  readings.push_back({1, "reading", "V", readout_filter(*scene.readout, port),
                      is_held ? 0.0 : port.error_in_circuit * lost});
  answer.results.push_back({"electrode_capacitance", port.capacitance_F, "F"});
  add_time_constant(readings.back().filter.time_constant_s, answer);
  return readings;
}

void note_film_error(const BodyReading& reading, SceneAnswer& answer) {
  if (reading.film_error == 0.0) return;
  const auto is_of_it = [&](const std::string& name) { return name.starts_with(reading.name); };
  for (SceneCurve& curve : answer.curves) {
    if (!is_of_it(curve.name)) continue;
    curve.left_out.resize(curve.value.size(), 0.0);
    const double peak = largest_size(curve.value);
    for (std::size_t i = 0; i < curve.value.size(); ++i) {
      curve.left_out[i] += reading.film_error * (curve.allowed.empty() ? peak : curve.allowed[i]);
    }
  }
  for (SceneResult& result : answer.results) {
    if (!is_of_it(result.name)) continue;
    result.left_out += reading.film_error * std::max(std::abs(result.value), result.scale);
  }
}

}  // namespace viscard
