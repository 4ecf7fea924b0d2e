#include "fit/laws/fit_mixing_ratio.h"
#include "fit/laws/ratio_estimates.h"
#include "fit/laws/scatter_levels.h"
#include "io/basics/atomic_file.h"
#include "io/basics/written_path.h"
#include "io/flow/fit_file.h"
#include "io/flow/specimen_reports.h"
#include "io/materials/material_file.h"

#include <cmath>
#include <filesystem>
#include <set>
#include <string>
#include <utility>

namespace viscard {
namespace {

// Replaces "+-" and "x" by the signs for print.
std::string typeset(std::string text) {
  for (const auto& [plain, sign] : {std::pair{"+- ", "± "}, {" x ", " × "}}) {
    for (auto at = text.find(plain); at != std::string::npos; at = text.find(plain)) {
      text.replace(at, std::string(plain).size(), sign);
    }
  }
  return text;
}

MixingLaw law_from(const RatioFit& fit) {
  const RatioBand band = ratio_band(fit);
  return {"Joint fit over specimens: " + typeset(law_in_words(fit)) +
              ". The band contains 95 % of new specimens.",
          band.ratio,
          band.E0_Pa,
          band.E0_low_Pa,
          band.E0_high_Pa,
          fit.scatter};
}

// The scatter of the records includes the relaxing shares; if these are unknown for one record,
// only E0 is used.
std::vector<Scatter> scatter_of_all(const std::vector<Material>& records, const RatioFit& fit) {
  for (const Material& one : records) {
    const auto size = static_cast<Eigen::Index>(1 + 2 * one.terms.size());
    if (one.uncertainty->covariance.rows() != size || !one.uncertainty->covariance.allFinite()) {
      return fit.scatter;
    }
    for (const MaterialTerm& term : one.terms) {
      if (!(term.g > 0.0)) return fit.scatter;
    }
  }
  return scatter_levels(ratio_estimates_of(records, EqualTerms::kNowhere), fit.law);
}

// The material reduced to its modulus, because specimens may differ in their number of terms.
std::optional<Material> modulus_of(const SpecimenReport& specimen) {
  if (!specimen.material || !specimen.material->uncertainty) return std::nullopt;
  Material material = *specimen.material;
  const Interval& interval = material.uncertainty->E0_Pa_95;
  const double se_Pa = (interval.high - interval.low) / (2.0 * 1.959963984540054);
  if (!(material.mixing_ratio > 0.0) || !(se_Pa > 0.0) || !std::isfinite(se_Pa)) {
    return std::nullopt;
  }
  material.terms.clear();
  material.uncertainty->terms.clear();
  material.uncertainty->covariance_parameters = {"E_inf_Pa"};
  material.uncertainty->covariance = Eigen::MatrixXd::Constant(1, 1, se_Pa * se_Pa);
  return material;
}

}  // namespace

std::optional<MixingLaw> mixing_law_of(const std::vector<std::string>& files,
                                       const std::vector<SpecimenReport>& specimens) {
  for (const std::string& file : files) {
    if (looks_like_ratio_file(file)) return law_from(read_ratio_fit(file));
  }
  std::vector<Material> moduli, records;
  std::set<double> ratios;
  std::set<std::pair<double, std::string>> distinct;
  for (const SpecimenReport& specimen : specimens) {
    if (const auto modulus = modulus_of(specimen)) {
      moduli.push_back(*modulus);
      records.push_back(*specimen.material);
      const std::string& id = modulus->specimen_id;
      distinct.emplace(modulus->mixing_ratio,
                       id.empty() ? "\n" + std::to_string(moduli.size()) : id);
      ratios.insert(modulus->mixing_ratio);
    }
  }
  if (distinct.size() < 4 || ratios.size() < 2) return std::nullopt;
  RatioFit fit = fit_mixing_ratio(moduli);
  fit.scatter = scatter_of_all(records, fit);
  return law_from(fit);
}

SpecimenReport specimen_of_tests(const ReportRequest& request, const FlowProgress& progress) {
  FitRequest wanted;
  wanted.accepts_unverified = request.accepts_unverified;
  const FittedFile fitted = fit_tests(request.tests, wanted, progress);
  SpecimenReport report;
  report.fit = fitted.result;
  report.specimen = fitted.specimen;
  if (report.specimen.id.empty()) {
    report.specimen.id = std::filesystem::path(request.tests.front().path).stem().string();
  }
  for (const TestFile& test : request.tests) {
    report.files.push_back({written_path(test.path), sha256_as_read(test.path)});
  }
  if (!fitted.result.is_stiffness) {
    report.material = material_from_fitted(
        fitted, {.command = request.command, .created_at = request.created_at});
  }
  return report;
}

}  // namespace viscard
