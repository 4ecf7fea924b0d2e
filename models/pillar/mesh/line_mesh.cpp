#include "models/pillar/mesh/line_mesh.h"

#include "models/maths/gauss_legendre.h"
#include "models/maths/require.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

namespace viscard {

std::vector<double> lobatto_points(int degree) {
  require_value(degree >= 1 && degree <= 20, "element degree", degree, "", "from 1 to 20");
  std::vector<double> points;
  for (int i = 0; i <= degree; ++i) {
    // Newton's method for (1 - x^2) P_p'(x) = 0 from the Chebyshev-Lobatto points with fixed ends.
    double x = -std::cos(std::numbers::pi * i / degree);
    for (int iteration = 0; iteration < 100; ++iteration) {
      const auto [value, previous] = legendre_pair(degree, x);
      const double step = (x * value - previous) / ((degree + 1.0) * value);
      x -= step;
      if (std::abs(step) < 1e-16) break;
    }
    points.push_back(0.5 * (1.0 + x));
  }
  points.front() = 0.0;
  points.back() = 1.0;
  return points;
}

BasisValues lagrange_basis(const std::vector<double>& nodes, const std::vector<double>& points) {
  const std::size_t n = nodes.size();
  BasisValues basis{Eigen::MatrixXd(points.size(), n), Eigen::MatrixXd(points.size(), n)};
  for (std::size_t k = 0; k < points.size(); ++k) {
    for (std::size_t j = 0; j < n; ++j) {
      double value = 1.0;
      double derivative = 0.0;
      for (std::size_t m = 0; m < n; ++m) {
        if (m == j) continue;
        const double scale = 1.0 / (nodes[j] - nodes[m]);
        derivative = (derivative * (points[k] - nodes[m]) + value) * scale;  // product rule
        value *= (points[k] - nodes[m]) * scale;
      }
      basis.value(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(j)) = value;
      basis.derivative(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(j)) = derivative;
    }
  }
  return basis;
}

Eigen::MatrixXd legendre_values(int degree, const std::vector<double>& points) {
  Eigen::MatrixXd values(static_cast<Eigen::Index>(points.size()), degree + 1);
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    const double x = 2.0 * points[k] - 1.0;
    values(row, 0) = 1.0;
    if (degree > 0) values(row, 1) = x;
    for (int n = 2; n <= degree; ++n) {
      values(row, n) =
          ((2.0 * n - 1.0) * x * values(row, n - 1) - (n - 1.0) * values(row, n - 2)) / n;
    }
  }
  return values;
}

std::vector<double> graded_breaks(double a, double b, int n, double ratio, bool toward_end) {
  require(n >= 1 && ratio > 0.0 && ratio <= 1.0,
          "grading needs at least one element and a ratio in (0, 1]");
  std::vector<double> breaks;
  for (int i = 0; i <= n; ++i) {
    const int k = toward_end ? i : n - i;
    // Fraction of the length, from the coarse end; a ratio of 1 means equal elements.
    const double share = k == 0         ? 0.0
                         : k == n       ? 1.0
                         : ratio == 1.0 ? static_cast<double>(k) / n
                                        : 1.0 - std::pow(ratio, k);
    breaks.push_back(toward_end ? a + (b - a) * share : b - (b - a) * share);
  }
  return breaks;
}

void append_breaks(std::vector<double>& breaks, const std::vector<double>& more) {
  const double same = more.empty() ? 0.0 : 1e-9 * std::abs(more.back() - more.front());
  for (const double x : more) {
    if (breaks.empty() || x > breaks.back() + same) breaks.push_back(x);
  }
}

bool insert_break(std::vector<double>& breaks, double at) {
  const double near = 1e-9 * (breaks.back() - breaks.front());
  const bool is_there =
      std::any_of(breaks.begin(), breaks.end(), [&](double b) { return std::abs(b - at) <= near; });
  if (!is_there) breaks.insert(std::upper_bound(breaks.begin(), breaks.end(), at), at);
  return !is_there;
}

