#include "models/array/film/layered_film.h"

#include "models/maths/dense.h"
#include "models/maths/require.h"
#include "models/pillar/mesh/line_mesh.h"
#include "models/pillar/system/rotated_medium.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace viscard {
namespace {

// One term of strain or field of a wave: factor k^k_power d^dz (field); fields a, b, w, phi.
struct WaveTerm {
  std::size_t field;
  int dz;
  int k_power;
  double factor;
};
constexpr std::size_t kPhi = 3;

// Rows xx yy zz yz xz xy, E_x E_y E_z of eq. S1. The shears yz and xz and the fields E_x and E_y
// are i times the stored values; a film of class mm2 about z does not couple them to the other
// rows, so i cancels against its conjugate in the virtual work.
const std::array<std::vector<WaveTerm>, 9>& wave_rows() {
  static const std::array<std::vector<WaveTerm>, 9> rows = {{
      {{0, 0, 1, -1.0}},
      {},
      {{2, 1, 0, 1.0}},
      {{1, 1, 0, 1.0}},
      {{0, 1, 0, 1.0}, {2, 0, 1, 1.0}},
      {{1, 0, 1, -1.0}},
      {{kPhi, 0, 1, -1.0}},
      {},
      {{kPhi, 1, 0, -1.0}},
  }};
  return rows;
}

bool is_imaginary_row(Eigen::Index row) {
  return row == 3 || row == 4 || row == 6 || row == 7;
}

// Longest element in units of 1/k: Lagrange polynomials of degree 8 on it follow exp(k z) to 1e-5, of
// degree 10 to 1e-7 of its largest value.
constexpr double kLongestInWaves = 7.0;

std::vector<double> film_breaks(const LayeredFilm& film, double largest_k_1_m, double unit_m) {
  std::vector<double> breaks = {0.0};
  for (const FilmLayer& layer : film.layers) {
    const double height = layer.thickness_m / unit_m;
    const int count = std::max(
        2, static_cast<int>(std::ceil(largest_k_1_m * layer.thickness_m / kLongestInWaves)));
    const double start = breaks.back();
    for (int i = 1; i <= count; ++i) breaks.push_back(start + height * i / count);
  }
  return breaks;
}

const FilmLayer& layer_at(const LayeredFilm& film, double z_m) {
  double top_m = 0.0;
  for (const FilmLayer& layer : film.layers) {
    top_m += layer.thickness_m;
    if (z_m < top_m) return layer;
  }
  return film.layers.back();
}

// Unknowns a, b, w and phi by node, so that the matrix is banded; -1 where a field is held or absent.
class Numbering {
 public:
  Numbering(const LayeredFilm& film, const LineMesh& line) {
    int film_top = 0;  // node at the film's upper face, where the potential ends
    while (line.nodes()[static_cast<std::size_t>(film_top)] < 1.0 - 1e-9) ++film_top;
    const int grounded = film.grounded == FilmFace::kTop ? film_top : 0;
    for (int node = 0; node < line.node_count(); ++node) {
      std::array<int, 4> unknown = {-1, -1, -1, -1};
      for (std::size_t field = 0; field < kPhi; ++field) {
        if (node > 0 || film.backing) unknown[field] = count_++;
      }
      if (node <= film_top && node != grounded) unknown[kPhi] = count_++;
      unknowns_.push_back(unknown);
    }
    read_ = of_node(grounded == 0 ? film_top : 0)[kPhi];
  }
  const std::array<int, 4>& of_node(int node) const {
    return unknowns_[static_cast<std::size_t>(node)];
  }
  int count() const { return count_; }
  int read() const { return read_; }

 private:
  int count_ = 0;
  int read_ = 0;
  std::vector<std::array<int, 4>> unknowns_;
};

// Adds the virtual work of one element, sum of rows r' D s over the height, by powers of k.
void add_element(const LineMesh& line, int element, const Eigen::MatrixXd& D,
                 const Numbering& numbering, std::array<Eigen::MatrixXd, 3>& by_power) {
  const int first = element * line.degree();
  const auto add = [&](const WaveTerm& left, const WaveTerm& right, double factor) {
    const Eigen::MatrixXd block = factor * line.integral(element, 0, left.dz, right.dz);
    Eigen::MatrixXd& sum = by_power[static_cast<std::size_t>(left.k_power + right.k_power)];
    for (int i = 0; i <= line.degree(); ++i) {
      const int row = numbering.of_node(first + i)[left.field];
      for (int j = 0; j <= line.degree() && row >= 0; ++j) {
        const int column = numbering.of_node(first + j)[right.field];
        if (column >= 0) sum(row, column) += block(i, j);
      }
    }
  };
  for (Eigen::Index r = 0; r < D.rows(); ++r) {
    for (Eigen::Index s = 0; s < D.cols(); ++s) {
      if (D(r, s) == 0.0) continue;
      for (const WaveTerm& left : wave_rows()[static_cast<std::size_t>(r)]) {
        for (const WaveTerm& right : wave_rows()[static_cast<std::size_t>(s)]) {
          add(left, right, D(r, s) * left.factor * right.factor);
        }
      }
    }
  }
}

}  // namespace

