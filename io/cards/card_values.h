#pragma once

#include "io/cards/card.h"
#include "io/cards/card_lines.h"
#include "io/cards/read_card.h"

#include <optional>
#include <string>
#include <vector>

namespace viscard {

// Cards from which no whole material can be read back (CardTarget::values): tables over frequency,
// reductions to a band, files of branches alone. All their numbers are compared by name.

// Values of the same name, in their order; a name that one side lacks has no partner.
struct ValuePair {
  const CardValue* found = nullptr;
  const CardValue* expected = nullptr;
};
std::vector<ValuePair> paired_values(const std::vector<CardValue>& found,
                                     const std::vector<CardValue>& expected);
// Relative; 1 without a partner.
double value_mismatch(const ValuePair& pair);
std::string pair_in_words(const ValuePair& pair);
inline constexpr double kSameValue = 1e-9;  // what writing and reading may change

// The frequencies of a card: those of its table, or the two ends of its band; empty for a target
// without a band. Throws std::invalid_argument for a band that is none.
std::vector<double> card_frequencies_Hz(const Material& material, const CardTarget& target,
                                        const std::optional<FrequencyBand>& band);

// Reads the text that the target writes for the body and compares every number. Adds what the card
// says of its band to the fidelity. Throws std::logic_error if a number differs.
void read_back_values(const CardBody& body, Card& card);

// The line of a header that states the band, and whether the material's data cover it.
std::string band_line(const FrequencyBand& band, const Material& material);

// The band in "band: 10 to 1000 Hz" of a header.
std::optional<FrequencyBand> stated_band(const std::string& text);

// For readers and writers of these cards.

// Throws std::logic_error if there is no value of that name.
double value_of(const std::vector<CardValue>& values, const std::string& name);
// "row 3: G'"
std::string row_name(std::size_t row, const char* column);
// Adds a frequency of a table, in cycles per unit of time of the card. One that is not above the
// one before it is a mistake; throws std::runtime_error for one that is not positive and finite.
void add_frequency(double number, const CardLine& line, ReadCard& card);
// The number of rows, and the error of linear interpolation between them.
std::string table_note(const CardBody& body);

}  // namespace viscard
