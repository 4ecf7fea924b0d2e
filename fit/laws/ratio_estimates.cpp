#include "fit/laws/ratio_estimates.h"

#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

namespace viscard {
namespace {

using Index = Eigen::Index;

std::string name_of(const Material& material, std::size_t number) {
  return material.name.empty()
             ? "specimen " + std::to_string(number)
             : "'" + material.name + "' (specimen " + std::to_string(number) + ")";
}

void check_record(const Material& material, std::size_t number) {
  const std::string name = name_of(material, number);
  if (!(material.mixing_ratio > 0.0)) {
    throw std::invalid_argument(name +
                                " has no mixing ratio; give it with --ratio, or mixing_ratio in "
                                "its specimen or material file");
  }
  const auto size = static_cast<Index>(1 + 2 * material.terms.size());
  const bool has_covariance = material.uncertainty &&
                              material.uncertainty->covariance.rows() == size &&
                              material.uncertainty->covariance.allFinite();
  if (!has_covariance) {
    throw std::invalid_argument(name +
                                " has no covariance of its parameters, so its weight is unknown; "
                                "fit it from data with viscard fit");
  }
}

// (ln E0, ln g_i, ln tau_i) and its covariance from that of (E_inf, E_i, ln tau_i).
RatioEstimate estimate_of(const Material& material) {
  const auto n = static_cast<Index>(material.terms.size());
  const Index size = 1 + 2 * n;
  RatioEstimate out{material.mixing_ratio, Eigen::VectorXd(size), {}, 0};
  Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(size, size);
  out.theta[0] = std::log(material.E0_Pa);
  slopes.row(0).head(1 + n).setConstant(1.0 / material.E0_Pa);
  for (Index i = 1; i <= n; ++i) {
    const MaterialTerm& term = material.terms[static_cast<std::size_t>(i - 1)];
    out.theta[i] = std::log(term.g);
    out.theta[n + i] = std::log(term.tau_s);
    slopes.row(i) = -slopes.row(0);
    slopes(i, i) += 1.0 / (term.g * material.E0_Pa);
    slopes(n + i, n + i) = 1.0;
  }
  out.covariance = slopes * material.uncertainty->covariance * slopes.transpose();
  // Keeps the covariance of noise-free data from being singular.
  out.covariance.diagonal().array() += 1e-16 + 1e-12 * out.covariance.diagonal().array();
  return out;
}

// All records (of a ratio) have the number of terms of the first one.
void check_terms(const std::vector<Material>& records, std::size_t s, std::size_t first) {
  const std::size_t n = records[s].terms.size();
  if (n != records[first].terms.size()) {
    throw std::invalid_argument(
        name_of(records[s], s + 1) + " has " + counted(n, "term") + " and " +
        name_of(records[first], first + 1) + " " + std::to_string(records[first].terms.size()) +
        ": all specimens need the same number of terms. Fit them with the same --terms N");
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (records[s].terms[i].g > 0.0) continue;
    throw std::invalid_argument(name_of(records[s], s + 1) + ": g of term " +
                                std::to_string(i + 1) + " is zero; fit with fewer terms");
  }
}

}  // namespace

std::vector<RatioEstimate> ratio_estimates_of(const std::vector<Material>& records,
                                              EqualTerms equal) {
  std::vector<RatioEstimate> out;
  std::map<double, std::size_t> first_at;  // of each ratio
  std::map<std::pair<double, std::string>, int> numbers;
  int n_specimens = 0;
  for (std::size_t s = 0; s < records.size(); ++s) {
    const Material& record = records[s];
    check_record(record, s + 1);
    const std::size_t first_here = first_at.emplace(record.mixing_ratio, s).first->second;
    check_terms(records, s,
                equal == EqualTerms::kEverywhere    ? 0
                : equal == EqualTerms::kAtEachRatio ? first_here
                                                    : s);
    out.push_back(estimate_of(record));
    const std::string& id = record.specimen_id;
    const auto [number, is_new] = numbers.emplace(
        std::pair(record.mixing_ratio, id.empty() ? "\n" + std::to_string(s) : id), n_specimens);
    if (is_new) ++n_specimens;
    out.back().specimen = number->second;
  }
  return out;
}

std::vector<double> distinct_ratios(const std::vector<RatioEstimate>& estimates) {
  std::vector<double> ratios;
  for (const RatioEstimate& one : estimates) ratios.push_back(one.ratio);
  std::sort(ratios.begin(), ratios.end());
  ratios.erase(std::unique(ratios.begin(), ratios.end()), ratios.end());
  return ratios;
}

int count_specimens(const std::vector<RatioEstimate>& records) {
  int count = 0;
  for (const RatioEstimate& one : records) count = std::max(count, one.specimen + 1);
  return count;
}

}  // namespace viscard
