#include "io/basics/number_text.h"

#include "models/maths/leading_number.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <limits>

namespace viscard {
namespace {

// "6.1e-05" -> "6.1E-5", "1e+06" -> "1E6", "0.5" -> ".5": every character counts.
std::string squeezed(std::string text) {
  const std::size_t e = text.find('e');
  std::string exponent;
  if (e != std::string::npos) {
    exponent = text.substr(e + 1);
    text.erase(e);
    const bool negative = exponent[0] == '-';
    exponent.erase(0, exponent.find_first_not_of("+-0"));
    exponent = (negative ? "E-" : "E") + exponent;
  }
  if (text.rfind("0.", 0) == 0) text.erase(0, 1);
  if (text.rfind("-0.", 0) == 0) text.erase(1, 1);
  if (text.find('.') != std::string::npos) {
    while (text.back() == '0') text.pop_back();
  } else if (exponent.empty()) {
    text += '.';  // a real, never an integer
  }
  if (!exponent.empty() && text.find('.') == std::string::npos) text += '.';
  return text + exponent;
}

}  // namespace

std::string text_from_number(double value) {
  std::array<char, 40> buffer{};
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return {buffer.data(), result.ptr};
}

std::string number_within(double value, int columns) {
  std::string text = fmt::format("{}", value);
  for (int digits = 17; static_cast<int>(text.size()) > columns && digits > 1; --digits) {
    text = fmt::format("{:.{}g}", value, digits);
  }
  return text;
}

std::string nearest_number(double value, int columns) {
  if (value == 0.0) return "0.0";
  std::string best;
  double best_error = std::numeric_limits<double>::infinity();
  const auto consider = [&](const std::string& text) {
    if (static_cast<int>(text.size()) > columns) return;
    const double error = std::abs(leading_number(text) - value);
    if (error < best_error || (error == best_error && text.size() < best.size())) {
      best = text;
      best_error = error;
    }
  };
  for (int digits = 0; digits <= columns; ++digits) {
    const std::string scientific = squeezed(fmt::format("{:.{}e}", value, digits));
    consider(scientific);
    if (std::abs(value) < 1e15) {
      const std::string fixed = fmt::format("{:.{}f}", value, digits);
      if (leading_number(fixed) != 0.0) consider(squeezed(fixed));
    }
  }
  return best;
}

std::string csv_cell(std::string_view text) {
  // What a spreadsheet would carry out is text for it behind an apostrophe; "-5 um" is none.
  const bool is_number =
      text.size() > 1 && std::string_view("0123456789.").find(text[1]) != std::string_view::npos;
  const bool is_formula =
      !text.empty() && (std::string_view("=@\t\r").find(text[0]) != std::string_view::npos ||
                        ((text[0] == '+' || text[0] == '-') && !is_number));
  std::string cell = is_formula ? "\"'" : "\"";
  for (const char c : text) {
    cell += c;
    if (c == '"') cell += c;
  }
  return cell + '"';
}

}  // namespace viscard
