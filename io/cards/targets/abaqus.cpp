// Abaqus. Sources: Keywords Reference (*ELASTIC: MODULI defaults to LONG TERM; *VISCOELASTIC,
// TIME=PRONY: rows g_i, k_i, tau_i); Analysis User's Manual, time domain viscoelasticity (*TRS:
// ln A = (E_0/R) (1/(T - T_Z) - 1/(T_0 - T_Z)), with R and T_Z of *PHYSICAL CONSTANTS). Laws of rubber:
// keyword_law.h.
#include "io/cards/keyword_lines.h"
#include "io/cards/known_mistakes.h"
#include "io/cards/targets/card_targets.h"
#include "io/cards/targets/keyword_law.h"

#include <fmt/format.h>

#include <stdexcept>

namespace viscard {
namespace {

constexpr const char* kMissingKeyword = "*ELASTIC lacks MODULI=INSTANTANEOUS";

// For an Arrhenius shift in C and J/mol; keywords of the model, not of the material.
std::string physical_constants() {
  return fmt::format("*PHYSICAL CONSTANTS, ABSOLUTE ZERO={}, UNIVERSAL GAS CONSTANT={}\n",
                     kAbsoluteZero_C, kGasConstant_J_mol_K);
}

std::string write_abaqus(const CardBody& body) {
  const auto number = number_of_20;
  const CardNumbers& numbers = body.numbers;
  std::string out = keyword_head(body.name, numbers.density) +
                    fmt::format("*ELASTIC, MODULI=INSTANTANEOUS\n{}, {}\n", number(numbers.young),
                                number(numbers.poisson)) +
                    prony_block("TIME", numbers.branches);
  if (!numbers.shift) return out;
  // log10 a_T = -C1 (T - T0)/(C2 + T - T0)
  if (numbers.shift->law == ShiftLaw::kWlf) {
    return out + "*TRS, DEFINITION=WLF\n" + wlf_row(*numbers.shift);
  }
  return out + "*TRS, DEFINITION=ARRHENIUS\n" +
         arrhenius_row(*numbers.shift, ArrheniusRow::kEnergy) +
         "** The model needs: " + physical_constants();
}

void read_prony(const KeywordBlock& block, ReadCard& card) {
  if (!block.has("TIME=PRONY")) {
    throw std::runtime_error(at_line(block.line, "only *VISCOELASTIC, TIME=PRONY can be read"));
  }
  read_prony_rows(block.data, card);
}

void read_abaqus(const std::string& text, ReadCard& card) {
  bool has_elastic = false, is_instantaneous = false;
  const std::vector<KeywordBlock> blocks = keyword_blocks(card_lines(text, "**"), '*');
  check_single_material(blocks, card);
  for (const KeywordBlock& block : blocks) {
    if (block.keyword == "*MATERIAL") {
      card.name = block.name();
    } else if (block.keyword == "*DENSITY") {
      card.numbers.density = density_in(block);
    } else if (block.keyword == "*ELASTIC") {
      has_elastic = true;
      is_instantaneous = block.has("MODULI=INSTANTANEOUS");
      read_elastic(block, card, card.numbers);
    } else if (block.keyword == "*TRS") {
      read_shift_rows(block, ArrheniusRow::kEnergy, card);
    } else if (block.keyword == "*VISCOELASTIC") {
      read_prony(block, card);
    }
    check_static_step(block, "*VISCO or a dynamic step", card);
  }
  require_in_card(has_elastic, "*ELASTIC");
  if (is_instantaneous || card.numbers.branches.empty()) return;
  card.understood.at = ModulusAt::kLongTerm;
  card.missing_keyword = kMissingKeyword;
}

std::vector<DeckFile> abaqus_deck(const DeckInput& input, const std::string& name) {
  const auto number = number_of_20;
  std::string out = keyword_cube() + "*ELEMENT, TYPE=C3D8H, ELSET=E\n1, 1, 2, 3, 4, 5, 6, 7, 8\n" +
                    input.card.text + "*SOLID SECTION, ELSET=E, MATERIAL=" + input.card.name +
                    "\n,\n" + keyword_rollers_and_ramp(input);
  if (const auto& shift = input.card.written.shift) {
    // Abaqus starts at 0 degrees where no temperature is set.
    if (shift->law == ShiftLaw::kArrhenius) out += physical_constants();
    out += "*INITIAL CONDITIONS, TYPE=TEMPERATURE\nNALL, " + number(shift->T_ref_C) + "\n";
  }
  for (const DeckBlock& block : input.blocks()) {
    out += fmt::format("*STEP, INC=1000000\n*VISCO\n{0}, {1}, {0}, {0}\n", number(block.step),
                       number(block.length));
    out += keyword_pull(input);
    out += input.is_creep() ? "*NODE PRINT, NSET=TOP\nU3\n"
                            : "*NODE PRINT, NSET=BASE, TOTALS=YES\nRF3\n";
    out += "*END STEP\n";
  }
  return {{name + ".inp", out}};
}

// The only way to get the long-term modulus here is to leave the keyword out.
void add_abaqus_mistakes(const CardContext& context, std::vector<CardMistake>& list) {
  if (context.target.at != ModulusAt::kLongTerm) return;
  for (CardMistake& mistake : list) {
    if (mistake.name != "instantaneous-modulus-as-long-term") continue;
    mistake.name = "E0-without-instantaneous";
    mistake.text = std::string("E is the instantaneous modulus but ") + kMissingKeyword +
                   "; Abaqus takes it for the long-term one";
  }
}

}  // namespace

CardTarget abaqus_target() {
  return {.name = "abaqus",
          .code = "Abaqus",
          .extension = ".inp",
          .comment = "**",
          .write = write_abaqus,
          .read = read_abaqus,
          .deck = DeckWriter{abaqus_deck, "abaqus job={}"},
          .laws = LawColumn{
              .write = [](const CardBody& body) { return write_keyword_law(body, false); },
              .read = [](const std::string& text,
                         ReadCard& card) { read_keyword_law(text, false, card); },
              .keywords = keyword_laws(),
              .volume = keyword_law_volume("D_1") + "; D_1 = 2/K, 0: incompressible",
              .may_be_incompressible = true,
              .takes_terms = true,
              .terms = "the law at once, g_i of its deviator, constant bulk modulus, tau_i; "
                       "Simo's rule at large strain (Theory Guide 4.8.2), not run",
              .damage = {"*MULLINS EFFECT: r, m, beta", ""}},
          .add_mistakes = add_abaqus_mistakes,
          .is_case_sensitive = false,
          .reads_fortran_numbers = true,
          .takes_incompressible = true,
          .takes_wlf = true,
          .takes_arrhenius = true,
          .set_temperature = "*INITIAL CONDITIONS, TYPE=TEMPERATURE (0 if not given)",
          .evidence = Evidence::kParsed,
          .evidence_note = "public keyword manual; an independent reader found the numbers",
          .advice =
              "Use *VISCO or dynamic steps: *STATIC does not relax. Above nu = .475 use hybrid "
              "elements (C3D8H, C3D10H).",
          // Analysis User's Guide, Time Domain Viscoelasticity: the procedures it is active in.
          .harmonic = "refused: Abaqus ignores TIME=PRONY over frequency"};
}

}  // namespace viscard
