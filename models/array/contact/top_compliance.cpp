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
  TopOfHarmonic(const Section& section, int harmonic)
      : system_(section, kinematics(harmonic), dofs(section, kinematics(harmonic))),
        normal_(harmonic == 0 ? 1 : 2) {}

  // S_m on the nodes of the top that lie off the axis.
  Eigen::MatrixXd compliance(const Medium& medium) const {
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
    Eigen::MatrixXd forces = Eigen::MatrixXd::Zero(system_.size(), rings);
    for (int ring = 0; ring < rings; ++ring) forces(top_dof(ring), ring) = 1.0;
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
    for (int ring = 0; ring < rings; ++ring) areas[ring] = load[top_dof(ring)];
    return areas;
  }

 private:
  static Kinematics kinematics(int harmonic) {
    return harmonic == 0 ? kinematics_of(Motion::kLongitudinal) : fourier_kinematics(harmonic);
  }
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
  int top_dof(int ring) const {
    const Section& section = system_.section();
    return system_.dofs().dof(normal_, section.node(ring + 1, section.z().node_count() - 1));
  }

  DiscreteSystem system_;
  int normal_ = 1;  // field of u_z
};

bool is_straight(const PillarGeometry& pillar) {
  return !pillar.film && pillar.foot.width_m == 0.0 && pillar.tip.width_m == 0.0;
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

TopCompliance top_compliance(const PillarGeometry& pillar, const Medium& medium,
                             const TopFineness& fineness) {
  require(is_straight(pillar), "the top of a pillar is found for a straight pillar without a film");
  require(fineness.elements >= 2 && fineness.angles >= 4 && fineness.angles % 2 == 0,
          "the top of a pillar needs two elements and an even number of angles, four or more");
  const double radius_m = 0.5 * pillar.diameter_m;
  const int degree = condenses_pressure(medium) ? 3 : 2;
  const LineMesh across(graded_breaks(0.0, radius_m, fineness.elements, 1.0, true), degree);
  const std::vector<double> all_m = heights(radius_m, pillar.length_m, fineness.elements);
  TopCompliance top;
  top.angles = fineness.angles;
  top.radius_m.assign(across.nodes().begin() + 1, across.nodes().end());
  for (int harmonic = 0; harmonic <= fineness.angles / 2; ++harmonic) {
    const Section section(across, LineMesh(heights_that_move(all_m, radius_m, harmonic), degree),
                          [](double, double) { return 0; });
    const TopOfHarmonic one(section, harmonic);
    if (harmonic == 0) top.ring_area_m2 = one.ring_areas();
    top.harmonic_m_N.push_back(one.compliance(medium));
  }
  return top;
}

}  // namespace viscard
