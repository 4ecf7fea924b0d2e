#include "io/cards/card_values.h"

#include "io/cards/card_form.h"
#include "io/cards/card_header.h"
#include "io/cards/card_lines.h"
#include "io/cards/list_differences.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <stdexcept>

namespace viscard {
namespace {

constexpr double kSameValue = 1e-9;  // relative; what writing and reading may change

bool is_near(double found, double expected, double tolerance) {
  return found == expected || relative_mismatch(found, expected) <= tolerance;
}

// Values of the same name, in their order; a name that one side lacks has no partner.
struct ValuePair {
  const CardValue* found = nullptr;
  const CardValue* expected = nullptr;
};

std::vector<ValuePair> paired(const std::vector<CardValue>& found,
                              const std::vector<CardValue>& expected) {
  std::vector<ValuePair> pairs;
  std::vector<bool> is_taken(found.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    ValuePair pair{nullptr, &expected[i]};
    // Right cards state their values in this order.
    std::size_t at = i < found.size() && found[i].name == expected[i].name ? i : 0;
    while (at < found.size() && (is_taken[at] || found[at].name != expected[i].name)) ++at;
    if (at < found.size()) {
      pair.found = &found[at];
      is_taken[at] = true;
    }
    pairs.push_back(pair);
  }
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (!is_taken[i]) pairs.push_back({&found[i], nullptr});
  }
  return pairs;
}

double largest_mismatch(const std::vector<ValuePair>& pairs) {
  double largest = 0.0;
  for (const ValuePair& pair : pairs) {
    const bool are_both = pair.found != nullptr && pair.expected != nullptr;
    const double off = are_both ? relative_mismatch(pair.found->value, pair.expected->value) : 1.0;
    if (!(off <= largest)) largest = off;
  }
  return largest;
}

std::string in_words(const ValuePair& pair) {
  if (pair.found == nullptr) return pair.expected->name + " is missing";
  if (pair.expected == nullptr) return pair.found->name + " is not expected";
  return fmt::format("{} is {:.6g} where {:.6g} is expected", pair.found->name, pair.found->value,
                     pair.expected->value);
}

// One factor between a value and the expected one that has a name.
std::string factor_in_words(double ratio) {
  struct Known {
    double factor;
    const char* words;
  };
  constexpr double kTurn = 2.0 * std::numbers::pi;
  static const Known kKnown[] = {{2.0, "twice: a loss factor is twice the damping ratio"},
                                 {0.5, "half: a damping ratio is half the loss factor"},
                                 {kTurn, "2 pi times: rad/s for Hz"},
                                 {1.0 / kTurn, "1/(2 pi) times: Hz for rad/s"}};
  for (const Known& known : kKnown) {
    if (is_near(ratio, known.factor, kHandTyped)) return known.words;
  }
  const double power = ratio > 0.0 ? std::log10(ratio) : 0.5, whole = std::round(power);
  return whole != 0.0 && std::abs(power - whole) <= 1e-3
             ? fmt::format("off by 10^{:g}: another unit", whole)
             : "";
}

CardFinding finding_of(const std::vector<ValuePair>& wrong, std::size_t n_values) {
  std::string text;
  constexpr std::size_t kInWords = 4;
  for (std::size_t i = 0; i < std::min(kInWords, wrong.size()); ++i) {
    text += (text.empty() ? "" : "; ") + in_words(wrong[i]);
  }
  if (wrong.size() > kInWords) text += fmt::format("; and {} more", wrong.size() - kInWords);
  const ValuePair& first = wrong.front();
  const bool are_both = first.found != nullptr && first.expected != nullptr;
  const std::string factor =
      are_both ? factor_in_words(first.found->value / first.expected->value) : "";
  if (!factor.empty()) text += " (" + factor + ")";
  const bool is_one = wrong.size() == 1 && n_values > 1;
  return {is_one && are_both ? "one-number"
          : is_one           ? "missing-number"
                             : "numbers-differ",
          text, true};
}

// A band that nobody has named has three digits.
FrequencyBand rounded(const FrequencyBand& band) {
  const auto three_digits = [](double f_Hz) {
    return std::strtod(fmt::format("{:.3g}", f_Hz).c_str(), nullptr);
  };
  return {three_digits(band.from_Hz), three_digits(band.to_Hz)};
}

// The material as the target takes it.
CardBody expected_body(const ReadCard& read, const Material& material, const CardNumbers& numbers) {
  return {card_identifier(read.name.empty() ? material.name : read.name),
          numbers,
          read.understood,
          read.units,
          material,
          {},
          read.frequencies_Hz};
}

void require_band(const Material& reference, const CheckOptions& options, ReadCard& read) {
  const CardTarget& target = read.understood;
  if (target.band_note == nullptr || !read.frequencies_Hz.empty()) return;
  if (!options.band) {
    read.add("band-not-stated",
             "the card does not state its band; the one that the material's data support is taken "
             "(--band names another)",
             false);
  }
  read.frequencies_Hz = card_frequencies_Hz(reference, target, options.band);
}

void compare_values(const std::string& text, const Material& given, const CheckOptions& options,
                    CardCheck& check) {
  require_band(given, options, check.read);
  const Material reference = with_bulk_rule(given, check.read.understood.bulk);
  const CardNumbers numbers =
      numbers_from_material(reference, check.read.understood, check.read.units);
  const CardBody body = expected_body(check.read, reference, numbers);
  const std::vector<CardValue> expected = check.read.understood.values(body);
  const std::vector<ValuePair> pairs = paired(check.read.values, expected);
  check.E_difference = largest_mismatch(pairs);
  check.E_difference_with_bulk = check.E_difference;
  std::vector<ValuePair> wrong;
  for (const ValuePair& pair : pairs) {
    if (!(largest_mismatch({pair}) <= check.tolerance)) wrong.push_back(pair);
  }
  check.findings = check.read.findings;
  if (!wrong.empty()) check.findings.push_back(finding_of(wrong, expected.size()));
  if (!check.findings.empty()) return;
  // A text that is not as viscard writes these very numbers.
  if (*check.E_difference > kSameValue) return;
  if (const auto form = form_difference(text, body)) check.findings.push_back(*form);
}

}  // namespace

