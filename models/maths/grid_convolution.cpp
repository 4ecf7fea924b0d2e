#include "models/maths/grid_convolution.h"

#include "models/maths/require.h"

#include <unsupported/Eigen/FFT>

#include <complex>
#include <vector>

namespace viscard {
namespace {

using Complexes = std::vector<std::complex<double>>;

// The length with its padding. A single row needs none.
Eigen::Index padded(Eigen::Index count) {
  return count == 1 ? 1 : 2 * count;
}

// Transforms of real columns with zeros below them, and across the columns: waves x waves.
Eigen::MatrixXcd forward(const Eigen::MatrixXd& values, Eigen::Index rows, Eigen::Index columns) {
  Eigen::FFT<double> fft;
  const Eigen::Index half = rows / 2 + 1;
  Eigen::MatrixXcd waves = Eigen::MatrixXcd::Zero(columns, half);
  std::vector<double> line(static_cast<std::size_t>(rows), 0.0);
  Complexes spectrum(static_cast<std::size_t>(rows));
  for (Eigen::Index c = 0; c < values.cols(); ++c) {
    for (Eigen::Index r = 0; r < values.rows(); ++r) {
      line[static_cast<std::size_t>(r)] = values(r, c);
    }
    fft.fwd(spectrum.data(), line.data(), rows);
    for (Eigen::Index k = 0; k < half; ++k) waves(c, k) = spectrum[static_cast<std::size_t>(k)];
  }
  if (columns == 1) return waves;
  Complexes across(static_cast<std::size_t>(columns));
  for (Eigen::Index k = 0; k < half; ++k) {
    fft.fwd(across.data(), waves.col(k).data(), columns);
    waves.col(k) = Eigen::Map<const Eigen::VectorXcd>(across.data(), columns);
  }
  return waves;
}

// The reverse; the first rows and columns of the result.
Eigen::MatrixXd backward(Eigen::MatrixXcd waves, Eigen::Index rows, Eigen::Index kept_rows,
                         Eigen::Index kept_columns) {
  Eigen::FFT<double> fft;
  const Eigen::Index columns = waves.rows();
  if (columns > 1) {
    Complexes across(static_cast<std::size_t>(columns));
    for (Eigen::Index k = 0; k < waves.cols(); ++k) {
      fft.inv(across.data(), waves.col(k).data(), columns);
      waves.col(k) = Eigen::Map<const Eigen::VectorXcd>(across.data(), columns);
    }
  }
  Eigen::MatrixXd values(kept_rows, kept_columns);
  std::vector<double> line(static_cast<std::size_t>(rows));
  Complexes spectrum(static_cast<std::size_t>(rows / 2 + 1));
  for (Eigen::Index c = 0; c < kept_columns; ++c) {
    for (Eigen::Index k = 0; k < waves.cols(); ++k) {
      spectrum[static_cast<std::size_t>(k)] = waves(c, k);
    }
    fft.inv(line.data(), spectrum.data(), rows);
    values.col(c) = Eigen::Map<const Eigen::VectorXd>(line.data(), kept_rows);
  }
  return values;
}

}  // namespace

GridConvolution::GridConvolution(const Eigen::MatrixXd& kernel)
    : rows_(kernel.rows()), columns_(kernel.cols()) {
  require(rows_ > 1 && columns_ > 0, "a convolution needs a grid of at least two points");
  const Eigen::Index rows = padded(rows_);
  const Eigen::Index columns = padded(columns_);
  // The place at half of the padded length is never used: no two points are so far apart.
  Eigen::MatrixXd around = Eigen::MatrixXd::Zero(rows, columns);
  for (Eigen::Index c = 0; c < columns_; ++c) {
    for (Eigen::Index r = 0; r < rows_; ++r) {
      const Eigen::Index up = (rows - r) % rows;
      const Eigen::Index left = (columns - c) % columns;
      around(r, c) = around(up, c) = around(r, left) = around(up, left) = kernel(r, c);
    }
  }
  spectrum_ = forward(around, rows, columns);
}

GridConvolution GridConvolution::of_all_offsets(const Eigen::MatrixXd& kernel) {
  require(kernel.rows() % 2 == 1 && kernel.cols() % 2 == 1,
          "a kernel of all offsets has an odd number of rows and columns");
  GridConvolution sums((kernel.rows() + 1) / 2, (kernel.cols() + 1) / 2);
  require(sums.rows_ > 1, "a convolution needs a grid of at least two points");
  const Eigen::Index rows = padded(sums.rows_);
  const Eigen::Index columns = padded(sums.columns_);
  Eigen::MatrixXd around = Eigen::MatrixXd::Zero(rows, columns);
  for (Eigen::Index c = 0; c < kernel.cols(); ++c) {
    for (Eigen::Index r = 0; r < kernel.rows(); ++r) {
      around((r - sums.rows_ + 1 + rows) % rows, (c - sums.columns_ + 1 + columns) % columns) =
          kernel(r, c);
    }
  }
  sums.spectrum_ = forward(around, rows, columns);
  return sums;
}

Eigen::MatrixXcd GridConvolution::waves_of(const Eigen::MatrixXd& values) const {
  return forward(values, padded(rows_), padded(columns_));
}

void GridConvolution::add_product(const Eigen::MatrixXcd& waves, Eigen::MatrixXcd& sum) const {
  if (sum.size() == 0) sum = Eigen::MatrixXcd::Zero(waves.rows(), waves.cols());
  sum.array() += waves.array() * spectrum_.array();
}

Eigen::MatrixXd GridConvolution::values_of(const Eigen::MatrixXcd& waves) const {
  return backward(waves, padded(rows_), rows_, columns_);
}

Eigen::MatrixXd GridConvolution::apply(const Eigen::MatrixXd& values) const {
  Eigen::MatrixXcd sum;
  add_product(waves_of(values), sum);
  return values_of(sum);
}

}  // namespace viscard