LineMesh::LineMesh(std::vector<double> breaks, int degree)
    : degree_(degree), breaks_(std::move(breaks)), reference_nodes_(lobatto_points(degree)) {
  require(breaks_.size() >= 2, "a line of elements needs two breaks");
  for (std::size_t i = 1; i < breaks_.size(); ++i) {
    if (breaks_[i] > breaks_[i - 1]) continue;
    throw std::invalid_argument("element " + std::to_string(i) + " from " +
                                text_of(breaks_[i - 1]) + " to " + text_of(breaks_[i]) +
                                " m has no positive length");
  }
  // p + 1 points integrate r N N exactly; three more serve the 1/r of elements off the axis.
  const QuadratureRule gauss = gauss_legendre(degree + 4);
  reference_points_ = gauss.points;
  reference_weights_ = Eigen::Map<const Eigen::VectorXd>(
      gauss.weights.data(), static_cast<Eigen::Index>(gauss.weights.size()));
  reference_basis_ = lagrange_basis(reference_nodes_, reference_points_);
  for (int e = 0; e < element_count(); ++e) {
    for (int i = 0; i < degree_; ++i) {
      nodes_.push_back(breaks_[static_cast<std::size_t>(e)] +
                       length(e) * reference_nodes_[static_cast<std::size_t>(i)]);
    }
  }
  nodes_.push_back(breaks_.back());
}

double LineMesh::length(int element) const {
  const auto e = static_cast<std::size_t>(element);
  return breaks_[e + 1] - breaks_[e];
}

Eigen::MatrixXd LineMesh::weighted(int element, int power, const Eigen::MatrixXd& left,
                                   const Eigen::MatrixXd& right) const {
  Eigen::VectorXd weight = reference_weights_ * length(element);
  for (Eigen::Index k = 0; power != 0 && k < weight.size(); ++k) {
    const double x = breaks_[static_cast<std::size_t>(element)] +
                     length(element) * reference_points_[static_cast<std::size_t>(k)];
    weight[k] *= power == 1 ? x : std::pow(x, power);
  }
  return left.transpose() * weight.asDiagonal() * right;
}

Eigen::MatrixXd LineMesh::integral(int element, int power, int di, int dj) const {
  const auto basis = [this](int d) -> const Eigen::MatrixXd& {
    return d == 0 ? reference_basis_.value : reference_basis_.derivative;
  };
  return weighted(element, power, basis(di), basis(dj)) / std::pow(length(element), di + dj);
}

Eigen::MatrixXd LineMesh::legendre_integral(int element, int power, int q, int dj) const {
  return weighted(element, power, legendre_values(q, reference_points_),
                  dj == 0 ? reference_basis_.value : reference_basis_.derivative) /
         std::pow(length(element), dj);
}

Eigen::MatrixXd LineMesh::legendre_mass(int element, int power, int q) const {
  const Eigen::MatrixXd values = legendre_values(q, reference_points_);
  return weighted(element, power, values, values);
}

LineMesh::ElementRule LineMesh::rule(int element) const {
  ElementRule rule;
  rule.x.resize(reference_weights_.size());
  for (Eigen::Index k = 0; k < rule.x.size(); ++k) {
    rule.x[k] = breaks_[static_cast<std::size_t>(element)] +
                length(element) * reference_points_[static_cast<std::size_t>(k)];
  }
  rule.weight = reference_weights_ * length(element);
  rule.value = reference_basis_.value;
  rule.derivative = reference_basis_.derivative / length(element);
  return rule;
}

int LineMesh::element_at(double x, bool prefer_left) const {
  const auto it = prefer_left ? std::lower_bound(breaks_.begin(), breaks_.end(), x)
                              : std::upper_bound(breaks_.begin(), breaks_.end(), x);
  return std::clamp(static_cast<int>(it - breaks_.begin()) - 1, 0, element_count() - 1);
}

BasisValues LineMesh::basis_at(int element, double x) const {
  BasisValues basis = lagrange_basis(
      reference_nodes_, {(x - breaks_[static_cast<std::size_t>(element)]) / length(element)});
  basis.derivative /= length(element);
  return basis;
}

}  // namespace viscard
