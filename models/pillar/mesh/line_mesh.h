#pragma once

#include <Eigen/Core>

#include <vector>

namespace viscard {

// Points 0 = x_0 < ... < x_p = 1 of the Gauss-Lobatto rule. Lagrange polynomials of degree p
// through them stay well conditioned. Source: Abramowitz & Stegun (1964), 25.4.32. Throws
// std::invalid_argument for a degree outside 1 to 20.
std::vector<double> lobatto_points(int degree);

// Lagrange polynomials through `nodes`, and their derivatives, at `points`: points x nodes.
struct BasisValues {
  Eigen::MatrixXd value;
  Eigen::MatrixXd derivative;
};
BasisValues lagrange_basis(const std::vector<double>& nodes, const std::vector<double>& points);

// Legendre polynomials of degree 0 to `degree` on (0, 1): points x (degree + 1).
Eigen::MatrixXd legendre_values(int degree, const std::vector<double>& points);

// Geometric grading: breaks from a to b of n >= 1 elements whose size shrinks by `ratio` toward b
// (toward a if toward_end is false).
std::vector<double> graded_breaks(double a, double b, int n, double ratio, bool toward_end);

// Appends those of `more` to `breaks` that lie beyond the last one, m.
void append_breaks(std::vector<double>& breaks, const std::vector<double>& more);
// Inserts a break `at` that place among the breaks (m) and returns true, unless one is there already.
bool insert_break(std::vector<double>& breaks, double at);

// Elements of degree p on the intervals between breaks: one direction of a tensor-product mesh.
// Nodes are numbered along the line, p per element and one at the end.
class LineMesh {
 public:
  // Throws std::invalid_argument unless there are at least two breaks and they ascend strictly.
  LineMesh(std::vector<double> breaks, int degree);

  int degree() const { return degree_; }
  int element_count() const { return static_cast<int>(breaks_.size()) - 1; }
  int node_count() const { return element_count() * degree_ + 1; }
  const std::vector<double>& breaks() const { return breaks_; }
  const std::vector<double>& nodes() const { return nodes_; }
  double length(int element) const;  // of an element, m

  // int x^power N_i^(di) N_j^(dj) dx over one element, (p + 1) x (p + 1). Exact for power >= 0. For
  // power -1 it is exact if both functions vanish at x = 0, and correct to rounding if the element
  // lies further from 0 than its own length.
  Eigen::MatrixXd integral(int element, int power, int di, int dj) const;
  // int x^power L_k N_j^(dj) dx with Legendre polynomials L_0 to L_q, (q + 1) x (p + 1).
  Eigen::MatrixXd legendre_integral(int element, int power, int q, int dj) const;
  // int x^power L_k L_l dx, (q + 1) x (q + 1).
  Eigen::MatrixXd legendre_mass(int element, int power, int q) const;

  // Quadrature points of one element, their weights (including the length) and the basis there.
  struct ElementRule {
    Eigen::VectorXd x;
    Eigen::VectorXd weight;
    Eigen::MatrixXd value;       // points x (p + 1)
    Eigen::MatrixXd derivative;  // per m
  };
  // The rule of an element.
  ElementRule rule(int element) const;

  // Element that contains x. At a break: the one before it if prefer_left, else the one after it.
  int element_at(double x, bool prefer_left) const;
  // Basis and derivative of one element at x: row vectors of p + 1.
  BasisValues basis_at(int element, double x) const;

 private:
  Eigen::MatrixXd weighted(int element, int power, const Eigen::MatrixXd& left,
                           const Eigen::MatrixXd& right) const;

  int degree_;
  std::vector<double> breaks_;
  std::vector<double> nodes_;
  std::vector<double> reference_nodes_;   // on [0, 1]
  std::vector<double> reference_points_;  // Gauss points on (0, 1)
  Eigen::VectorXd reference_weights_;
  BasisValues reference_basis_;
};

}  // namespace viscard
