#include "tests/support/golden.h"

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string_view>

namespace viscard::test {
namespace {

bool is_number_start(std::string_view text, std::size_t at) {
  const auto is_digit = [&](std::size_t i) {
    return i < text.size() && text[i] >= '0' && text[i] <= '9';
  };
  const bool follows_word =
      at > 0 &&
      (std::isalnum(static_cast<unsigned char>(text[at - 1])) != 0 || text[at - 1] == '_');
  return !follows_word && (is_digit(at) || (text[at] == '-' && is_digit(at + 1)));
}

// Removes a number from the front of both lines; false if they differ by more than allowed.
bool same_number(std::string_view& a, std::string_view& b, double relative, double absolute) {
  double first = 0.0, second = 0.0;
  const auto end_a = std::from_chars(a.data(), a.data() + a.size(), first).ptr;
  const auto end_b = std::from_chars(b.data(), b.data() + b.size(), second).ptr;
  a.remove_prefix(static_cast<std::size_t>(end_a - a.data()));
  b.remove_prefix(static_cast<std::size_t>(end_b - b.data()));
  return std::abs(first - second) <= relative * std::abs(first) + absolute;
}

bool same_line(std::string_view expected, std::string_view found, double relative,
               double absolute) {
  if (expected == found) return true;
  const std::string_view whole_expected = expected, whole_found = found;
  while (!expected.empty() && !found.empty()) {
    const bool is_number =
        is_number_start(whole_expected, whole_expected.size() - expected.size()) &&
        is_number_start(whole_found, whole_found.size() - found.size());
    if (is_number) {
      if (!same_number(expected, found, relative, absolute)) return false;
      continue;
    }
    if (expected.front() != found.front()) return false;
    expected.remove_prefix(1);
    found.remove_prefix(1);
  }
  return expected.empty() && found.empty();
}

}  // namespace

std::string golden_difference(const std::string& name, const std::string& text, double relative,
                              double absolute) {
  const std::filesystem::path path =
      std::filesystem::path(VISCARD_SOURCE_DIR) / "tests" / "golden" / name;
  if (const char* update = std::getenv("VISCARD_UPDATE_GOLDEN"); update && *update == '1') {
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << text;
    return "";
  }
  std::ifstream file(path, std::ios::binary);
  if (!file) return path.string() + " is not there; write it with VISCARD_UPDATE_GOLDEN=1";
  std::istringstream found(text);
  std::string expected_line, found_line;
  for (int number = 1;; ++number) {
    const bool has_expected = static_cast<bool>(std::getline(file, expected_line));
    const bool has_found = static_cast<bool>(std::getline(found, found_line));
    if (!has_expected && !has_found) return "";
    const std::string where = name + ":" + std::to_string(number) + ": ";
    if (!has_expected) return where + "expected the end, found '" + found_line + "'";
    if (!has_found) return where + "expected '" + expected_line + "', found the end";
    if (!same_line(expected_line, found_line, relative, absolute)) {
      return where + "expected '" + expected_line + "', found '" + found_line + "'";
    }
  }
}

}  // namespace viscard::test
