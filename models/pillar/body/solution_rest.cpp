#include "models/pillar/body/solution_rest.h"

#include "models/maths/dense.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace viscard {
namespace {

// Matrix that removes all polynomials above the degree `kept` from nodal values on one line, in the
// basis 1, x, L_k - L_(k-2), whose derivatives are orthogonal. Source: Szabo & Babuska, Finite
// Element Analysis (1991), ch. 6.
Eigen::MatrixXd truncation(int degree, int kept) {
  Eigen::MatrixXd basis = legendre_values(degree, lobatto_points(degree));
  for (int k = degree; k >= 2; --k) basis.col(k) -= basis.col(k - 2);
  const Eigen::MatrixXd inverse =
      LuFactor(basis).solve(Eigen::MatrixXd(Eigen::MatrixXd::Identity(degree + 1, degree + 1)));
  return basis.leftCols(kept + 1) * inverse.topRows(kept + 1);
}

// The form int x^power (grad values)(grad others) over an element applied to nodal values, along x
// down and along z across.
struct GradientForm {
  Eigen::MatrixXd x00, x11, z00, z11;
  Eigen::MatrixXd operator()(const Eigen::MatrixXd& values) const {
    return x11 * values * z00 + x00 * values * z11;
  }
};

// Ratio of the missing energy above degree p to the energy of degrees p and p - 1, if the energy of
// degree q is proportional to 1/q^m and the energies of p - 2 and p - 3 are known too.
double rest_over_high(double high, double low, int p) {
  constexpr double kSlowest = 2.5;  // the edge of an electrode has m = 4 lambda + 1 = 3
  if (!(high > 0.0)) return 0.0;
  const double fit = std::log(low / high) / std::log((p - 0.5) / (p - 2.5));
  const double m = std::max(fit, kSlowest);
  return 1.0 / (std::pow(p / (p - 2.0), m - 1.0) - 1.0);
}

}  // namespace

SolutionRest::SolutionRest(const PillarModel& model, const Eigen::VectorXd& solution)
    : degree_(model.mesh().section.degree()) {
  if (degree_ < kLeastDegree) return;
  const Section& section = model.mesh().section;
  const Kinematics& k = model.system().kinematics();
  const Eigen::Index n1 = degree_ + 1;
  const Eigen::MatrixXd keep_low = truncation(degree_, degree_ - 2);
  const Eigen::MatrixXd keep_lower = truncation(degree_, degree_ - 4);
  Eigen::MatrixXd values(n1, n1);
  for (const SectionElement& e : section.elements()) {
    const GradientForm form{section.x().integral(e.column, k.x_power, 0, 0),
                            section.x().integral(e.column, k.x_power, 1, 1),
                            section.z().integral(e.row, 0, 0, 0),
                            section.z().integral(e.row, 0, 1, 1)};
    Shells shells;
    shells.part = shells.form_of_part = Eigen::VectorXd::Zero(k.field_count * n1 * n1);
    for (int field = 0; field < k.field_count; ++field) {
      // In the pillar only the nodes of the bond have a potential, which belongs to the film.
      if (field == k.potential_field && e.region != kFilmRegion) continue;
      for (Eigen::Index i = 0; i < n1 * n1; ++i) {
        const int dof = model.system().dofs().dof(field, e.nodes[static_cast<std::size_t>(i)]);
        values(i % n1, i / n1) = dof < 0 ? 0.0 : solution[dof];
      }
      if (values.isZero(0.0)) continue;
      const Eigen::MatrixXd low = keep_low * values * keep_low.transpose();
      const Eigen::MatrixXd lower = keep_lower * values * keep_lower.transpose();
      const double factor = k.measure * model.mean_modulus_Pa(e.region);
      const Eigen::MatrixXd high_part = values - low;
      const Eigen::MatrixXd low_part = low - lower;
      const Eigen::MatrixXd of_high = factor * form(high_part);
      shells.high += of_high.cwiseProduct(high_part).sum();
      shells.low += factor * form(low_part).cwiseProduct(low_part).sum();
      shells.part.segment(field * n1 * n1, n1 * n1) = high_part.reshaped();
      shells.form_of_part.segment(field * n1 * n1, n1 * n1) = of_high.reshaped();
    }
    elements_.push_back(std::move(shells));
  }
}

double missing_work(const SolutionRest& u, const SolutionRest& z) {
  double sum = 0.0;
  for (std::size_t e = 0; e < u.elements_.size(); ++e) {
    const double high = std::sqrt(u.elements_[e].high * z.elements_[e].high);
    const double low = std::sqrt(u.elements_[e].low * z.elements_[e].low);
    sum += std::abs(u.elements_[e].part.dot(z.elements_[e].form_of_part)) *
           rest_over_high(high, low, u.degree_);
  }
  return sum;
}

double missing_share(const SolutionRest& u, const SolutionRest& z, double work) {
  return work == 0.0 ? 0.0 : missing_work(u, z) / std::abs(work);
}

}  // namespace viscard
