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
  spectrum_ = forward(around, rows, columns).real();
}

Eigen::MatrixXd GridConvolution::apply(const Eigen::MatrixXd& values) const {
  const Eigen::Index rows = padded(rows_);
  Eigen::MatrixXcd waves = forward(values, rows, padded(columns_));
  waves.array() *= spectrum_.array();
  return backward(std::move(waves), rows, rows_, columns_);
}

}  // namespace viscard
