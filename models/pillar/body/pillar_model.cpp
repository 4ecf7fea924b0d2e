#include "models/pillar/body/pillar_model.h"

#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace viscard {
namespace {

bool is_axial(Motion motion) {
  return motion == Motion::kLongitudinal || motion == Motion::kPlaneSymmetric;
}

bool is_sideways(Motion motion) {
  return motion == Motion::kLateral || motion == Motion::kPlaneAntisymmetric;
}

}  // namespace

PillarGeometry with_electrode_edge(PillarGeometry geometry,
                                   const std::optional<ElectrodeOptions>& electrodes) {
  if (electrodes && geometry.film) {
    geometry.film->electrode_radius_m = electrodes->electrode_radius_m;
    geometry.film->electrode_is_below = electrodes->grounded == FilmFace::kTop;
  }
  return geometry;
}

PillarState operator*(double factor, PillarState state) {
  state.unknowns *= factor;
  state.pressure_source *= factor;
  state.heat *= factor;
  return state;
}

PillarState operator+(PillarState one, const PillarState& other) {
  one.unknowns += other.unknowns;
  one.pressure_source += other.pressure_source;
  one.heat += other.heat;
  return one;
}

PillarModel::PillarModel(const PillarGeometry& geometry, const Discretisation& discretisation,
                         const PillarMedia& media, const ModelOptions& options)
    : PillarModel(geometry, discretisation, media, options, nullptr, nullptr) {}

PillarModel::PillarModel(const PillarGeometry& geometry, const Discretisation& discretisation,
                         const PillarMedia& media, const ModelOptions& options,
                         const PillarModel* nearby, const NearbySolutions* solutions)
    : geometry_(with_electrode_edge(geometry, options.electrodes)),
      options_(options),
      mesh_(pillar_mesh(geometry_, discretisation)),
      nearby_(nearby),
      nearby_solutions_(solutions) {
  if (geometry.film.has_value() != media.film.has_value()) {
    throw std::invalid_argument("a film needs its material, and a material its film");
  }
  if (options.rigid_top && !is_axial(options.motion) && !is_sideways(options.motion)) {
    throw std::invalid_argument("a rigid plate on top belongs to axial and sideways motion");
  }
  if (options.bottom_slides && !is_axial(options.motion)) {
    throw std::invalid_argument("a bottom that slides belongs to axial motion");
  }
  media_ = {media.pillar};
  if (media.film) media_.push_back(*media.film);
  Kinematics kinematics = kinematics_of(options.motion);
  if (options.electrodes) {
    if (!media.film || !media.film->has_permittivity()) {
      throw std::invalid_argument("electrodes need a film with a permittivity");
    }
    potential_scale_V_ = viscard::potential_scale_V(*media.film);
    kinematics = with_potential(kinematics, potential_scale_V_);
  }
  DofMap dofs = make_dofs(kinematics);
  if (nearby != nullptr) {
    require_nearby(dofs);
    system_ =
        std::make_unique<DiscreteSystem>(mesh_.section, std::move(kinematics), nearby->system());
    return;
  }
  system_ = std::make_unique<DiscreteSystem>(mesh_.section, std::move(kinematics), std::move(dofs));
}

DofMap PillarModel::make_dofs(const Kinematics& kinematics) {
  const Section& section = mesh_.section;
  const int columns = section.x().element_count();
  DofMap dofs(kinematics.field_count, section.node_count());
  if (options_.rigid_top) {
    const std::vector<int> top = nodes_on_break(section, mesh_.top_row, 0, mesh_.pillar_columns);
    if (is_axial(options_.motion)) dofs.tie(1, top);
    const int along_axis = options_.motion == Motion::kLateral ? 2 : 1;
    for (const int node : top) {
      if (!is_axial(options_.motion)) dofs.fix(along_axis, node);
    }
  }
  const int phi = kinematics.potential_field;
  if (options_.electrodes) {
    const bool top_grounded = options_.electrodes->grounded == FilmFace::kTop;
    for (int node = 0; node < section.node_count(); ++node) {
      if (section.node_z(node) > 0.0) dofs.fix(phi, node);  // the pillar has no electric field
    }
    const int electrode_row = top_grounded ? 0 : mesh_.bond_row;
    std::vector<int> electrode;
    const double edge_m = options_.electrodes->electrode_radius_m * (1.0 + 1e-9);
    for (const int node : nodes_on_break(section, electrode_row, 0, columns)) {
      if (edge_m > 0.0 && section.node_x(node) <= edge_m) electrode.push_back(node);
    }
    if (!electrode.empty()) electrode_handle_ = dofs.tie(phi, electrode);
    for (const int node : nodes_on_break(section, top_grounded ? mesh_.bond_row : 0, 0, columns)) {
      dofs.fix(phi, node);
    }
  }
  for (int node = 0; node < section.node_count(); ++node) {
    if (section.node_x(node) != 0.0) continue;
    for (const int field : kinematics.zero_on_axis) dofs.fix(field, node);
  }
  if (options_.fixed_bottom) {
    for (const int node : nodes_on_break(section, 0, 0, columns)) {
      for (int field = options_.bottom_slides ? 1 : 0; field < kinematics.field_count; ++field) {
        if (field != phi) dofs.fix(field, node);
      }
    }
  } else if (options_.pin_bottom) {
    const std::vector<int> bottom = nodes_on_break(section, 0, 0, columns);
    for (const RigidPin& pin : rigid_pins(options_.motion)) {
      dofs.fix(pin.field, pin.at_rim ? bottom.back() : bottom.front());
    }
  }
  dofs.number();
  return dofs;
}

