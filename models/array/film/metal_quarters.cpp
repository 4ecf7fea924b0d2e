#include "models/array/film/metal_quarters.h"

#include "models/array/film/disc_charge.h"
#include "models/maths/bessel_orders.h"
#include "models/maths/dense.h"
#include "models/maths/gauss_legendre.h"
#include "models/maths/require.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace viscard {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

constexpr double kPi = std::numbers::pi;
constexpr double kGrading =
    3.0;  // cells shrink toward each edge as (i/n)^3, where the charge is singular
constexpr double kOrder = 2.6;   // of the answers in the number of cells, measured (README)
constexpr double kChord = 0.06;  // rad of an arc per straight piece
constexpr double kNear = 2.0;    // times the sizes of two cells: closer ones are integrated
constexpr double kTableStep =
    1.0 / 24;                 // of the table of added potentials, over the film's thickness
constexpr int kPatterns = 4;  // even or odd in x and in y: 1 for odd in x, 2 for odd in y

double sign_of(int pattern, int quarter) {
  const bool is_left = quarter == 1 || quarter == 2, is_low = quarter >= 2;
  return ((pattern & 1) != 0 && is_left) != ((pattern & 2) != 0 && is_low) ? -1.0 : 1.0;
}

int pattern_of(const DiscFunction& f) {
  const bool is_odd = f.order % 2 != 0;
  return (is_odd != f.is_sine ? 1 : 0) + (f.is_sine ? 2 : 0);
}

// A straight-sided piece of the quarter (+,+).
struct Cell {
  std::vector<Vector2d> corners;  // counter-clockwise
  double area = 0.0, size = 0.0;
  Vector2d middle;
  Matrix2d spread;  // mean of (x - middle)(x - middle)^T
  std::vector<Vector2d> points;
  std::vector<double> weights;  // of the mean over the cell
};

double graded(double t) {
  return t < 0.5 ? 0.5 * std::pow(2.0 * t, kGrading)
                 : 1.0 - 0.5 * std::pow(2.0 - 2.0 * t, kGrading);
}

void set_moments(Cell& cell) {
  const Vector2d origin = cell.corners.front();
  Vector2d middle = Vector2d::Zero();
  Matrix2d second = Matrix2d::Zero();
  for (std::size_t i = 1; i + 1 < cell.corners.size(); ++i) {
    const Vector2d a = cell.corners[i] - origin, b = cell.corners[i + 1] - origin;
    const double area = 0.5 * (a.x() * b.y() - a.y() * b.x());
    cell.area += area;
    middle += area / 3.0 * (a + b);
    second += area / 12.0 * ((a + b) * (a + b).transpose() + a * a.transpose() + b * b.transpose());
  }
  middle /= cell.area;
  cell.spread = second / cell.area - middle * middle.transpose();
  cell.middle = origin + middle;
  for (const Vector2d& one : cell.corners) {
    cell.size = std::max(cell.size, (one - cell.middle).norm());
  }
}

// The quarter (+,+) of a disc of radius 1 in rays from its inner corner.
std::vector<Cell> cells_of(double gap, int n, double coarsest) {
  const Vector2d corner(0.5 * gap, 0.5 * gap);
  const auto length = [&](double angle) {
    const double along = corner.x() * (std::cos(angle) + std::sin(angle));
    return -along + std::sqrt(along * along + 1.0 - corner.squaredNorm());
  };
  const auto at = [&](double share, double angle) -> Vector2d {
    return corner + share * length(angle) * Vector2d(std::cos(angle), std::sin(angle));
  };
  std::vector<Cell> cells;
  for (int j = 0; j < n; ++j) {
    const double from = 0.5 * kPi * graded(static_cast<double>(j) / n);
    const double turn = 0.5 * kPi * graded((j + 1.0) / n) - from;
    const int chords = std::max(1, static_cast<int>(std::ceil(turn / kChord)));
    // Straight pieces that enclose as much as the arc does: the length is scaled by about 1 + turn^2/12.
    const double scale = 1.0 + std::pow(turn / chords, 2) / 12.0;
    for (int i = 0; i < n; ++i) {
      const double inner = graded(static_cast<double>(i) / n), outer = graded((i + 1.0) / n);
      Cell cell;
      for (int k = 0; k <= chords; ++k)
        cell.corners.push_back(at(scale * outer, from + turn * k / chords));
      for (int k = chords; k >= (i == 0 ? chords : 0); --k)
        cell.corners.push_back(at(scale * inner, from + turn * k / chords));
      set_moments(cell);
      const QuadratureRule rule = gauss_legendre(2 + static_cast<int>(2.0 * cell.size / coarsest));
      double sum = 0.0;
      for (std::size_t a = 0; a < rule.points.size(); ++a) {
        for (std::size_t b = 0; b < rule.points.size(); ++b) {
          const double share = inner + (outer - inner) * rule.points[a];
          const double angle = from + turn * rule.points[b];
          cell.points.push_back(at(share, angle));
          cell.weights.push_back(rule.weights[a] * rule.weights[b] * share *
                                 std::pow(length(angle), 2));
          sum += cell.weights.back();
        }
      }
      for (double& one : cell.weights) one /= sum;
      cells.push_back(std::move(cell));
    }
  }
  return cells;
}

