#include "fit/calibration/cell_shape.h"

#include "models/maths/distributions.h"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>

namespace viscard {
namespace {

constexpr double kChance = 6.0;  // F ratio of a loop that is no chance

struct Solved {
  Eigen::VectorXd unknowns;
  Eigen::MatrixXd inverse;  // of the normal matrix
  double squares = 0.0;
  Eigen::Index freedom = 0;
};

Solved solved(const Eigen::MatrixXd& columns, const Eigen::VectorXd& values) {
  Solved result;
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(columns);
  result.unknowns = qr.solve(values);
  result.squares = (values - columns * result.unknowns).squaredNorm();
  result.freedom = columns.rows() - qr.rank();
  result.inverse =
      (columns.transpose() * columns).completeOrthogonalDecomposition().pseudoInverse();
  return result;
}

// The slope of a straight line with one zero for each series.
double slope_of(const std::vector<CellReading>& readings, const std::vector<double>& values) {
  const std::size_t n_series = readings.back().series + 1;
  std::vector<double> force(n_series), value(n_series), count(n_series);
  for (std::size_t i = 0; i < readings.size(); ++i) {
    force[readings[i].series] += readings[i].force_N;
    value[readings[i].series] += values[i];
    count[readings[i].series] += 1.0;
  }
  double xx = 0.0, xy = 0.0;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const std::size_t s = readings[i].series;
    const double x = readings[i].force_N - force[s] / count[s];
    xx += x * x;
    xy += x * (values[i] - value[s] / count[s]);
  }
  return xy / xx;
}

}  // namespace

CellShape cell_shape(const std::vector<CellReading>& readings) {
  double largest_N = 0.0;
  std::set<double> falling;
  for (const CellReading& reading : readings) {
    largest_N = std::max(largest_N, reading.force_N);
    if (reading.branch < 0.0) falling.insert(std::round(1e6 * reading.force_N));
  }
  const auto n = static_cast<Eigen::Index>(readings.size());
  const auto n_series = static_cast<Eigen::Index>(readings.back().series) + 1;
  const auto n_loop = static_cast<Eigen::Index>(std::min<std::size_t>(2, falling.size()));
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(n, n_series + 2 + n_loop);
  Eigen::VectorXd values(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const CellReading& reading = readings[static_cast<std::size_t>(i)];
    const double x = reading.force_N / largest_N;
    columns(i, static_cast<Eigen::Index>(reading.series)) = 1.0;
    columns(i, n_series) = x;
    columns(i, n_series + 1) = x * x;
    if (n_loop > 0) columns(i, n_series + 2) = reading.branch * x;
    if (n_loop > 1) columns(i, n_series + 3) = reading.branch * x * x;
    values(i) = reading.value;
  }
  const Solved without = solved(columns.leftCols(n_series + 2), values);
  Solved best = without;
  CellShape shape;
  if (n_loop > 0) {
    const Solved with = solved(columns, values);
    const double gained = (without.squares - with.squares) / static_cast<double>(n_loop);
    shape.has_loop =
        with.freedom > 0 && gained > kChance * with.squares / static_cast<double>(with.freedom);
    if (shape.has_loop) best = with;
  }
  shape.is_known = best.freedom > 0;
  if (shape.is_known) {
    const auto freedom = static_cast<double>(best.freedom);
    // Few readings know their own scatter badly; k = 2 is meant to be enough.
    shape.scatter = std::sqrt(best.squares / freedom) * 0.5 * student_t_975(freedom);
  }
  shape.per_N2 = best.unknowns(n_series + 1) / (largest_N * largest_N);
  shape.per_N2_se =
      shape.scatter * std::sqrt(best.inverse(n_series + 1, n_series + 1)) / (largest_N * largest_N);
  if (!shape.is_known) shape.per_N2_se = std::abs(shape.per_N2);
  if (shape.has_loop) {
    const Eigen::VectorXd loop = columns.rightCols(n_loop) * best.unknowns.tail(n_loop);
    shape.of_loop = slope_of(readings, {loop.data(), loop.data() + loop.size()});
  }
  return shape;
}

}  // namespace viscard
