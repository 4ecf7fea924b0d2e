#include "io/capture/capture_header.h"
#include "io/flow/fit_file.h"
#include "io/flow/input_files.h"
#include "io/materials/material_file.h"
#include "models/maths/text_of_number.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>

namespace viscard {
namespace {

bool is_material_file(const std::string& file) {
  return std::filesystem::path(file).extension() == ".json" && !looks_like_capture(file);
}

// The law compares terms one by one, so all specimens need the same number: that of the material
// files, or the most frequent choice among the measured specimens (the smallest of equals).
int common_order(const std::vector<FittedFile>& fitted, const std::vector<Material>& given) {
  if (!given.empty()) return static_cast<int>(given.front().terms.size());
  std::map<int, int> votes;
  for (const FittedFile& one : fitted) ++votes[static_cast<int>(one.result.terms.size())];
  return std::max_element(votes.begin(), votes.end(),
                          [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

void refit_others(std::vector<FittedFile>& fitted, int order, const JointRequest& request) {
  FitRequest forced = request.fit;
  forced.options.n_terms = order;
  for (FittedFile& one : fitted) {
    if (static_cast<int>(one.result.terms.size()) == order) continue;
    if (request.note) {
      request.note(fmt::format("{}: fitted again with {}, as the other specimens, instead of {}",
                               one.path, counted(static_cast<std::size_t>(order), "term"),
                               one.result.terms.size()));
    }
    one = fit_file(one.path, forced);
  }
}

std::vector<Material> specimens_of(const JointRequest& request) {
  refuse_repeated_files(request.files);
  std::vector<std::string> measured;
  std::vector<Material> given;
  for (const std::string& file : request.files) {
    if (is_material_file(file)) {
      given.push_back(read_material(file).material);
      if (given.back().name.empty()) {
        given.back().name = std::filesystem::path(file).stem().string();
      }
    } else {
      measured.push_back(file);
    }
  }
  std::vector<FittedFile> fitted = fit_files(measured, request.fit, request.progress);
  if (!fitted.empty()) refit_others(fitted, common_order(fitted, given), request);
  // In the order of the files.
  std::vector<Material> specimens;
  auto next_given = given.begin();
  auto next_fitted = fitted.begin();
  for (std::size_t i = 0; i < request.files.size(); ++i) {
    specimens.push_back(is_material_file(request.files[i])
                            ? *next_given++
                            : material_from_fitted(*next_fitted++, request.material));
    if (!request.ratios.empty()) specimens.back().mixing_ratio = request.ratios[i];
  }
  return specimens;
}

}  // namespace

RatioFit fit_jointly(const JointRequest& request) {
  return fit_mixing_ratio(specimens_of(request), request.options);
}

}  // namespace viscard