// Mean of 1/r over a cell, from a point in its plane: the sum over the sides of their distance times
// int ds/r. Wilton et al., IEEE Trans. Antennas Propag. 32 (1984) 276.
double mean_inverse_distance(const Cell& cell, const Vector2d& from) {
  double sum = 0.0;
  for (std::size_t i = 0; i < cell.corners.size(); ++i) {
    const Vector2d a = cell.corners[i] - from;
    const Vector2d b = cell.corners[i + 1 < cell.corners.size() ? i + 1 : 0] - from;
    const double side = (b - a).norm();
    if (side == 0.0) continue;
    const Vector2d along = (b - a) / side;
    const double away = a.x() * along.y() - a.y() * along.x();
    if (std::abs(away) < 1e-14 * side) continue;
    const double to_a = a.dot(along), to_b = b.dot(along);
    const double ratio = to_a + to_b < 0.0 ? (a.norm() - to_a) / (b.norm() - to_b)
                                           : (b.norm() + to_b) / (a.norm() + to_a);
    sum += away * std::log(ratio);
  }
  return sum / cell.area;
}

Vector2d mirrored(const Vector2d& point, int mirror) {
  return {(mirror & 1) != 0 ? -point.x() : point.x(), (mirror & 2) != 0 ? -point.y() : point.y()};
}

// Mean of 1/r between the points of one cell and those of the mirror image of another.
double between(const Cell& one, const Cell& other, int mirror) {
  const Vector2d way = mirrored(one.middle, mirror) - other.middle;
  const double square = way.squaredNorm(), sizes = one.size + other.size;
  if (square > kNear * kNear * sizes * sizes) {
    // The first term of the cells' widths, which is alike in the mirror but for the sign of xy.
    Matrix2d spread = one.spread;
    if (mirror == 1 || mirror == 2) spread(0, 1) = spread(1, 0) = -spread(0, 1);
    spread += other.spread;
    const double distance = std::sqrt(square);
    return (1.0 + 0.5 * (3.0 * way.dot(spread * way) / square - spread.trace()) / square) /
           distance;
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < one.points.size(); ++i) {
    sum += 0.5 * one.weights[i] * mean_inverse_distance(other, mirrored(one.points[i], mirror));
  }
  for (std::size_t j = 0; j < other.points.size(); ++j) {
    sum += 0.5 * other.weights[j] * mean_inverse_distance(one, mirrored(other.points[j], mirror));
  }
  return sum;
}

// The same of a smooth function of the distance, exact to the second order of the cells' widths.
template <typename Smooth>
double mean_between(const Cell& one, const Cell& other, int mirror, const Smooth& smooth) {
  const Vector2d from = mirrored(one.middle, mirror), to = mirrored(other.middle, mirror);
  double mean = -smooth((from - other.middle).norm());
  for (std::size_t i = 0; i < one.points.size(); ++i) {
    mean += one.weights[i] * smooth((one.points[i] - to).norm());
  }
  for (std::size_t j = 0; j < other.points.size(); ++j) {
    mean += other.weights[j] * smooth((other.points[j] - from).norm());
  }
  return mean;
}