std::vector<double> card_frequencies_Hz(const Material& material, const CardTarget& target,
                                        const std::optional<FrequencyBand>& given) {
  if (target.band_note == nullptr) return {};
  const FrequencyBand band = given ? *given : rounded(supported_band(material));
  validate(band);
  if (target.rows_per_decade == 0) return {band.from_Hz, band.to_Hz};
  const double decades = std::log10(band.to_Hz / band.from_Hz);
  const double rows = std::ceil(decades * target.rows_per_decade) + 1.0;
  constexpr double kMostRows = 2001.0;
  return frequencies_Hz(band, static_cast<int>(std::clamp(rows, 2.0, kMostRows)));
}

void read_back_values(const CardBody& body, Card& card) {
  ReadCard read{.understood = body.target, .units = body.units, .units_were_stated = true};
  body.target.read(body.target.write(body), read);
  const std::vector<CardValue> expected = body.target.values(body);
  for (const ValuePair& pair : paired(read.values, expected)) {
    if (!(largest_mismatch({pair}) <= kSameValue)) {
      throw std::logic_error("viscard wrote a wrong card: " + in_words(pair));
    }
  }
  card.written = body.material;
  card.fidelity.push_back({"numbers", Mapping::kExact, ""});
  if (body.target.band_note == nullptr) return;
  card.fidelity.push_back({"harmonic", Mapping::kApproximated, body.target.band_note(body)});
}

CardCheck check_card_values(const std::string& text, const CardTarget& target,
                            const CheckOptions& options, const Material* reference) {
  CardCheck check{.read = read_card(text, target, options.units)};
  check.tolerance = options.tolerance.value_or(1e-6);
  if (check.read.frequencies_Hz.empty()) {
    if (const auto band = stated_band(text)) {
      check.read.frequencies_Hz = {band->from_Hz, band->to_Hz};
    }
  }
  if (reference != nullptr) {
    compare_values(text, *reference, options, check);
  } else {
    check.findings = check.read.findings;
  }
  if (!check.read.units_were_stated && options.units.empty()) {
    check.findings.push_back(
        {"units-not-stated",
         "the card does not state its units; it is read as SI (--units names others)", false});
  }
  check.agrees = std::none_of(check.findings.begin(), check.findings.end(),
                              [](const CardFinding& finding) { return finding.is_mistake; });
  return check;
}

std::string band_line(const FrequencyBand& band, const Material& material) {
  std::string line = fmt::format("band: {} to {} Hz", band.from_Hz, band.to_Hz);
  if (!(material.valid.t_max_s > 0.0)) return line + "; the measured window is not stated";
  const FrequencyBand measured = supported_band(material);
  constexpr double kRounding = 0.01;  // of a band that nobody has named
  const bool is_covered = band.from_Hz >= measured.from_Hz * (1.0 - kRounding) &&
                          band.to_Hz <= measured.to_Hz * (1.0 + kRounding);
  if (is_covered) return line + ", covered by the measured times";
  return line +
         fmt::format(
             "; EXTRAPOLATED: the measured times of {:g} to {:g} s cover {:.3g} to {:.3g} Hz",
             material.valid.t_min_s, material.valid.t_max_s, measured.from_Hz, measured.to_Hz);
}

std::optional<FrequencyBand> stated_band(const std::string& text) {
  const std::size_t at = text.find("band: ");
  if (at == std::string::npos) return std::nullopt;
  char* end = nullptr;
  FrequencyBand band;
  band.from_Hz = std::strtod(text.c_str() + at + 6, &end);
  if (std::string_view(end).substr(0, 4) != " to ") return std::nullopt;
  band.to_Hz = std::strtod(end + 4, &end);
  const bool is_band = band.from_Hz > 0.0 && band.to_Hz > band.from_Hz && std::isfinite(band.to_Hz);
  return is_band ? std::optional(band) : std::nullopt;
}

double value_of(const std::vector<CardValue>& values, const std::string& name) {
  for (const CardValue& value : values) {
    if (value.name == name) return value.value;
  }
  throw std::logic_error("a card has no value " + name);
}

std::string row_name(std::size_t row, const char* column) {
  return fmt::format("row {}: {}", row + 1, column);
}

void add_frequency(double number, const CardLine& line, ReadCard& card) {
  const double frequency_Hz = from_card(number, -card.units.time_exponent);
  if (!(frequency_Hz > 0.0) || !std::isfinite(frequency_Hz)) {
    throw std::runtime_error(at_line(line, "a frequency must be above 0"));
  }
  if (!card.frequencies_Hz.empty() && frequency_Hz <= card.frequencies_Hz.back()) {
    card.add("frequencies-not-ascending",
             at_line(line, "the frequency is not above that of the row before"));
  }
  card.frequencies_Hz.push_back(frequency_Hz);
}

std::string table_note(const CardBody& body) {
  return fmt::format(
      "{} rows from {:g} to {:g} Hz; between them linear interpolation (over f or log f) is off by "
      "up to {:.1e} of |G*|",
      body.frequencies_Hz.size(), body.frequencies_Hz.front(), body.frequencies_Hz.back(),
      interpolation_error(body.material, body.frequencies_Hz));
}

}  // namespace viscard
