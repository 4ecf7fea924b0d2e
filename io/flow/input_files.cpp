#include "io/flow/input_files.h"

#include "io/basics/atomic_file.h"
#include "io/capture/capture_header.h"
#include "io/flow/fit_request.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <stdexcept>

namespace viscard {
namespace {

[[noreturn]] void refuse_second(const std::string& first, const std::string& second) {
  const std::string what =
      first == second ? second + " is given twice" : second + " has the same contents as " + first;
  throw std::runtime_error(what + "; each record counts once. Remove one of the two");
}

[[noreturn]] void refuse_copy(const std::string& first, const std::string& second) {
  throw std::runtime_error(
      second + " holds the same record as " + first +
      ", written in another way; each record counts once. Remove one of the two");
}

bool are_close(double a, double b, double relative) {
  return std::abs(a - b) <= relative * std::max(std::abs(a), std::abs(b));
}

bool are_copies(const FittedFile& a, const FittedFile& b) {
  const FitResult &one = a.result, &other = b.result;
  // Other units and fewer digits change the last digits of the readings.
  constexpr double kNumber = 1e-5, kSum = 1e-3;
  if (one.kind != other.kind || one.n_samples != other.n_samples ||
      one.terms.size() != other.terms.size()) {
    return false;
  }
  if (!are_close(one.E0_Pa, other.E0_Pa, kNumber) ||
      !are_close(one.E_inf_Pa, other.E_inf_Pa, kNumber) || !are_close(one.rss, other.rss, kSum)) {
    return false;
  }
  for (std::size_t i = 0; i < one.terms.size(); ++i) {
    if (!are_close(one.terms[i].tau_s, other.terms[i].tau_s, kSum)) return false;
  }
  return true;
}

}  // namespace

bool is_material_file(const std::string& file) {
  return std::filesystem::path(file).extension() == ".json" && !looks_like_capture(file);
}

void refuse_copies(const std::vector<const FittedFile*>& fitted) {
  for (std::size_t i = 0; i < fitted.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (are_copies(*fitted[k], *fitted[i])) refuse_copy(fitted[k]->path, fitted[i]->path);
    }
  }
}

void refuse_repeated_files(const std::vector<std::string>& files) {
  std::map<std::uintmax_t, std::vector<std::size_t>> by_size;  // only equal sizes need a hash
  for (std::size_t i = 0; i < files.size(); ++i) {
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(files[i], error);
    if (error) continue;  // a pipe, or no file: the reader reports it
    by_size[size].push_back(i);
  }
  for (const auto& [size, members] : by_size) {
    if (members.size() < 2) continue;
    std::map<std::string, std::size_t> first_with;
    for (const std::size_t i : members) {
      const auto [first, is_new] = first_with.emplace(sha256_of_file(files[i]), i);
      if (!is_new) refuse_second(files[first->second], files[i]);
    }
  }
}

}  // namespace viscard
