#include "io/flow/test_words.h"

#include "io/basics/file_kind.h"
#include "io/basics/words.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <utility>

namespace fs = std::filesystem;

namespace viscard {
namespace {

bool exists(const std::string& path) {
  std::error_code error;
  return fs::exists(path, error);
}

constexpr std::pair<const char*, FitKind> kLinearKinds[] = {{"relaxation", FitKind::kRelaxation},
                                                            {"creep", FitKind::kCreep},
                                                            {"dma", FitKind::kDma},
                                                            {"oscillation", FitKind::kDma},
                                                            {"indentation", FitKind::kIndentation}};

FitKind kind_of_test(const std::string& kind, const std::string& word, bool takes_large_strain) {
  for (const auto& [name, known] : kLinearKinds) {
    if (name == kind) return known;
  }
  for (const LargeStrainKind& large : large_strain_kinds()) {
    if (kind == large.word) {
      throw std::invalid_argument(
          word +
          " is a test at large strain, not a linear one. Fit it to a law of rubber (viscard fit " +
          quoted_for_shell({word}) +
          " --out law.json); viscard report takes law.json beside a capture, a table or a material "
          "file");
    }
  }
  const std::vector<std::string> names = kinds_of_tests(takes_large_strain);
  throw std::invalid_argument(word + ": no such file, and '" + kind + "' is no kind of test" +
                              did_you_mean(kind, names) + " Name a test as KIND=FILE with " +
                              listed(names));
}

// Nothing for a plain file.
std::optional<TestFile> test_from_word(const std::string& word, bool takes_large_strain) {
  const std::size_t sign = word.find('=');
  if (sign == std::string::npos || exists(word)) return std::nullopt;
  const std::string kind = word.substr(0, sign), path = word.substr(sign + 1);
  if (kind.find('/') != std::string::npos) return std::nullopt;
  const FitKind known = kind_of_test(kind, word, takes_large_strain);
  if (path.empty()) throw std::invalid_argument(word + " names no file; write " + kind + "=FILE");
  return TestFile{known, path};
}

}  // namespace

std::span<const LargeStrainKind> large_strain_kinds() {
  using enum FoamTest;
  static constexpr LargeStrainKind kKinds[] = {
      {"uniaxial", Deformation::kUniaxial, kUniaxial},
      {"tension", Deformation::kUniaxial, kUniaxial},
      {"compression", Deformation::kUniaxial, kUniaxial, true},
      {"planar", Deformation::kPlanar, kPlanar},
      {"pure-shear", Deformation::kPlanar, kPlanar},
      {"equibiaxial", Deformation::kEquibiaxial, kEquibiaxial},
      {"biaxial", Deformation::kEquibiaxial, kEquibiaxial},
      {"confined", Deformation::kUniaxial, kConfined, true, true},
      {"oedometer", Deformation::kUniaxial, kConfined, true, true},
      {"volumetric", Deformation::kUniaxial, kVolumetric, true, true},
      {"hydrostatic", Deformation::kUniaxial, kVolumetric, true, true},
      {"shear", Deformation::kUniaxial, kShear, false, true}};
  return kKinds;
}

std::vector<std::string> kinds_of_tests(bool with_large_strain) {
  std::vector<std::string> names;
  for (const auto& [name, kind] : kLinearKinds) names.emplace_back(name);
  if (!with_large_strain) return names;
  for (const LargeStrainKind& large : large_strain_kinds()) names.emplace_back(large.word);
  return names;
}

namespace {

// "a material", of a file that certainly holds no measured values; empty otherwise.
std::string what_is_no_test(const std::string& path) {
  constexpr std::size_t kBegin_B = 65536;
  std::ifstream file(path,
                     std::ios::binary);  // if it cannot be read, reading it as a test reports why
  std::string begin(kBegin_B, '\0');
  file.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  begin.resize(static_cast<std::size_t>(std::max<std::streamsize>(0, file.gcount())));
  const FileKind kind = kind_of_file(begin);
  const bool is_known = is_json_kind(kind) || kind == FileKind::kCard || is_toml(begin);
  return is_known ? file_kind_in_words(kind) : "";
}

}  // namespace

std::vector<TestFile> tests_from_words(const std::vector<std::string>& words,
                                       bool takes_large_strain) {
  std::vector<TestFile> tests;
  std::string plain;
  for (const std::string& word : words) {
    if (const auto test = test_from_word(word, takes_large_strain)) {
      tests.push_back(*test);
    } else if (plain.empty()) {
      plain = word;
    }
  }
  if (!tests.empty() && !plain.empty()) {
    if (const std::string what = what_is_no_test(plain); !what.empty()) {
      throw std::invalid_argument(plain + " is " + what +
                                  ", not a test: beside files that state their kind only tests can "
                                  "stand. Give the other files without KIND=, or use it apart");
    }
    throw std::invalid_argument(plain +
                                " states no kind of test, but others do; write for instance "
                                "creep=" +
                                plain + ", or fit the files apart");
  }
  return tests;
}

std::vector<std::string> paths_of(const std::vector<TestFile>& tests) {
  std::vector<std::string> paths;
  for (const TestFile& test : tests) paths.push_back(test.path);
  return paths;
}

}  // namespace viscard