void PillarModel::require_nearby(const DofMap& dofs) const {
  const PillarModel& other = *nearby_;
  const bool has_same_elements =
      mesh_.section.elements() == other.mesh_.section.elements() && dofs == other.system().dofs();
  if (!has_same_elements) throw NotNearby("the mesh has other elements");
  for (std::size_t i = 0; i < media_.size(); ++i) {
    if (condenses_pressure(media_[i]) != condenses_pressure(other.media_[i])) {
      throw NotNearby("pressures are condensed in one of two materials alone");
    }
    const bool is_incompressible = std::isinf(media_[i].bulk_Pa);
    if (is_incompressible != std::isinf(other.media_[i].bulk_Pa) ||
        (is_incompressible && !(geometry_ == other.geometry_))) {
      throw NotNearby("an incompressible pillar has other lengths");
    }
  }
}

bool PillarModel::is_plane_stress() const {
  return options_.plane == PlaneState::kStress && (options_.motion == Motion::kPlaneSymmetric ||
                                                   options_.motion == Motion::kPlaneAntisymmetric);
}

bool PillarModel::condenses_pressure(const Medium& medium) const {
  return medium.is_isotropic && medium.poisson_ratio >= options_.condense_pressures_from &&
         !is_plane_stress();
}

double PillarModel::condensed_bulk_Pa(const Medium& medium) const {
  if (!condenses_pressure(medium)) return 0.0;
  return std::isinf(medium.bulk_Pa) ? kPenaltyOverShear * medium.shear_Pa : medium.bulk_Pa;
}

Eigen::MatrixXd PillarModel::elastic_form(const Medium& medium) const {
  if (condenses_pressure(medium)) return medium.shear_Pa * deviatoric_form();
  return material_form(medium, options_.electrodes.has_value(), is_plane_stress());
}

double PillarModel::mean_modulus_Pa(int region) const {
  return elastic_form(medium(region)).diagonal().head(6).mean();
}

Eigen::VectorXd PillarModel::top_traction() const {
  if (!is_axial(options_.motion)) throw std::invalid_argument("this family has no axial load");
  return system_->line_load(1, mesh_.top_row, 0, mesh_.pillar_columns);
}

double PillarModel::mean_top_displacement_m(const PillarState& state) const {
  const Eigen::VectorXd traction = top_traction();
  return traction.dot(state.unknowns) / traction.sum();
}

int PillarModel::electrode_dof() const {
  return electrode_handle_ < 0 ? -1 : system_->dofs().tied_dof(electrode_handle_);
}

const SectionElement& PillarModel::element_at(double x, double z, int region) const {
  const Section& section = mesh_.section;
  for (const bool left : {true, false}) {
    for (const bool below : {true, false}) {
      const double xi = x / section.stretch_at(region, z).scale;
      const int column = section.x().element_at(xi, left);
      const int row = section.z().element_at(z, below);
      if (section.region(column, row) != region) continue;
      for (const SectionElement& element : section.elements()) {
        if (element.column == column && element.row == row) return element;
      }
    }
  }
  throw std::invalid_argument("the point x = " + micrometres(x) + ", z = " + micrometres(z) +
                              " does not lie in the body asked for");
}

Eigen::VectorXd PillarModel::stress_at(const PillarState& state, const SectionElement& element,
                                       double x, double z) const {
  const Medium& own = medium(element.region);
  const std::vector<OperatorRow> rows = system_->kinematics().strain_and_field();
  const Eigen::VectorXd at = system_->rows_at(rows, state.unknowns, element, x, z);
  const Eigen::MatrixXd form = elastic_form(own);
  Eigen::VectorXd stress = (form * at.head(form.cols())).head(6);
  if (condenses_pressure(own)) {
    stress.head(3).array() += condensed_bulk_Pa(own) * system_->projected_divergence_at(
                                                           state.pressure_source, element, x, z);
  }
  if (state.heat != 0.0) stress -= state.heat * free_strain_stress_Pa(own);
  return stress;
}

double PillarModel::mean_stress(const PillarState& state, int component, double z, int region,
                                double radius_m) const {
  const LineMesh& line = mesh_.section.x();
  const double scale = mesh_.section.stretch_at(region, z).scale;
  double sum = 0.0;
  double area = 0.0;
  for (int column = 0; column < line.element_count(); ++column) {
    const LineMesh::ElementRule rule = line.rule(column);
    if (scale * rule.x[0] > radius_m) break;
    const SectionElement& element = element_at(scale * rule.x[rule.x.size() / 2], z, region);
    for (Eigen::Index i = 0; i < rule.x.size(); ++i) {
      const double weight = rule.weight[i] * (system_->kinematics().x_power == 1 ? rule.x[i] : 1.0);
      sum += weight * stress_at(state, element, scale * rule.x[i], z)[component];
      area += weight;
    }
  }
  return sum / area;
}

}  // namespace viscard
