#include "fit/assembly/constraints.h"

#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <set>
#include <stdexcept>
#include <utility>

namespace viscard {

namespace {

using Stem = ParameterStem;

double number_of(const std::string& text, const std::string& whole) {
  if (const auto value = number_from_text(text)) return *value;
  throw std::invalid_argument("'" + whole + "': '" + text +
                              "' is not a number; write NAME=VALUE or NAME=LOW:HIGH in SI");
}

}  // namespace

ParameterName parameter_name(const std::string& text) {
  if (text == "E0") return {Stem::kE0, 0};
  if (text == "E_inf") return {Stem::kEInf, 0};
  const std::pair<const char*, Stem> kinds[] = {
      {"E_", Stem::kModulus}, {"g_", Stem::kShare}, {"tau_", Stem::kTime}};
  for (const auto& [prefix, stem] : kinds) {
    if (!text.starts_with(prefix)) continue;
    char* end = nullptr;
    const long term = std::strtol(text.c_str() + std::strlen(prefix), &end, 10);
    if (*end == '\0' && term >= 1 && term <= 1000) return {stem, static_cast<int>(term)};
  }
  throw std::invalid_argument(
      "'" + text +
      "' is not a parameter; there are E0, E_inf, and E_1, g_1, tau_1 ... for each term");
}

std::string range_text(const ParameterConstraint& one) {
  const std::string high = one.low == one.high ? "" : ":" + text_of(one.high);
  return one.name + " = " + text_of(one.low) + high;
}

bool uses_shares(const std::vector<ParameterConstraint>& constraints) {
  return std::any_of(constraints.begin(), constraints.end(), [](const ParameterConstraint& one) {
    const Stem stem = parameter_name(one.name).stem;
    return stem == Stem::kShare || stem == Stem::kE0;
  });
}

ParameterConstraint constraint_from_text(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) {
    throw std::invalid_argument("'" + text + "': write NAME=VALUE or NAME=LOW:HIGH in SI");
  }
  ParameterConstraint out{text.substr(0, equals), 0.0, 0.0};
  parameter_name(out.name);  // throws for an unknown name
  const std::string value = text.substr(equals + 1);
  const std::size_t colon = value.find(':');
  out.low = number_of(value.substr(0, colon), text);
  out.high = colon == std::string::npos ? out.low : number_of(value.substr(colon + 1), text);
  return out;
}

void validate(const std::vector<ParameterConstraint>& constraints, int n_terms,
              bool may_be_negative) {
  bool has_moduli = false;
  double least_shares = 0.0;
  std::set<std::string> seen;
  for (const ParameterConstraint& one : constraints) {
    const ParameterName name = parameter_name(one.name);
    const auto refuse = [&](const std::string& why) {
      throw std::invalid_argument(range_text(one) + why);
    };
    if (!seen.insert(one.name).second) {
      throw std::invalid_argument(one.name + " is constrained twice; name it once");
    }
    if (name.term > n_terms) {
      throw std::invalid_argument(one.name +
                                  " belongs to a term that does not exist; the fit has " +
                                  counted(static_cast<std::size_t>(n_terms), "term"));
    }
    if (!(one.low <= one.high) || (name.stem == Stem::kTime && !(one.low > 0.0))) {
      throw std::invalid_argument("the bounds of " + one.name +
                                  " must ascend, and times must be positive");
    }
    if (name.stem == Stem::kE0 && !(one.high > 0.0)) refuse(": E0 must be positive");
    const bool has_sign = name.stem != Stem::kE0 && name.stem != Stem::kTime;
    if (has_sign && !may_be_negative && one.low < 0.0) {
      refuse(": moduli and shares must not be negative unless --allow-negative is given");
    }
    if (name.stem == Stem::kShare) {
      if (one.low >= 1.0) refuse(": a share of E0 must be below 1");
      least_shares += one.low;
    }
    has_moduli = has_moduli || name.stem == Stem::kModulus || name.stem == Stem::kEInf;
  }
  if (least_shares >= 1.0) {
    throw std::invalid_argument(
        "the shares held sum to 1 or more, which leaves nothing for E_inf. For a liquid use "
        "--liquid");
  }
  if (has_moduli && uses_shares(constraints)) {
    throw std::invalid_argument(
        "constrain either moduli (E_inf, E_i) or E0 and shares (g_i), not both at once");
  }
}

}  // namespace viscard
