#include "models/array/contact/top_compliance.h"

#include "models/maths/require.h"
#include "models/pillar/mesh/line_mesh.h"
#include "models/pillar/mesh/section.h"
#include "models/pillar/system/discrete_system.h"
#include "models/pillar/system/supernodal_factor.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace viscard {
namespace {

// Pressures of their own are condensed from this Poisson ratio on. Rubber is taken as nearly
// incompressible: at 0.49999 a top sinks by less than 1e-4 more than at 0.5.
constexpr double kMostPoisson = 0.49999;

// Elements as tall as wide at the top, then growing; layers at the foot for the singular rim there.
std::vector<double> heights(double radius_m, double length_m, int elements) {
  constexpr double kGrowth = 1.6;
  constexpr int kFootLayers = 3;
  std::vector<double> down = {0.0};
  double size_m = radius_m / elements;
  while (down.back() + 1.5 * size_m < length_m) {
    down.push_back(down.back() + size_m);
    size_m = std::min(kGrowth * size_m, 0.8 * radius_m);
  }
  std::vector<double> breaks = {0.0};
  const double foot_m = length_m - down.back();
  for (int layer = kFootLayers; layer > 0; --layer) {
    breaks.push_back(foot_m * std::pow(0.3, layer));
  }
  for (auto at = down.rbegin(); at != down.rend(); ++at) breaks.push_back(length_m - *at);
  return breaks;
}

// Those down to a depth below which nothing moves. A load that varies as cos(m theta) decays along the pillar as
// exp(-m z/R) or faster (its waves J_m(k r) need k R > m), so that what a rigid base at this depth reflects is
// exp(-24) of it; the whole pillar where it is shorter.
std::vector<double> heights_that_move(const std::vector<double>& heights_m, double radius_m,
                                      int harmonic) {
  constexpr double kDepth = 12.0;
  const double base_m = heights_m.back() - kDepth * radius_m / std::max(harmonic, 1);
  std::vector<double> moving;
  for (const double at_m : heights_m) {
    if (at_m <= base_m) moving.clear();
    moving.push_back(at_m);
  }
  return moving;
}

// Their space is two degrees lower, too coarse for elements of degree 2 (1 % at nu = 0.5).
bool condenses_pressure(const Medium& medium) {
  return medium.is_isotropic && medium.poisson_ratio >= kNearlyIncompressible;
}

class TopOfHarmonic {
 public:
  TopOfHarmonic(const Section& section, const Kinematics& kinematics)
      : system_(section, kinematics, dofs(section, kinematics)),
        normal_(kinematics.field_count - 1) {}

  // S_m on the nodes of the top that lie off the axis.
  Eigen::MatrixXd compliance(const Medium& medium) const { return compliance(medium, {normal_}); }
  // Motion of these fields under forces on them; the field is the slowest index.
  Eigen::MatrixXd compliance(const Medium& medium, const std::vector<int>& fields) const {
    const Section& section = system_.section();
    SymmetricSparse stiffness;
    if (condenses_pressure(medium)) {
      const double nu = std::min(medium.poisson_ratio, kMostPoisson);
      const double bulk_Pa = 2.0 * medium.shear_Pa * (1.0 + nu) / (3.0 * (1.0 - 2.0 * nu));
      stiffness = system_.form(system_.kinematics().strain, {medium.shear_Pa * deviatoric_form()});
      stiffness.coeffs() += system_.volume_form({bulk_Pa}, true).coeffs();
    } else {
      stiffness = system_.form(system_.kinematics().strain, {medium.stiffness_Pa});
    }
    SupernodalFactor factor;
    factor.analyse(stiffness);
    require(factor.factor(stiffness), "the stiffness of a pillar's top is singular");
    const int rings = section.x().node_count() - 1;
    Eigen::MatrixXd forces =
        Eigen::MatrixXd::Zero(system_.size(), rings * static_cast<Eigen::Index>(fields.size()));
    Eigen::Index column = 0;
    for (const int field : fields) {
      for (int ring = 0; ring < rings; ++ring) forces(top_dof(field, ring), column++) = 1.0;
    }
    const Eigen::MatrixXd half = factor.forward(forces);
    return half.transpose() * factor.pivots().cwiseInverse().asDiagonal() * half;
  }

  // int N_j r dr dtheta, m^2.
  Eigen::VectorXd ring_areas() const {
    const Section& section = system_.section();
    const Eigen::VectorXd load =
        system_.line_load(normal_, section.z().element_count(), 0, section.x().element_count());
    const int rings = section.x().node_count() - 1;
    Eigen::VectorXd areas(rings);
    for (int ring = 0; ring < rings; ++ring) areas[ring] = load[top_dof(normal_, ring)];
    return areas;
  }

