#include "fit/spectrum_scatter.h"

#include "fit/search/nnls.h"
#include "models/maths/tall_products.h"

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

using Index = Eigen::Index;

// The best factor of the model's rows of each segment, by least squares; one at the reference.
void add_vertical_factors(const MasterModel& model, const Eigen::VectorXd& fitted,
                          std::size_t reference, Eigen::VectorXd& factor) {
  Eigen::VectorXd product = Eigen::VectorXd::Zero(factor.size()), square = product;
  for (Index r = 0; r < fitted.size(); ++r) {
    product[model.segment_of(r)] += fitted[r] * model.data()[r];
    square[model.segment_of(r)] += fitted[r] * fitted[r];
  }
  const Eigen::VectorXd own =
      product.cwiseQuotient(square.cwiseMax(1e-300)).cwiseMax(0.5).cwiseMin(2.0);
  factor = factor.cwiseProduct(own / own[static_cast<Index>(reference)]);
}

}  // namespace

ShiftCandidate SpectrumScatter::at(const Eigen::VectorXd& ln_a) const {
  const MasterModel model(segments_, reference_, {ln_a.begin(), ln_a.end()}, options_);
  constexpr double kPerDecade = 4.0;
  const double decades = (model.ln_tau_max() - model.ln_tau_min()) / std::log(10.0);
  const auto n = static_cast<Index>(std::ceil(kPerDecade * decades)) + 1;
  const Eigen::MatrixXd plain =
      model
          .columns(Eigen::VectorXd::LinSpaced(n, model.ln_tau_min(), model.ln_tau_max()),
                   model.nuisance_start(), /*with_slopes=*/false)
          .values;
  Eigen::VectorXd factor = Eigen::VectorXd::Ones(static_cast<Index>(segments_.size()));
  ShiftCandidate out{ln_a, factor, 0.0};
  const int rounds = options_.vertical_shift == VerticalShift::kOff ? 1 : 2;
  for (int round = 0; round < rounds; ++round) {
    Eigen::MatrixXd columns = plain;
    for (Index r = 0; r < columns.rows(); ++r) columns.row(r) *= factor[model.segment_of(r)];
    const Eigen::VectorXd x = nonnegative_from_normal_equations(
        gram_of(columns), transposed_product(columns, model.data()),
        std::vector<bool>(static_cast<std::size_t>(columns.cols()), false));
    const Eigen::VectorXd fitted = columns * x;
    const auto spare = static_cast<double>(model.n_rows() - (x.array() > 0.0).count());
    out.scatter = (fitted - model.data()).norm() / std::sqrt(std::max(1.0, spare));
    out.ln_b = factor.array().log();
    add_vertical_factors(model, fitted, reference_, factor);
  }
  return out;
}

}  // namespace viscard
