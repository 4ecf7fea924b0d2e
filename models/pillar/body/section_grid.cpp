#include "models/pillar/body/section_grid.h"

#include "models/pillar/body/piezo_static.h"

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

// Number of pieces of an element in one direction, short against the radius to look smooth.
int pieces_of(double length_m, double radius_m) {
  return std::clamp(static_cast<int>(std::ceil(6.0 * length_m / radius_m)), 2, 16);
}

}  // namespace

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

SectionField displacement_field(const PillarModel& model, const Sampling& at,
                                const std::string& name, const Eigen::VectorXd& solution) {
  SectionField field{name, "m", true, {}};
  const std::vector<OperatorRow>& rows = model.system().kinematics().displacement;
  for (std::size_t i = 0; i < at.element.size(); ++i) {
    const Eigen::VectorXd u =
        model.system().rows_at(rows, solution, *at.element[i], at.grid.x_m[i], at.grid.z_m[i]);
    field.value.push_back({u[0], u[1], u[2]});
  }
  return field;
}

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

SectionField stress_field(const PillarModel& model, const Sampling& at, const PillarState& state) {
  SectionField field{"stress_zz_Pa", "Pa", false, {}};
  const double off_axis_m = 1e-6 * model.radius_m();  // u_r/r has a finite limit there
  for (std::size_t i = 0; i < at.element.size(); ++i) {
    const double x = std::max(at.grid.x_m[i], off_axis_m);
    field.value.push_back({model.stress_at(state, *at.element[i], x, at.grid.z_m[i])[2], 0.0, 0.0});
  }
  return field;
}

SectionField potential_field(const PillarModel& model, const Sampling& at,
                             const PillarState& state) {
  SectionField field{"potential_V", "V", false, {}};
  for (std::size_t i = 0; i < at.element.size(); ++i) {
    const SectionElement& element = *at.element[i];
    const double x = at.grid.x_m[i], z = at.grid.z_m[i];
    const bool in_film = element.region == kFilmRegion;
    field.value.push_back({in_film ? potential_in_V(model, state, element, x, z) : 0.0, 0.0, 0.0});
  }
  return field;
}

}  // namespace viscard