 private:
  static DofMap dofs(const Section& section, const Kinematics& kinematics) {
    DofMap dofs(kinematics.field_count, section.node_count());
    for (int node = 0; node < section.node_count(); ++node) {
      if (section.node_z(node) == section.z().breaks().front()) {
        for (int field = 0; field < kinematics.field_count; ++field) dofs.fix(field, node);
      } else if (section.node_x(node) == 0.0) {
        for (const int field : kinematics.zero_on_axis) dofs.fix(field, node);
      }
    }
    dofs.number();
    return dofs;
  }
  int top_dof(int field, int ring) const {
    const Section& section = system_.section();
    return system_.dofs().dof(field, section.node(ring + 1, section.z().node_count() - 1));
  }

  DiscreteSystem system_;
  int normal_ = 1;  // field of u_z, the last
};

// The mesh of one pillar's top; its sections, by harmonic.
class TopMesh {
 public:
  TopMesh(const PillarGeometry& pillar, const Medium& medium, const TopFineness& fineness)
      : degree_(condenses_pressure(medium) ? 3 : 2),
        radius_m_(0.5 * pillar.diameter_m),
        across_(graded_breaks(0.0, radius_m_, fineness.elements, 1.0, true), degree_),
        heights_m_(heights(radius_m_, pillar.length_m, fineness.elements)) {}

  Section section(int harmonic) const {
    return {across_, LineMesh(heights_that_move(heights_m_, radius_m_, harmonic), degree_),
            [](double, double) { return 0; }};
  }
  std::vector<double> ring_radii_m() const {
    return {across_.nodes().begin() + 1, across_.nodes().end()};
  }

 private:
  int degree_;
  double radius_m_;
  LineMesh across_;
  std::vector<double> heights_m_;
};

Kinematics normal_kinematics(int harmonic) {
  return harmonic == 0 ? kinematics_of(Motion::kLongitudinal) : fourier_kinematics(harmonic);
}

bool is_straight(const PillarGeometry& pillar) {
  return !pillar.film && pillar.foot.width_m == 0.0 && pillar.tip.width_m == 0.0;
}

void check_top(const PillarGeometry& pillar, const TopFineness& fineness) {
  require(is_straight(pillar), "the top of a pillar is found for a straight pillar without a film");
  require(fineness.elements >= 2 && fineness.angles >= 4 && fineness.angles % 2 == 0,
          "the top of a pillar needs two elements and an even number of angles, four or more");
}

// C_m: u_r = (a + b)/2, u_theta = (a - b)/2 (eq. 12), and down is -w.
Eigen::MatrixXd in_directions(const Eigen::MatrixXd& of_fields) {
  const Eigen::Index n = of_fields.rows() / 3;
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(n, n);
  Eigen::MatrixXd turn = Eigen::MatrixXd::Zero(3 * n, 3 * n);
  turn.block(0, 0, n, n) = 0.5 * one;
  turn.block(0, n, n, n) = 0.5 * one;
  turn.block(n, 0, n, n) = 0.5 * one;
  turn.block(n, n, n, n) = -0.5 * one;
  turn.block(2 * n, 2 * n, n, n) = -one;
  return turn * of_fields * turn.transpose();
}

// C_0: along r and down by the longitudinal family, theta by torsion.
Eigen::MatrixXd axial_directions(const Eigen::MatrixXd& longitudinal,
                                 const Eigen::MatrixXd& torsion) {
  const Eigen::Index n = torsion.rows();
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(3 * n, 3 * n);
  all.block(0, 0, n, n) = longitudinal.topLeftCorner(n, n);
  all.block(2 * n, 2 * n, n, n) = longitudinal.bottomRightCorner(n, n);
  all.block(0, 2 * n, n, n) = -longitudinal.topRightCorner(n, n);
  all.block(2 * n, 0, n, n) = -longitudinal.bottomLeftCorner(n, n);
  all.block(n, n, n, n) = torsion;
  return all;
}

// Of one ring-wise top: a unit force down, along x, and a unit moment; and the rigid motions that do their work.
struct RigidTop {
  Eigen::VectorXd pressure, shear, tilt;  // forces, C_0 and C_1
  Eigen::VectorXd sink, move, turn;       // motions
};
RigidTop rigid_top(const std::vector<double>& radius_m, const Eigen::VectorXd& area_m2) {
  const Eigen::Index n = area_m2.size();
  const Eigen::Map<const Eigen::VectorXd> r(radius_m.data(), n);
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(3 * n);
  RigidTop top{zero, zero, zero, zero, zero, zero};
  const double all_m2 = area_m2.sum();
  const Eigen::VectorXd lever = area_m2.cwiseProduct(r);
  top.pressure.tail(n) = area_m2 / all_m2;
  top.shear.head(n) = 0.5 * area_m2 / all_m2;
  top.shear.segment(n, n) = -0.5 * area_m2 / all_m2;
  top.tilt.tail(n) = lever / lever.dot(r);
  top.sink.tail(n).setOnes();
  top.move.head(n).setOnes();
  top.move.segment(n, n).setConstant(-1.0);
  top.turn.tail(n) = r;
  return top;
}

}  // namespace

