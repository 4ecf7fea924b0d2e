#include "models/pillar/system/kronecker_form.h"

#include <algorithm>

namespace viscard {

LineIntegrals::LineIntegrals(const LineMesh& line, int x_power, int inverse_powers) {
  for (int e = 0; e < line.element_count(); ++e) {
    auto& of_element = values_.emplace_back();
    for (int k = 0; k < inverse_powers; ++k) {
      for (int di = 0; di < 2; ++di) {
        for (int dj = 0; dj < 2; ++dj) {
          of_element[index(k, di, dj)] = line.integral(e, x_power - k, di, dj);
        }
      }
    }
  }
}

KroneckerForm::KroneckerForm(const Section& section, const Kinematics& kinematics,
                             const std::vector<OperatorRow>& rows,
                             const std::vector<Eigen::MatrixXd>& per_region)
    : fields_(kinematics.field_count),
      n1_(section.degree() + 1),
      in_x_(section.x(), kinematics.x_power, kinematics.x_power == 1 ? 3 : 1),
      in_z_(section.z(), 0, 1) {
  for (const Eigen::MatrixXd& D : per_region) {
    pairs_.push_back(D.size() == 0 ? std::vector<FieldPair>{}
                                   : field_pairs(rows, kinematics.measure * D, fields_));
  }
}

std::vector<KroneckerForm::FieldPair> KroneckerForm::field_pairs(
    const std::vector<OperatorRow>& rows, const Eigen::MatrixXd& D, int field_count) {
  std::vector<FieldPair> pairs(static_cast<std::size_t>(field_count * field_count));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t j = 0; j < rows.size(); ++j) {
      const double d = D(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
      if (d == 0.0) continue;
      for (const OperatorTerm& a : rows[i]) {
        for (const OperatorTerm& b : rows[j]) {
          auto& list = pairs[static_cast<std::size_t>(a.field * field_count + b.field)]
                           .by_dz[static_cast<std::size_t>(2 * a.dz + b.dz)];
          const int k = a.inverse_x + b.inverse_x;
          const auto same = std::find_if(list.begin(), list.end(), [&](const XTerm& t) {
            return t.inverse_x == k && t.dx_i == a.dx && t.dx_j == b.dx;
          });
          if (same != list.end()) {
            same->factor += d * a.factor * b.factor;
          } else {
            list.push_back({k, a.dx, b.dx, d * a.factor * b.factor});
          }
        }
      }
    }
  }
  return pairs;
}

}  // namespace viscard
