#include "models/array/space/foot_forces.h"

#include "models/array/space/foot_on_film.h"
#include "models/maths/dense.h"
#include "models/maths/gauss_legendre.h"
#include "models/maths/require.h"
#include "models/pillar/mesh/line_mesh.h"

#include <cmath>
#include <numbers>

namespace viscard {
namespace {

// Points across the foot of a pillar, and the forces at these points that are equivalent to forces
// on its nodes.
class FootPoints {
 public:
  FootPoints(const PillarModel& model, double largest_k_1_m) {
    const PillarMesh& mesh = model.mesh();
    const LineMesh& line = mesh.section.x();
    const int p = line.degree();
    const double scale = bond_radius_m(model.geometry()) /
                         line.breaks()[static_cast<std::size_t>(mesh.pillar_columns)];
    const int nodes = mesh.pillar_columns * p + 1;
    Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(nodes, nodes);
    std::vector<Eigen::RowVectorXd> rows;
    for (int column = 0; column < mesh.pillar_columns; ++column) {
      mass.block(column * p, column * p, p + 1, p + 1) += line.integral(column, 1, 0, 0);
      const double length = line.length(column);
      const int count = 2 * p + 4 + static_cast<int>(0.6 * largest_k_1_m * scale * length);
      const QuadratureRule rule = gauss_legendre(count);
      for (std::size_t q = 0; q < rule.points.size(); ++q) {
        const double x = line.breaks()[static_cast<std::size_t>(column)] + length * rule.points[q];
        radius_m_.push_back(scale * x);
        Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(nodes);
        row.segment(column * p, p + 1) =
            rule.weights[q] * length * x * line.basis_at(column, x).value.row(0);
        rows.push_back(row);
      }
    }
    Eigen::MatrixXd weights(static_cast<Eigen::Index>(rows.size()), nodes);
    for (std::size_t i = 0; i < rows.size(); ++i)
      weights.row(static_cast<Eigen::Index>(i)) = rows[i];
    // Forces f on the nodes are those of the traction M^-1 f in the mesh's own functions.
    from_nodes_ = Cholesky(mass).solve(Eigen::MatrixXd(weights.transpose())).transpose();
  }
  const std::vector<double>& radius_m() const { return radius_m_; }
  const Eigen::MatrixXd& from_nodes() const { return from_nodes_; }  // points x nodes

 private:
  std::vector<double> radius_m_;
  Eigen::MatrixXd from_nodes_;
};

// A pillar on a rigid base in one family of motion, solved under one load.
class HeldPillar {
 public:
  HeldPillar(const PillarGeometry& pillar, const Medium& medium, const Discretisation& mesh,
             Motion motion)
      : held_(pillar, mesh, {medium, std::nullopt}, options(motion, true)),
        free_(pillar, mesh, {medium, std::nullopt}, options(motion, false)),
        stiffness_(free_.stiffness()) {
    held_.factor(held_.stiffness(), factor_);
    if (std::isinf(medium.bulk_Pa)) {
      bulk_ = free_.system().volume_form({kPenaltyOverShear * medium.shear_Pa}, true);
    }
  }

  const PillarModel& model() const { return held_; }

  // Work of the field on the top per unit, weighted with (x/R)^power.
  Eigen::VectorXd top_load(int field, int power) const {
    const PillarMesh& mesh = held_.mesh();
    const double radius_m = top_radius_m();
    return held_.system().line_load(field, mesh.top_row, 0, mesh.pillar_columns, power) /
           std::pow(radius_m, power);
  }
  double top_radius_m() const { return radius_at_m(held_.geometry(), held_.geometry().length_m); }