double TopCompliance::sinking_m_N() const {
  const double area_m2 = ring_area_m2.sum();
  return ring_area_m2.dot(harmonic_m_N[0] * ring_area_m2) / (area_m2 * area_m2);
}

double TopCompliance::turning_rad_Nm() const {
  const Eigen::Map<const Eigen::VectorXd> r(radius_m.data(), ring_area_m2.size());
  const Eigen::VectorXd lever = ring_area_m2.cwiseProduct(r);
  const double moment = 0.5 * lever.dot(r);  // of the traction r cos(theta)
  return 0.25 * lever.dot(harmonic_m_N[1] * lever) / (moment * moment);
}

void TopCompliance::adjust(double sinking, double turning) {
  const Eigen::Map<const Eigen::VectorXd> r(radius_m.data(), ring_area_m2.size());
  harmonic_m_N[0].array() += sinking - sinking_m_N();
  const double more = turning - turning_rad_Nm();
  harmonic_m_N[1] += more * (r * r.transpose());
}

StickingCompliance::Means StickingCompliance::means() const {
  const RigidTop top = rigid_top(radius_m, ring_area_m2);
  const Eigen::MatrixXd& C_1 = harmonic_m_N[1];
  return {.sinking_m_N = top.pressure.dot(harmonic_m_N[0] * top.pressure),
          .sideways_m_N = top.shear.dot(C_1 * top.shear),
          .turning_rad_N = top.tilt.dot(C_1 * top.shear),
          .turning_rad_Nm = top.tilt.dot(C_1 * top.tilt)};
}

void StickingCompliance::adjust(const Means& wanted) {
  const RigidTop top = rigid_top(radius_m, ring_area_m2);
  const Means is = means();
  harmonic_m_N[0] += (wanted.sinking_m_N - is.sinking_m_N) * (top.sink * top.sink.transpose());
  const Eigen::MatrixXd mixed = top.move * top.turn.transpose();
  harmonic_m_N[1] +=
      (wanted.sideways_m_N - is.sideways_m_N) * (top.move * top.move.transpose()) +
      (wanted.turning_rad_N - is.turning_rad_N) * (mixed + mixed.transpose()) +
      (wanted.turning_rad_Nm - is.turning_rad_Nm) * (top.turn * top.turn.transpose());
}

TopCompliance top_compliance(const PillarGeometry& pillar, const Medium& medium,
                             const TopFineness& fineness) {
  check_top(pillar, fineness);
  const TopMesh mesh(pillar, medium, fineness);
  TopCompliance top;
  top.angles = fineness.angles;
  top.radius_m = mesh.ring_radii_m();
  const double shear_Pa = medium.stiffness_Pa(3, 3), long_Pa = medium.stiffness_Pa(0, 0);
  top.plane_modulus_Pa = medium.is_isotropic ? 2.0 * medium.shear_Pa / (1.0 - medium.poisson_ratio)
                                             : 4.0 * shear_Pa * (long_Pa - shear_Pa) / long_Pa;
  for (int harmonic = 0; harmonic <= fineness.angles / 2; ++harmonic) {
    const Section section = mesh.section(harmonic);
    const TopOfHarmonic one(section, normal_kinematics(harmonic));
    if (harmonic == 0) top.ring_area_m2 = one.ring_areas();
    top.harmonic_m_N.push_back(one.compliance(medium));
  }
  return top;
}

StickingCompliance sticking_compliance(const PillarGeometry& pillar, const Medium& medium,
                                       const TopFineness& fineness) {
  check_top(pillar, fineness);
  const TopMesh mesh(pillar, medium, fineness);
  StickingCompliance top;
  top.angles = fineness.angles;
  top.radius_m = mesh.ring_radii_m();
  for (int harmonic = 0; harmonic <= fineness.angles / 2; ++harmonic) {
    const Section section = mesh.section(harmonic);
    const TopOfHarmonic one(section, normal_kinematics(harmonic));
    if (harmonic > 0) {
      top.harmonic_m_N.push_back(in_directions(one.compliance(medium, {0, 1, 2})));
      continue;
    }
    top.ring_area_m2 = one.ring_areas();
    const TopOfHarmonic twisted(section, kinematics_of(Motion::kTorsion));
    top.harmonic_m_N.push_back(
        axial_directions(one.compliance(medium, {0, 1}), twisted.compliance(medium)));
  }
  return top;
}

}  // namespace viscard
