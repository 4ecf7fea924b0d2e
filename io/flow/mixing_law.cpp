#include "fit/laws/fit_mixing_ratio.h"
#include "io/flow/specimen_reports.h"
#include "io/materials/material_file.h"

#include <cmath>
#include <set>
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
          band.ratio, band.E0_Pa, band.E0_low_Pa, band.E0_high_Pa};
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
  std::vector<Material> moduli;
  std::set<double> ratios;
  for (const SpecimenReport& specimen : specimens) {
    if (const auto modulus = modulus_of(specimen)) {
      moduli.push_back(*modulus);
      ratios.insert(modulus->mixing_ratio);
    }
  }
  if (moduli.size() < 4 || ratios.size() < 2) return std::nullopt;
  return law_from(fit_mixing_ratio(moduli));
}

}  // namespace viscard
