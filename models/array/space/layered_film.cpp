#include "models/array/space/layered_film.h"

#include "models/maths/dense.h"
#include "models/maths/require.h"
#include "models/pillar/mesh/line_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace viscard {
namespace {

// One term of strain or field of a wave: factor k^k_power d^dz (field); fields a, b, w, phi.
struct WaveTerm {
  int field;
  int dz;
  int k_power;
  double factor;
};
constexpr int kPhi = 3;

// Rows xx yy zz yz xz xy, E_x E_y E_z of eq. S1. The shears yz and xz and the fields E_x and E_y are i
// times what stands here; a film of class mm2 about z does not couple them to the other rows, so i
// cancels against its conjugate in the virtual work.
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
    const int count =
        std::max(2, static_cast<int>(std::ceil(largest_k_1_m * layer.thickness_m / kLongestInWaves)));
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
        require(is_imaginary_row(i) == is_imaginary_row(j) || form(i, j) == 0.0,
                "a layer couples shear across its thickness to stretching; its axis 3 must stand on "
                "the film as a twofold axis");
      }
    }
  }
  if (film.backing) isotropic_moduli_Pa(film.backing->young_modulus_Pa, film.backing->poisson_ratio);
}

double half_space_compliance_m_Pa(double young_modulus_Pa, double poisson_ratio, double k_1_m) {
  return 2.0 * (1.0 - poisson_ratio * poisson_ratio) / (young_modulus_Pa * k_1_m);
}

FilmWaves::FilmWaves(const LayeredFilm& film, double angle_rad, double largest_k_1_m, int degree)
    : backing_(film.backing) {
  validate(film);
  const FilmLayer& own = film.layers.front();
  length_m_ = own.thickness_m;
  stress_Pa_ = own.medium.stiffness_Pa(2, 2);
  potential_V_ = potential_scale_V(own.medium) * length_m_;
  const LineMesh line(film_breaks(film, largest_k_1_m, length_m_), degree);
  const int nodes = line.node_count();
  int film_top = 0;  // node at the film's upper face
  while (line.nodes()[static_cast<std::size_t>(film_top)] < 1.0 - 1e-9) ++film_top;

  // Unknowns by node, so that the matrix is banded. The potential ends at the film's upper face.
  const int grounded = film.grounded == FilmFace::kTop ? film_top : 0;
  std::vector<std::array<int, 4>> unknown(static_cast<std::size_t>(nodes), {-1, -1, -1, -1});
  int count = 0;
  for (int node = 0; node < nodes; ++node) {
    auto& of_node = unknown[static_cast<std::size_t>(node)];
    for (int field = 0; field < kPhi; ++field) {
      if (node > 0 || film.backing) of_node[static_cast<std::size_t>(field)] = count++;
    }
    if (node <= film_top && node != grounded) of_node[kPhi] = count++;
  }
  top_.assign(unknown.back().begin(), unknown.back().begin() + 3);
  bottom_.assign(unknown.front().begin(), unknown.front().begin() + 3);
  read_ = unknown[static_cast<std::size_t>(grounded == 0 ? film_top : 0)][kPhi];

  for (Eigen::MatrixXd* part : {&constant_, &linear_, &quadratic_}) part->setZero(count, count);
  Eigen::VectorXd scale = Eigen::VectorXd::Ones(9);
  scale.tail(3).setConstant(potential_V_ / length_m_);
  for (int e = 0; e < line.element_count(); ++e) {
    const auto index = static_cast<std::size_t>(e);
    const double middle_m = 0.5 * (line.breaks()[index] + line.breaks()[index + 1]) * length_m_;
    const Medium medium = rotated_about_z(layer_at(film, middle_m).medium, angle_rad);
    const Eigen::MatrixXd form =
        scale.asDiagonal() * coupled_form(medium) * scale.asDiagonal() / stress_Pa_;
    for (Eigen::Index r = 0; r < 9; ++r) {
      for (Eigen::Index s = 0; s < 9; ++s) {
        if (form(r, s) == 0.0) continue;
        for (const WaveTerm& left : wave_rows()[static_cast<std::size_t>(r)]) {
          for (const WaveTerm& right : wave_rows()[static_cast<std::size_t>(s)]) {
            const Eigen::MatrixXd block = form(r, s) * left.factor * right.factor *
                                          line.integral(e, 0, left.dz, right.dz);
            const int k_power = left.k_power + right.k_power;
            Eigen::MatrixXd& part = k_power == 0 ? constant_ : k_power == 1 ? linear_ : quadratic_;
            for (int i = 0; i <= degree; ++i) {
              const int row = unknown[static_cast<std::size_t>(e * degree + i)]
                                     [static_cast<std::size_t>(left.field)];
              if (row < 0) continue;
              for (int j = 0; j <= degree; ++j) {
                const int column = unknown[static_cast<std::size_t>(e * degree + j)]
                                          [static_cast<std::size_t>(right.field)];
                if (column >= 0) part(row, column) += block(i, j);
              }
            }
          }
        }
      }
    }
  }
}

Eigen::MatrixXd FilmWaves::matrix(double k_1_m) const {
  const double k = k_1_m * length_m_;
  Eigen::MatrixXd sum = constant_ + k * linear_ + k * k * quadratic_;
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
