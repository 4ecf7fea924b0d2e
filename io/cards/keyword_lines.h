#pragma once

#include "io/cards/card_lines.h"
#include "io/cards/deck.h"
#include "io/cards/read_card.h"

#include <string>
#include <vector>

namespace viscard {

// Keyword files with free-format numbers: Abaqus, CalculiX ("*KEYWORD, PARAMETER=VALUE") and
// FrontISTR ("!KEYWORD"). Readers throw std::runtime_error naming the line.

// Rows of an Arrhenius law: T_ref, E_a (Abaqus; R and absolute zero are constants of the model), or
// T_ref, E_a/R, absolute zero (FrontISTR).
enum class ArrheniusRow { kEnergy, kRatioAndZero };

// A keyword line, its parameters upper-cased without blanks, and the data lines below it.
struct KeywordBlock {
  CardLine line;
  std::string keyword;                  // "*ELASTIC"
  std::vector<std::string> parameters;  // "MODULI=INSTANTANEOUS"
  std::vector<CardLine> data;

  bool has(const std::string& parameter) const;
  std::string name() const;            // the value of NAME=, or ""
  const CardLine& first_data() const;  // throws if there is none
};

// The blocks whose keywords start with `mark`; lines above the first keyword are left out.
std::vector<KeywordBlock> keyword_blocks(const std::vector<CardLine>& lines, char mark);

// Commands of ANSYS MAPDL without comments; "$" separates those of one line.
std::vector<CardLine> mapdl_commands(const std::string& text);

double density_in(const KeywordBlock& block);
// "*MATERIAL, NAME=...", and *DENSITY if it is known (Abaqus and CalculiX).
std::string keyword_head(const std::string& name, double density);
// *VISCOELASTIC, TIME=PRONY or FREQUENCY=PRONY of Abaqus: rows g_i, k_i, tau_i; "" without branches.
std::string prony_block(const char* domain, const std::vector<CardBranch>& branches);
void read_prony_rows(const std::vector<CardLine>& rows, ReadCard& card);
// A mistake if the row has more cells than the keyword takes: a decimal comma, or a column that is
// not read.
void check_width(const CardLine& line, std::size_t most, ReadCard& card);
// Mistakes of the keywords themselves: no MATERIAL or one without NAME, data below it, a law that stands twice in a
// material, and, unless there may be several, a second material, whose numbers would be mixed.
std::vector<CardFinding> material_findings(const std::vector<KeywordBlock>& blocks,
                                           bool may_have_several);
// The same, of a card of one material.
void check_single_material(const std::vector<KeywordBlock>& blocks, ReadCard& card);
// Young's modulus and Poisson ratio of the first row; other rows are noted as a finding.
void read_elastic(const KeywordBlock& block, ReadCard& card, CardNumbers& numbers);
// T_ref, C1, C2 of a WLF law, or the row of an Arrhenius law; another law is noted as a mistake.
void read_shift_rows(const KeywordBlock& block, ArrheniusRow form, ReadCard& card);
// A mistake if the block is a *STATIC step; `wanted` is what relaxes instead.
void check_static_step(const KeywordBlock& block, const char* wanted, ReadCard& card);
// Throws "the card has no *ELASTIC".
void require_in_card(bool is_there, const std::string& what);

// At most 20 characters: Abaqus and CalculiX read 20 and drop the rest, including the exponent.
std::string number_of_20(double value);
// T_ref, C1, C2: the order of Abaqus, ANSYS and FrontISTR.
std::string wlf_row(const TemperatureShift& shift);
std::string arrhenius_row(const TemperatureShift& shift, ArrheniusRow form);

// Parts of a one-element model that Abaqus and CalculiX share: nodes 1 to 8 of the cube with the
// node sets BASE and TOP; the rollers, and the amplitude RAMP, the load at the end of each block;
// the pull of a step, a force in creep and a displacement in relaxation.
std::string keyword_cube();
std::string keyword_rollers_and_ramp(const DeckInput& input);
std::string keyword_pull(const DeckInput& input);

}  // namespace viscard
