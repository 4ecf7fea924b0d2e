#include "models/pillar/scene_body.h"

#include "models/pillar/pillar_loads.h"
#include "models/pillar/viscoelastic_pillar.h"

#include <cmath>
#include <stdexcept>

namespace viscard {

SceneBody body_of(const Scene& scene, Motion motion, const SceneBodyOptions& options,
                  SceneAnswer& answer) {
  ModelOptions model_options = options_of(scene, motion);
  model_options.rigid_top = options.rigid_top;
  if (motion == axial_motion(scene)) model_options.electrodes = scene.electrodes;
  SceneBody body;
  body.model = std::make_unique<PillarModel>(scene.geometry, answer.discretisation, media_of(scene),
                                             model_options);
  count_unknowns(*body.model, answer);
  body.system = viscoelastic_system(*body.model, scene.pillar, options.with_mass);
  body.system.load = unit_top_force(*body.model);
  const Eigen::VectorXd load = body.system.load;
  body.outputs.push_back(
      {"top_displacement", "m", [load](const Eigen::VectorXd& u) { return load.dot(u); }});
  const PillarModel* model = body.model.get();
  if (!model->options().electrodes) return body;
  if (model->electrode_dof() >= 0) {
    body.outputs.push_back({"electrode_voltage", "V", [model](const Eigen::VectorXd& u) {
                              return model->potential_scale_V() * u[model->electrode_dof()];
                            }});
    return body;
  }
  const bool top = scene.electrodes->grounded == FilmFace::kBottom;
  const double z_m = top ? 0.0 : -scene.geometry.film->thickness_m;
  body.outputs.push_back({"potential_at_centre", "V", [model, z_m](const Eigen::VectorXd& u) {
                            PillarState state;
                            state.unknowns = u;
                            return potential_at_V(*model, state, 0.0, z_m);
                          }});
  return body;
}

ReadoutFilter readout_of(const Scene& scene, const SceneBody& body, SceneAnswer& answer) {
  if (!scene.readout || body.model->electrode_dof() < 0) {
    throw std::invalid_argument("a readout needs an electrode with a radius");
  }
  const double capacitance_F = piezo_static(*body.model, 1.0).capacitance_F;
  const ReadoutFilter filter = readout_filter(*scene.readout, capacitance_F);
  answer.results.push_back({"electrode_capacitance", capacitance_F, "F"});
  if (std::isfinite(filter.time_constant_s)) {
    answer.results.push_back({"readout_time_constant", filter.time_constant_s, "s"});
  }
  return filter;
}

}  // namespace viscard