  struct Answer {
    Eigen::VectorXd motion;
    Eigen::VectorXd base_forces;  // of the pillar on its base, on the unknowns of free_
  };
  Answer solve(const Eigen::VectorXd& load) const {
    Answer answer;
    Eigen::VectorXd source;
    answer.motion = factor_.solve(load, &source);
    const Eigen::VectorXd motion = on_free(answer.motion);
    answer.base_forces = -times(stiffness_, motion);
    // At nu = 0.5 the pressure is that of the iterated source, not of the motion.
    if (bulk_.size() > 0) {
      answer.base_forces -= times(bulk_, on_free(source) - motion);
    }
    return answer;
  }

  std::vector<int> foot_nodes() const {
    const PillarMesh& mesh = held_.mesh();
    return nodes_on_break(mesh.section, mesh.bond_row, 0, mesh.pillar_columns);
  }

  // The unknowns of the foot; and below the forces on them when one of them is moved by 1.
  std::vector<FootUnknown> foot_unknowns() const {
    const DofMap& dofs = free_.system().dofs();
    const std::vector<int> nodes = foot_nodes();
    std::vector<FootUnknown> unknowns;
    for (int field = 0; field < dofs.field_count(); ++field) {
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        const int dof = dofs.dof(field, nodes[i]);
        if (dof >= 0) unknowns.push_back({field, static_cast<int>(i), dof});
      }
    }
    return unknowns;
  }
  Eigen::MatrixXd foot_stiffness(const std::vector<FootUnknown>& unknowns) const {
    const auto count = static_cast<Eigen::Index>(unknowns.size());
    Eigen::MatrixXd stiffness(count, count);
    for (Eigen::Index column = 0; column < count; ++column) {
      const Eigen::VectorXd unit = Eigen::VectorXd::Unit(
          free_.system().dofs().count(), unknowns[static_cast<std::size_t>(column)].dof);
      const Eigen::VectorXd motion =
          unit + on_free(factor_.solve(on_held(-times(stiffness_, unit))));
      const Eigen::VectorXd forces = times(stiffness_, motion);
      for (Eigen::Index row = 0; row < count; ++row) {
        stiffness(row, column) = forces[unknowns[static_cast<std::size_t>(row)].dof];
      }
    }
    return stiffness;
  }

  // The base forces along one field as forces at points of the foot (see the header).
  Eigen::VectorXd at_points(const FootPoints& points, const Eigen::VectorXd& forces,
                            int field) const {
    const std::vector<int> nodes = foot_nodes();
    Eigen::VectorXd of_nodes = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(nodes.size()));
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const int dof = free_.system().dofs().dof(field, nodes[i]);
      if (dof >= 0) of_nodes[static_cast<Eigen::Index>(i)] = forces[dof];
    }
    return points.from_nodes() * of_nodes;
  }

 private:
  static ModelOptions options(Motion motion, bool fixed_bottom) {
    ModelOptions options;
    options.motion = motion;
    options.fixed_bottom = fixed_bottom;
    return options;
  }

  // Motions or forces on the unknowns that both models have.
  static Eigen::VectorXd carried(const PillarModel& from_model, const PillarModel& to_model,
                                 const Eigen::VectorXd& values) {
    const DofMap& from = from_model.system().dofs();
    const DofMap& to = to_model.system().dofs();
    Eigen::VectorXd there = Eigen::VectorXd::Zero(to.count());
    for (int node = 0; node < from_model.mesh().section.node_count(); ++node) {
      for (int field = 0; field < from.field_count(); ++field) {
        const int at = to.dof(field, node);
        if (at >= 0 && from.dof(field, node) >= 0) there[at] = values[from.dof(field, node)];
      }
    }
    return there;
  }
  Eigen::VectorXd on_free(const Eigen::VectorXd& held) const { return carried(held_, free_, held); }
  Eigen::VectorXd on_held(const Eigen::VectorXd& free) const { return carried(free_, held_, free); }

  PillarModel held_;
  PillarModel free_;
  SymmetricSparse stiffness_;
  SymmetricSparse bulk_;  // empty below nu = 0.5
  StiffnessFactor factor_;
};

}  // namespace