// All polynomials at a point of the disc of radius 1: R_n^m(r) = r^m P_l^(0,m)(2 r^2 - 1), n = m + 2 l, by
// the recurrence of the Jacobi polynomials: Abramowitz & Stegun (1964), 22.7.1.
Eigen::VectorXd values_at(const std::vector<DiscFunction>& functions, const Vector2d& point) {
  const double r = point.norm(), x = 2.0 * r * r - 1.0, angle = std::atan2(point.y(), point.x());
  Eigen::VectorXd values(static_cast<Eigen::Index>(functions.size()));
  Eigen::Index at = 0;
  for (const DiscFunction& one : functions) {
    const int m = one.order;
    double before = 0.0, now = 1.0;
    for (int l = 1; l <= (one.degree - m) / 2; ++l) {
      const double s = 2.0 * l + m;
      const double next =
          l == 1 ? 1.0 + 0.5 * (m + 2.0) * (x - 1.0)
                 : ((s - 1.0) * (s * (s - 2.0) * x - static_cast<double>(m) * m) * now -
                    2.0 * (l - 1.0) * (l + m - 1.0) * s * before) /
                       (2.0 * l * (l + m) * (s - 2.0));
      before = now;
      now = next;
    }
    values[at++] = std::pow(r, m) * now * (one.is_sine ? std::sin(m * angle) : std::cos(m * angle));
  }
  return values;
}

std::vector<DiscFunction> functions_to(int degree) {
  std::vector<DiscFunction> functions;
  for (int n = 0; n <= degree; ++n) {
    for (int m = n % 2; m <= n; m += 2) {
      functions.push_back({n, m, false});
      if (m > 0) functions.push_back({n, m, true});
    }
  }
  return functions;
}

// Points and weights of the mean over the disc of radius 1 that integrate products of polynomials exactly.
struct DiscRule {
  std::vector<Vector2d> points;
  std::vector<double> weights;
};
DiscRule disc_rule(int degree) {
  const QuadratureRule radial = gauss_legendre(degree / 2 + 1);  // in r^2
  const int angles = 4 * (degree / 2 + 1);
  DiscRule rule;
  for (std::size_t i = 0; i < radial.points.size(); ++i) {
    for (int j = 0; j < angles; ++j) {
      const double r = std::sqrt(radial.points[i]), angle = 2.0 * kPi * (j + 0.5) / angles;
      rule.points.emplace_back(r * std::cos(angle), r * std::sin(angle));
      rule.weights.push_back(radial.weights[i] / angles);
    }
  }
  return rule;
}

Eigen::MatrixXd amplitudes_at(const std::vector<DiscFunction>& functions, const DiscRule& rule) {
  Eigen::MatrixXd amplitudes(static_cast<Eigen::Index>(functions.size()),
                             static_cast<Eigen::Index>(rule.points.size()));
  for (std::size_t p = 0; p < rule.points.size(); ++p) {
    amplitudes.col(static_cast<Eigen::Index>(p)) =
        rule.weights[p] * values_at(functions, rule.points[p]);
  }
  for (std::size_t f = 0; f < functions.size(); ++f) {
    amplitudes.row(static_cast<Eigen::Index>(f)) *=
        (functions[f].order == 0 ? 1.0 : 2.0) * (functions[f].degree + 1.0);
  }
  return amplitudes;
}

// The quarters on one mesh of cells, lengths over the radius and potentials times it.
struct ChargedMesh {
  Eigen::Matrix4d potentials;
  Eigen::MatrixXd readings, induced;
};