void validate(const LayeredFilm& film) {
  require(!film.layers.empty(), "a film needs at least one layer");
  require(film.layers.front().medium.has_permittivity(),
          "the lowest layer is the film and needs a permittivity");
  for (const FilmLayer& layer : film.layers) {
    require_positive("thickness of a layer", layer.thickness_m, "m");
    require(!layer.medium.is_isotropic || layer.medium.poisson_ratio < 0.5,
            "a layer must have a Poisson ratio below 0.5");
    const Eigen::MatrixXd form = coupled_form(layer.medium);
    for (Eigen::Index i = 0; i < form.rows(); ++i) {
      for (Eigen::Index j = 0; j < form.cols(); ++j) {
        require(
            is_imaginary_row(i) == is_imaginary_row(j) || form(i, j) == 0.0,
            "a layer couples shear across its thickness to stretching; its axis 3 must stand on "
            "the film as a twofold axis");
      }
    }
  }
  if (film.backing)
    isotropic_moduli_Pa(film.backing->young_modulus_Pa, film.backing->poisson_ratio);
}

double thickness_m(const LayeredFilm& film) {
  double sum_m = 0.0;
  for (const FilmLayer& layer : film.layers) sum_m += layer.thickness_m;
  return sum_m;
}

double half_space_compliance_m_Pa(double young_modulus_Pa, double poisson_ratio, double k_1_m) {
  return 2.0 * (1.0 - poisson_ratio * poisson_ratio) / (young_modulus_Pa * k_1_m);
}

FilmWaves::FilmWaves(const LayeredFilm& film, double angle_rad, double largest_k_1_m, int degree)
    : backing_(film.backing) {
  validate(film);
  const Medium& own = film.layers.front().medium;
  length_m_ = film.layers.front().thickness_m;
  stress_Pa_ = own.stiffness_Pa(2, 2);
  potential_V_ = potential_scale_V(own) * length_m_;
  const LineMesh line(film_breaks(film, largest_k_1_m, length_m_), degree);
  const Numbering numbering(film, line);
  top_ = numbering.of_node(line.node_count() - 1);
  bottom_ = numbering.of_node(0);
  read_ = numbering.read();
  for (Eigen::MatrixXd& part : by_power_) part.setZero(numbering.count(), numbering.count());
  Eigen::VectorXd scale = Eigen::VectorXd::Ones(9);
  scale.tail(3).setConstant(potential_V_ / length_m_);
  for (int e = 0; e < line.element_count(); ++e) {
    const auto at = static_cast<std::size_t>(e);
    const double middle_m = 0.5 * (line.breaks()[at] + line.breaks()[at + 1]) * length_m_;
    const Medium medium = rotated_about_z(layer_at(film, middle_m).medium, angle_rad);
    const Eigen::MatrixXd form = material_form(medium, true, film.is_plane_stress);
    add_element(line, e, scale.asDiagonal() * form * scale.asDiagonal() / stress_Pa_, numbering,
                by_power_);
  }
}

Eigen::MatrixXd FilmWaves::matrix(double k_1_m) const {
  const double k = k_1_m * length_m_;
  Eigen::MatrixXd sum = by_power_[0] + k * by_power_[1] + k * k * by_power_[2];
  if (backing_) {
    // Half-space under a wave: eq. S2.
    const double nu = backing_->poisson_ratio;
    const double G = backing_->young_modulus_Pa / (2.0 * (1.0 + nu)) / stress_Pa_;
    const double factor = 2.0 * G * k / (3.0 - 4.0 * nu);
    sum(bottom_[0], bottom_[0]) += factor * 2.0 * (1.0 - nu);
    sum(bottom_[2], bottom_[2]) += factor * 2.0 * (1.0 - nu);
    sum(bottom_[0], bottom_[2]) += factor * (1.0 - 2.0 * nu);
    sum(bottom_[2], bottom_[0]) += factor * (1.0 - 2.0 * nu);
    sum(bottom_[1], bottom_[1]) += G * k;
  }
  return sum;
}

Eigen::Matrix4d FilmWaves::response(double k_1_m) const {
  const Eigen::MatrixXd A = matrix(k_1_m);
  Eigen::MatrixXd loads = Eigen::MatrixXd::Zero(A.rows(), 4);
  for (int i = 0; i < 3; ++i) loads(top_[static_cast<std::size_t>(i)], i) = 1.0;
  loads(read_, 3) = -1.0;  // virtual work of the charge q: -q phi
  const Eigen::MatrixXd solution = LuFactor(A).solve(loads);
  Eigen::Matrix4d response;
  for (int i = 0; i < 3; ++i) response.row(i) = solution.row(top_[static_cast<std::size_t>(i)]);
  response.row(3) = solution.row(read_);
  // Back to SI: displacement in units of length, tractions of stress, charge of stress length/potential.
  const double charge_C_m2 = stress_Pa_ * length_m_ / potential_V_;
  response.topRows(3) *= length_m_;
  response.row(3) *= potential_V_;
  response.leftCols(3) /= stress_Pa_;
  response.col(3) /= charge_C_m2;
  return response;
}

Eigen::Vector4d FilmWaves::reading(double k_1_m) const {
  const Eigen::MatrixXd A = matrix(k_1_m);
  // The matrix is symmetric, so the answer to a charge is the reading of every load.
  Eigen::VectorXd charge = Eigen::VectorXd::Zero(A.rows());
  charge[read_] = 1.0;
  const Eigen::VectorXd solution = LuFactor(A).solve(charge);
  Eigen::Vector4d reading;
  for (int i = 0; i < 3; ++i) {
    reading[i] = solution[top_[static_cast<std::size_t>(i)]] * potential_V_ / stress_Pa_;
  }
  reading[3] = -solution[read_] * potential_V_ * potential_V_ / (stress_Pa_ * length_m_);
  return reading;
}

}  // namespace viscard
