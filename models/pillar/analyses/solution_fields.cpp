#include "models/pillar/analyses/solution_fields.h"

#include "models/pillar/analyses/analysis.h"
#include "models/pillar/analyses/top_load.h"
#include "models/pillar/body/pillar_loads.h"
#include "models/pillar/body/pillar_modes.h"
#include "models/pillar/plan/plan.h"

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

// Pieces of an element along one way: short against the radius, so that curves look like curves.
int pieces_of(double length_m, double radius_m) {
  return std::clamp(static_cast<int>(std::ceil(6.0 * length_m / radius_m)), 2, 16);
}

// The grid of a model, and for every point its element.
struct Sampling {
  SectionGrid grid;
  std::vector<const SectionElement*> element;
};

Sampling sampling_of(const PillarModel& model) {
  Sampling out;
  out.grid.is_round = model.system().kinematics().x_power == 1;
  const Section& section = model.mesh().section;
  for (const SectionElement& element : section.elements()) {
    const double x0 = section.x().breaks()[static_cast<std::size_t>(element.column)];
    const double z0 = section.z().breaks()[static_cast<std::size_t>(element.row)];
    const int nx = pieces_of(section.x().length(element.column), model.radius_m());
    const int nz = pieces_of(section.z().length(element.row), model.radius_m());
    const auto first = static_cast<int>(out.grid.x_m.size());
    for (int j = 0; j <= nz; ++j) {
      for (int i = 0; i <= nx; ++i) {
        const double z = z0 + section.z().length(element.row) * j / nz;
        const double x = x0 + section.x().length(element.column) * i / nx;
        out.grid.x_m.push_back(x * section.stretch_at(element.region, z).scale);
        out.grid.z_m.push_back(z);
        out.element.push_back(&element);
        if (i == nx || j == nz) continue;
        const int a = first + j * (nx + 1) + i;
        out.grid.quads.push_back({a, a + 1, a + nx + 2, a + nx + 1});
        out.grid.is_film.push_back(element.region == kFilmRegion);
      }
    }
  }
  return out;
}

SectionField displacement_of(const PillarModel& model, const Sampling& at, const std::string& name,
                             const Eigen::VectorXd& solution) {
  SectionField field{name, "m", true, {}};
  const std::vector<OperatorRow>& rows = model.system().kinematics().displacement;
  for (std::size_t i = 0; i < at.element.size(); ++i) {
    const Eigen::VectorXd u =
        model.system().rows_at(rows, solution, *at.element[i], at.grid.x_m[i], at.grid.z_m[i]);
    field.value.push_back({u[0], u[1], u[2]});
  }
  return field;
}

// Largest displacement 1 over all angles: of cos and sin parts only one is there at a time.
void normalise(int harmonic, SectionField& field) {
  double largest = 0.0;
  for (const auto& u : field.value) {
    const double in_plane = std::hypot(u[0], u[2]);
    const double size =
        harmonic == 0 ? std::hypot(in_plane, u[1]) : std::max(in_plane, std::abs(u[1]));
    largest = std::max(largest, size);
  }
  if (largest == 0.0) return;
  for (auto& u : field.value) {
    for (double& part : u) part /= largest;
  }
}

SectionField stress_of(const PillarModel& model, const Sampling& at, const PillarState& state) {
  SectionField field{"stress_zz_Pa", "Pa", false, {}};
  const double off_axis_m = 1e-6 * model.radius_m();  // u_r/r has its limit there
  for (std::size_t i = 0; i < at.element.size(); ++i) {
    const double x = std::max(at.grid.x_m[i], off_axis_m);
    field.value.push_back({model.stress_at(state, *at.element[i], x, at.grid.z_m[i])[2], 0.0, 0.0});
  }
  return field;
}

SectionField potential_of(const PillarModel& model, const Sampling& at, const PillarState& state) {
  SectionField field{"potential_V", "V", false, {}};
  const OperatorRow value = {{model.system().kinematics().potential_field, 0, 0, 0, 1.0}};
  for (std::size_t i = 0; i < at.element.size(); ++i) {
    const bool in_film = at.element[i]->region == kFilmRegion;
    const double phi = in_film ? model.system().rows_at({value}, state.unknowns, *at.element[i],
                                                        at.grid.x_m[i], at.grid.z_m[i])[0]
                               : 0.0;
    field.value.push_back({model.potential_scale_V() * phi, 0.0, 0.0});
  }
  return field;
}