ChargedMesh charges_on(const std::vector<Cell>& cells, const std::vector<DiscFunction>& functions,
                       const PointCharge& charge, double radius_m) {
  const auto count = static_cast<Eigen::Index>(cells.size());
  const auto all = static_cast<Eigen::Index>(functions.size());
  std::array<Eigen::MatrixXd, kPatterns> by_mirror;
  for (int mirror = 0; mirror < kPatterns; ++mirror) {
    Eigen::MatrixXd& matrix = by_mirror.at(static_cast<std::size_t>(mirror));
    matrix.resize(count, count);
    const auto added = [&](double r) { return charge.added_V_C(radius_m * r); };
    for (Eigen::Index i = 0; i < count; ++i) {
      for (Eigen::Index j = 0; j <= i; ++j) {
        const Cell& one = cells[static_cast<std::size_t>(i)];
        const Cell& other = cells[static_cast<std::size_t>(j)];
        matrix(i, j) = matrix(j, i) = charge.near_Vm_C() / radius_m * between(one, other, mirror) +
                                      mean_between(one, other, mirror, added);
      }
    }
  }
  Eigen::MatrixXd means = Eigen::MatrixXd::Zero(count, all);  // of the polynomials over the cells
  for (Eigen::Index i = 0; i < count; ++i) {
    const Cell& cell = cells[static_cast<std::size_t>(i)];
    for (std::size_t p = 0; p < cell.points.size(); ++p) {
      means.row(i) += cell.weights[p] * values_at(functions, cell.points[p]).transpose();
    }
  }
  ChargedMesh found{Eigen::Matrix4d::Zero(), Eigen::MatrixXd::Zero(4, all),
                    Eigen::MatrixXd::Zero(all, all)};
  for (int pattern = 0; pattern < kPatterns; ++pattern) {
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(count, count);
    for (int mirror = 0; mirror < kPatterns; ++mirror) {
      const bool is_odd = ((pattern & mirror) == 1) || ((pattern & mirror) == 2);
      matrix += (is_odd ? -1.0 : 1.0) * by_mirror.at(static_cast<std::size_t>(mirror));
    }
    std::vector<Eigen::Index> of_pattern;
    for (Eigen::Index f = 0; f < all; ++f) {
      if (pattern_of(functions[static_cast<std::size_t>(f)]) == pattern) of_pattern.push_back(f);
    }
    const Eigen::MatrixXd own = means(Eigen::all, of_pattern);
    const Cholesky factor(matrix);
    require(factor.is_definite(), "the charges on the quarters are not resolved; give a wider gap");
    const Eigen::VectorXd at_one_volt = factor.solve(Eigen::VectorXd::Ones(count).eval());
    const double charge_C = at_one_volt.sum();
    const Eigen::VectorXd moments = own.transpose() * at_one_volt / charge_C;
    const Eigen::MatrixXd induced =
        -4.0 * (own.transpose() * factor.solve(own) - charge_C * moments * moments.transpose());
    for (int q = 0; q < 4; ++q) {
      for (int r = 0; r < 4; ++r) {
        found.potentials(q, r) += 0.25 * sign_of(pattern, q) * sign_of(pattern, r) / charge_C;
      }
      for (std::size_t f = 0; f < of_pattern.size(); ++f) {
        found.readings(q, of_pattern[f]) =
            sign_of(pattern, q) * moments[static_cast<Eigen::Index>(f)];
      }
    }
    found.induced(of_pattern, of_pattern) = induced;
  }
  return found;
}

}  // namespace

PointCharge::PointCharge(const LayeredFilm& film, double reach_m, int film_degree) {
  const double t_m = film.layers.front().thickness_m;
  const ScreenedWaves waves = screened_waves(film, std::min(4.0 / reach_m, 1.5 / t_m), film_degree);
  near_Vm_C_ = waves.limit_Vm_C / (2.0 * kPi);
  step_m_ = kTableStep * t_m;
  const int count = static_cast<int>(reach_m / step_m_) + 4;
  for (int i = 0; i < count; ++i) {
    double sum = 0.0;
    for (std::size_t w = 0; w < waves.k_1_m.size(); ++w) {
      sum += waves.weight[w] * ::j0(waves.k_1_m[w] * i * step_m_);
    }
    added_V_C_.push_back(sum);
  }
}

// Cubic through four points of the table.
double PointCharge::added_V_C(double distance_m) const {
  const double place = distance_m / step_m_;
  const auto last = added_V_C_.size() - 3;
  const std::size_t i = std::clamp<std::size_t>(static_cast<std::size_t>(place), 1, last);
  const double f = place - static_cast<double>(i);
  const double* const at = &added_V_C_[i - 1];
  return f * (f - 1.0) * ((f + 1.0) * at[3] - (f - 2.0) * at[0]) / 6.0 +
         0.5 * (f + 1.0) * (f - 2.0) * ((f - 1.0) * at[1] - f * at[2]);
}

