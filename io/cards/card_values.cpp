#include "io/cards/card_values.h"

#include "io/cards/card_lines.h"
#include "io/cards/list_differences.h"
#include "models/maths/leading_number.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace viscard {
namespace {

// A band that the user did not name has three digits.
FrequencyBand rounded(const FrequencyBand& band) {
  const auto three_digits = [](double f_Hz) { return leading_number(fmt::format("{:.3g}", f_Hz)); };
  return {three_digits(band.from_Hz), three_digits(band.to_Hz)};
}

}  // namespace

std::vector<ValuePair> paired_values(const std::vector<CardValue>& found,
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

double value_mismatch(const ValuePair& pair) {
  const bool are_both = pair.found != nullptr && pair.expected != nullptr;
  return are_both ? relative_mismatch(pair.found->value, pair.expected->value) : 1.0;
}

std::string pair_in_words(const ValuePair& pair) {
  if (pair.found == nullptr) return pair.expected->name + " is missing";
  if (pair.expected == nullptr) return pair.found->name + " is not expected";
  return fmt::format("{} is {:.6g} where {:.6g} is expected{}", pair.found->name, pair.found->value,
                     pair.expected->value, factor_of(pair.found->value, pair.expected->value));
}

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
  for (const ValuePair& pair : paired_values(read.values, expected)) {
    if (!(value_mismatch(pair) <= kSameValue)) {
      throw std::logic_error("viscard wrote a wrong card: " + pair_in_words(pair));
    }
  }
  card.written = body.material;
  card.fidelity.push_back({"numbers", Mapping::kExact, ""});
  if (body.target.band_note == nullptr) return;
  card.fidelity.push_back({"harmonic", Mapping::kApproximated, body.target.band_note(body)});
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
  std::string_view rest;
  FrequencyBand band;
  band.from_Hz = leading_number(std::string_view(text).substr(at + 6), &rest);
  if (!rest.starts_with(" to ")) return std::nullopt;
  band.to_Hz = leading_number(rest.substr(4));
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
