#include "models/maths/leading_number.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>

namespace viscard {

double leading_number(std::string_view text, std::string_view* rest) {
  if (rest != nullptr) *rest = text;
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return 0.0;
  std::string_view digits = text.substr(first);
  if (digits.starts_with("+-")) return 0.0;
  if (digits.front() == '+') digits.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error == std::errc::invalid_argument) return 0.0;
  const std::string_view number = digits.substr(0, static_cast<std::size_t>(end - digits.data()));
  if (rest != nullptr) *rest = digits.substr(number.size());
  if (error != std::errc::result_out_of_range) return value;
  // Too large, or so small that only its exponent tells.
  const std::size_t exponent = number.find_first_of("eE");
  const bool is_small = exponent == std::string_view::npos
                            ? number.find_first_of("123456789") > number.find('.')
                            : number[exponent + 1] == '-';
  if (is_small) return 0.0;
  const double infinity = std::numeric_limits<double>::infinity();
  return number.front() == '-' ? -infinity : infinity;
}

std::string scpi_text(double value, int decimals) {
  std::array<char, 400> buffer{};
  const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                          std::chars_format::scientific, decimals);
  if (error != std::errc()) return "+0.0E+00";
  std::string text(buffer.data(), end);
  std::replace(text.begin(), text.end(), 'e', 'E');
  return (text.front() == '-' ? "" : "+") + text;
}

}  // namespace viscard
