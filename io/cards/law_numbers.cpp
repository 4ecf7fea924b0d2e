#include "io/cards/law_numbers.h"

#include "io/cards/card_lines.h"
#include "io/cards/read_card.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace viscard {

using enum HyperelasticForm;

bool is_ogden(HyperelasticForm form) {
  return form == kOgden1 || form == kOgden2 || form == kOgden3;
}

bool has_ogden_form(HyperelasticForm form) {
  return is_ogden(form) || form == kNeoHooke || form == kMooneyRivlin;
}

CardNumbers as_ogden(const CardNumbers& law) {
  CardNumbers out = law;
  if (is_ogden(law.form)) return out;
  for (double& modulus : out.moduli) modulus *= 2.0;  // C10, C01
  out.shapes = {2.0};
  if (law.moduli.size() > 1) out.shapes.push_back(-2.0);
  return out;
}

std::vector<double> pairs_of(const CardNumbers& law) {
  std::vector<double> out;
  for (std::size_t i = 0; i < law.moduli.size(); ++i) {
    out.push_back(law.moduli[i]);
    out.push_back(law.shapes[i]);
  }
  return out;
}

std::vector<double> own_moduli(const CardNumbers& law) {
  std::vector<double> out;
  for (std::size_t i = 0; i < law.moduli.size(); ++i)
    out.push_back(2.0 * law.moduli[i] / law.shapes[i]);
  return out;
}

double poisson_ratio_of(const CardNumbers& law) {
  return (3.0 * law.bulk - 2.0 * law.shear) / (6.0 * law.bulk + 2.0 * law.shear);
}

double bulk_of_d(double d) {
  return d > 0.0 ? 2.0 / d : 0.0;
}

void take_law(HyperelasticForm form, const std::vector<double>& moduli,
              const std::vector<double>& shapes, CardNumbers& out) {
  out.form = form;
  out.moduli = moduli;
  out.shapes = shapes;
}

void take_ogden(const std::vector<double>& moduli, const std::vector<double>& shapes,
                CardNumbers& out) {
  constexpr std::size_t kMost = 3;
  if (moduli.empty() || moduli.size() > kMost || shapes.size() != moduli.size())
    throw std::runtime_error("a law of Ogden has 1 to 3 terms, this has " +
                             std::to_string(moduli.size()));
  const HyperelasticForm forms[] = {kOgden1, kOgden2, kOgden3};
  take_law(forms[moduli.size() - 1], moduli, shapes, out);
}

void take_own_ogden(std::vector<double> constants, std::vector<double> shapes, CardNumbers& out) {
  std::size_t n = 0;
  for (; n < constants.size() && n < shapes.size(); ++n) {
    if (constants[n] == 0.0 || shapes[n] == 0.0) break;
    constants[n] *= shapes[n] / 2.0;
  }
  constants.resize(n);
  shapes.resize(n);
  take_ogden(constants, shapes, out);
}

void take_invariant_law(const std::vector<double>& constants, CardNumbers& law) {
  static const std::vector<const char*> kNames{"C10", "C01", "C20", "C11", "C02",
                                               "C30", "C21", "C12", "C03"};
  std::vector<double> C = constants;
  C.resize(std::max(C.size(), kNames.size()), 0.0);
  const bool is_yeoh = C[2] != 0.0 || C[5] != 0.0;
  for (std::size_t i = 1; i < C.size(); ++i) {
    const bool is_of_law = i == 2 || i == 5 || (i == 1 && !is_yeoh);
    if (C[i] == 0.0 || is_of_law) continue;
    throw std::runtime_error(
        (i < kNames.size() ? kNames[i] : std::string("a constant of a higher order")) + " = " +
        fmt::format("{:g}", C[i]) + " is not of Neo-Hooke, Mooney-Rivlin or Yeoh" +
        (i == 1 ? " beside C20 and C30" : "") + ", the laws of the invariants that are read");
  }
  if (is_yeoh) return take_law(kYeoh, {C[0], C[2], C[5]}, {}, law);
  if (C[1] != 0.0) return take_law(kMooneyRivlin, {C[0], C[1]}, {}, law);
  take_law(kNeoHooke, {C[0]}, {}, law);
}

void take_foam_terms(const std::vector<double>& mu, const std::vector<double>& alpha,
                     const std::vector<double>& nu, CardNumbers& out) {
  constexpr std::size_t kMost = 6;
  if (mu.empty() || mu.size() > kMost)
    throw std::runtime_error("a foam has 1 to 6 terms, this has " + std::to_string(mu.size()));
  for (std::size_t i = 0; i < mu.size(); ++i) out.foam.push_back({mu[i], alpha[i], nu[i]});
}

void require_count(const std::vector<double>& numbers, std::size_t least, const std::string& what) {
  if (numbers.size() >= least) return;
  throw std::runtime_error(what + " has " + std::to_string(numbers.size()) + " numbers, not the " +
                           std::to_string(least) + " that its law takes");
}

void add_other_law(const CardLine& line, const std::string& text, ReadCard& card) {
  card.add("other-law", at_line(line, text));
}

void add_other_count(const CardLine& line, const std::string& text,
                     const std::vector<double>& numbers, std::size_t read, ReadCard& card) {
  card.add("other-count", at_line(line, text));
  for (std::size_t i = read; i < numbers.size(); ++i)
    card.also_read += fmt::format(" {}", numbers[i]);
}

}  // namespace viscard