QuarterRule quarter_means(double radius_m, int count) {
  const QuadratureRule rule = gauss_legendre(count);
  QuarterRule means;
  means.weights = Eigen::MatrixXd::Zero(4, static_cast<Eigen::Index>(4) * count * count);
  for (int quarter = 0; quarter < 4; ++quarter) {
    for (std::size_t i = 0; i < rule.points.size(); ++i) {
      for (std::size_t j = 0; j < rule.points.size(); ++j) {
        const double r_m = radius_m * rule.points[i];
        const double angle = 0.5 * kPi * (quarter + rule.points[j]);
        means.weights(quarter, static_cast<Eigen::Index>(means.points_m.size())) =
            2.0 * rule.points[i] * rule.weights[i] * rule.weights[j];
        means.points_m.emplace_back(r_m * std::cos(angle), r_m * std::sin(angle));
      }
    }
  }
  return means;
}

MetalQuarters::MetalQuarters(const LayeredFilm& film, double radius_m, double gap_m,
                             const MetalQuartersAccuracy& accuracy)
    : radius_m_(radius_m),
      degree_(accuracy.polynomials),
      functions_(functions_to(accuracy.polynomials)) {
  require_positive("radius of an electrode", radius_m, "m");
  require_positive("gap between quarters", gap_m, "m");
  const PointCharge charge(film, 2.02 * radius_m, accuracy.film_degree);
  const auto on_mesh = [&](int n) {
    const double coarsest = film.layers.front().thickness_m / radius_m;
    return charges_on(cells_of(gap_m / radius_m, n, coarsest), functions_, charge, radius_m);
  };
  // From two meshes to what they tend to.
  const int coarse = 2 * accuracy.cells / 3;
  const ChargedMesh before = on_mesh(coarse), now = on_mesh(accuracy.cells);
  const double more = 1.0 / (std::pow(static_cast<double>(accuracy.cells) / coarse, kOrder) - 1.0);
  potentials_V_C_ = now.potentials + more * (now.potentials - before.potentials);
  readings_ = now.readings + more * (now.readings - before.readings);
  induced_ = now.induced + more * (now.induced - before.induced);
}

// int_0^1 R_n^m(r) J_m(x r) r dr = (-1)^((n - m)/2) J_(n + 1)(x)/x: Born & Wolf, Principles of Optics, 9.2.
Eigen::VectorXd MetalQuarters::transforms(double k_1_m) const {
  const double x = k_1_m * radius_m_;
  Eigen::VectorXd J(degree_ + 2);
  bessel_orders(x, J);
  Eigen::VectorXd values(static_cast<Eigen::Index>(functions_.size()));
  for (std::size_t f = 0; f < functions_.size(); ++f) {
    const DiscFunction& one = functions_[f];
    const double sign = (one.degree - one.order) % 4 == 0 ? 1.0 : -1.0;
    values[static_cast<Eigen::Index>(f)] =
        x > 0.0 ? sign * 2.0 * (one.degree + 1.0) * J[one.degree + 1] / x
                : (one.degree == 0 ? 1.0 : 0.0);
  }
  return values;
}

double MetalQuarters::weight(double k_1_m) const {
  const Eigen::VectorXd waves = transforms(k_1_m);
  double sum = 0.0;
  for (std::size_t f = 0; f < functions_.size(); ++f) {
    const auto at = static_cast<Eigen::Index>(f);
    if (functions_[f].order == 0) sum += readings_.col(at).mean() * waves[at];
  }
  return sum;
}

QuarterRule MetalQuarters::rule(int degree) const {
  const std::vector<DiscFunction> functions = functions_to(std::min(degree, degree_));
  const DiscRule disc = disc_rule(std::min(degree, degree_));
  QuarterRule rule;
  rule.weights = readings_.leftCols(static_cast<Eigen::Index>(functions.size())) *
                 amplitudes_at(functions, disc);
  for (const Vector2d& one : disc.points) rule.points_m.push_back(radius_m_ * one);
  return rule;
}

Eigen::MatrixXd MetalQuarters::amplitudes_from_points() const {
  return amplitudes_at(functions_, disc_rule(degree_));
}

}  // namespace viscard