PillarState static_state(const Scene& scene, const PillarModel& model) {
  const Eigen::VectorXd traction = model.top_traction();
  PiezoAnswer unit;  // 1 Pa
  if (model.electrode_dof() < 0) {
    unit.open = model.solve(-traction);
    unit.top_displacement_m = traction.dot(unit.open.unknowns) / traction.sum();
  } else {
    unit = piezo_static(model, 1.0);
  }
  const double pressure_Pa = top_pressure_Pa(scene, unit);
  if (scene.drive_V == 0.0) {
    PillarState state = unit.open;
    state.unknowns *= pressure_Pa;
    state.pressure_source *= pressure_Pa;
    return state;
  }
  // Charge on the electrode until it has the voltage, beside what the pressure gives.
  Eigen::VectorXd forces = -pressure_Pa * traction;
  const double charge_C = unit.charge_C * pressure_Pa + unit.capacitance_F * scene.drive_V;
  forces[model.electrode_dof()] -= charge_C * model.potential_scale_V();
  return model.solve(forces);
}

SectionGrid static_grid(const Scene& scene, const SceneAnswer& on_mesh) {
  ModelOptions options = options_of(scene, axial_motion(scene));
  options.electrodes = scene.electrodes;
  const PillarModel model(scene.geometry, on_mesh.discretisation, media_of(scene), options);
  const PillarState state = static_state(scene, model);
  Sampling at = sampling_of(model);
  at.grid.name = "static";
  at.grid.fields.push_back(displacement_of(model, at, "displacement_m", state.unknowns));
  at.grid.fields.push_back(stress_of(model, at, state));
  if (scene.electrodes) at.grid.fields.push_back(potential_of(model, at, state));
  return at.grid;
}

SectionGrid sideways_grid(const Scene& scene, const SceneAnswer& on_mesh) {
  const PillarModel model = sideways_model(scene, on_mesh);
  const PillarState state = sideways_state(scene, model);
  Sampling at = sampling_of(model);
  at.grid.name = "static";
  at.grid.harmonic = 1;
  at.grid.fields.push_back(displacement_of(model, at, "displacement_m", state.unknowns));
  if (scene.electrodes) at.grid.fields.push_back(potential_of(model, at, state));
  return at.grid;
}

SectionGrid modal_grid(const Scene& scene, const ModeFamily& family, const SceneAnswer& on_mesh) {
  const PillarModel model = model_of(scene, family.motion, on_mesh);
  Sampling at = sampling_of(model);
  at.grid.name = family.name;
  at.grid.harmonic = family.motion == Motion::kPlaneAntisymmetric ? 1 : family.harmonic;
  int number = 0;
  for (const PillarMode& mode : family_modes(scene, family, model, on_mesh)) {
    SectionField shape = displacement_of(
        model, at, std::string(family.name) + "_" + std::to_string(++number), mode.shape);
    shape.unit = "1";
    normalise(at.grid.harmonic, shape);
    at.grid.fields.push_back(std::move(shape));
  }
  return at.grid;
}

}  // namespace

std::array<double, 3> displacement_at(const SectionGrid& grid, const SectionField& field,
                                      std::size_t point, double theta) {
  const auto& [r, t, z] = field.value[point];
  const double m = grid.harmonic;
  const double radial = r * std::cos(m * theta);
  const double around = grid.harmonic == 0 ? t : t * std::sin(m * theta);
  return {radial * std::cos(theta) - around * std::sin(theta),
          radial * std::sin(theta) + around * std::cos(theta), z * std::cos(m * theta)};
}

double scalar_at(const SectionGrid& grid, const SectionField& field, std::size_t point,
                 double theta) {
  return field.value[point][0] * std::cos(grid.harmonic * theta);
}

std::vector<SectionGrid> solution_fields(const Scene& scene, const Discretisation& mesh) {
  const Scene planned = plan_effects(scene).reduced;
  SceneAnswer on_mesh;
  on_mesh.discretisation = mesh;
  if (is_sideways(planned)) return {sideways_grid(planned, on_mesh)};
  if (planned.kind == AnalysisKind::kStatic) return {static_grid(planned, on_mesh)};
  std::vector<SectionGrid> grids;
  if (planned.kind != AnalysisKind::kModal) return grids;
  for (const ModeFamily& family : mode_families(planned)) {
    grids.push_back(modal_grid(planned, family, on_mesh));
  }
  return grids;
}

}  // namespace viscard