FootForces foot_forces(const PillarGeometry& geometry, const Medium& medium,
                       const Discretisation& mesh, double largest_k_1_m, const FilmTable* on_film) {
  require(!geometry.film, "the foot of a pillar is found on a rigid base, without a film");
  FootForces foot;
  const HeldPillar axial(geometry, medium, mesh, Motion::kLongitudinal);
  const FootPoints points(axial.model(), largest_k_1_m);
  foot.radius_m = points.radius_m();
  const Eigen::VectorXd pull = axial.top_load(1, 0);
  HeldPillar::Answer pressed = axial.solve(-pull);
  const auto on = [&](const HeldPillar& pillar, bool is_axial) {
    const std::vector<FootUnknown> unknowns = pillar.foot_unknowns();
    return FootOnFilm(*on_film, {points.radius_m(), points.from_nodes(), unknowns, is_axial},
                      pillar.foot_stiffness(unknowns));
  };
  if (on_film) on(axial, true).correct(pressed.base_forces);
  foot.pressure = {axial.at_points(points, pressed.base_forces, 0),
                   axial.at_points(points, pressed.base_forces, 1)};
  foot.sinking_m_Pa = -pull.dot(pressed.motion) / pull.sum();

  const HeldPillar sideways(geometry, medium, mesh, Motion::kLateral);
  const Eigen::VectorXd shear = sideways.top_load(1, 0);  // field b carries u_x
  const Eigen::VectorXd tilt = sideways.top_load(2, 1);
  HeldPillar::Answer sheared = sideways.solve(shear);
  HeldPillar::Answer tilted = sideways.solve(tilt);
  if (on_film) {
    const FootOnFilm corrected = on(sideways, false);
    corrected.correct(sheared.base_forces);
    corrected.correct(tilted.base_forces);
  }
  const auto at_points = [&](const HeldPillar::Answer& answer) -> FootForces::Sideways {
    return {sideways.at_points(points, answer.base_forces, 0),
            sideways.at_points(points, answer.base_forces, 1),
            sideways.at_points(points, answer.base_forces, 2)};
  };
  foot.shear = at_points(sheared);
  foot.tilt = at_points(tilted);
  // load.u is the work per area: shear on the mean of u_x, tilt on int u_z x/R dA, which is
  // pi R^3/4 times the mean tilt.
  const double R_m = sideways.top_radius_m();
  const double area_m2 = std::numbers::pi * R_m * R_m;
  const double moment_m3 = 0.25 * area_m2 * R_m;
  foot.sideways_by_shear_m_Pa = shear.dot(sheared.motion) / area_m2;
  foot.sideways_by_tilt_m_Pa = shear.dot(tilted.motion) / area_m2;
  foot.tilt_by_shear_1_Pa = tilt.dot(sheared.motion) / moment_m3;
  foot.tilt_by_tilt_1_Pa = tilt.dot(tilted.motion) / moment_m3;
  foot.unknowns = sideways.model().system().size();
  return foot;
}

AxialTransform transform(const FootForces::Axial& forces, const std::vector<double>& radius_m,
                         double k_1_m) {
  AxialTransform sum;
  for (std::size_t i = 0; i < radius_m.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    sum.t_z += forces.z[at] * ::j0(k_1_m * radius_m[i]);
    sum.tau_x -= forces.r[at] * ::j1(k_1_m * radius_m[i]);
  }
  return sum;
}

SidewaysTransform transform(const FootForces::Sideways& forces, const std::vector<double>& radius_m,
                            double k_1_m) {
  double a = 0.0;
  double b = 0.0;
  double w = 0.0;
  for (std::size_t i = 0; i < radius_m.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    const double x = k_1_m * radius_m[i];
    a += forces.a[at] * ::jn(2, x);
    b += forces.b[at] * ::j0(x);
    w += forces.w[at] * ::j1(x);
  }
  return {b - a, b + a, w};
}

}  // namespace viscard
