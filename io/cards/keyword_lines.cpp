#include "io/cards/keyword_lines.h"

#include "io/basics/number_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <stdexcept>

namespace viscard {
namespace {

void add_words(const std::string& text, KeywordBlock& block) {
  for (std::string word : cells(text, ',')) {
    word = upper(word);
    if (block.keyword.empty()) {
      block.keyword = word;
    } else if (std::erase(word, ' '); !word.empty()) {
      if (word[0] == '=')
        throw std::runtime_error(at_line(block.line, "'" + word + "' lacks the name before '='"));
      block.parameters.push_back(word);
    }
  }
}

}  // namespace

bool KeywordBlock::has(const std::string& parameter) const {
  return std::find(parameters.begin(), parameters.end(), parameter) != parameters.end();
}

std::string KeywordBlock::name() const {
  for (const std::string_view word : split(line.text, ',')) {
    const std::size_t equals = word.find('=');
    if (equals != std::string::npos && upper(trimmed(word.substr(0, equals))) == "NAME") {
      return std::string(trimmed(word.substr(equals + 1)));
    }
  }
  return "";
}

const CardLine& KeywordBlock::first_data() const {
  if (data.empty()) throw std::runtime_error(at_line(line, keyword + " has no data line"));
  return data.front();
}

std::vector<KeywordBlock> keyword_blocks(const std::vector<CardLine>& lines, char mark) {
  std::vector<KeywordBlock> blocks;
  for (const CardLine& line : lines) {
    const std::string text(trimmed(line.text));
    if (text.empty()) continue;
    // A keyword line that ends with a comma continues on the next line.
    const bool continues = !blocks.empty() && blocks.back().data.empty() &&
                           trimmed(blocks.back().line.text).ends_with(',');
    if (text[0] != mark && !continues) {
      if (!blocks.empty()) blocks.back().data.push_back(line);
      continue;
    }
    if (continues) {
      blocks.back().line.text = std::string(trimmed(blocks.back().line.text)) + text;
      add_words(text, blocks.back());
    } else {
      KeywordBlock block{line, "", {}, {}};
      add_words(text, block);
      blocks.push_back(block);
    }
  }
  return blocks;
}

std::vector<CardLine> mapdl_commands(const std::string& text) {
  std::vector<CardLine> commands;
  for (const CardLine& line : card_lines(text, "!")) {
    for (const std::string& command : cells(line.text.substr(0, line.text.find('!')), '$'))
      commands.push_back({line.number, command});
  }
  return commands;
}

void check_width(const CardLine& line, std::size_t most, ReadCard& card) {
  std::vector<std::string> row = cells(line.text, ',');
  while (!row.empty() && row.back().empty()) row.pop_back();
  if (row.size() <= most) return;
  // "1,88" leaves whole numbers on both sides of the comma.
  const auto is_whole = [](const std::string& cell) {
    return !cell.empty() && std::all_of(cell.begin(), cell.end(),
                                        [](unsigned char c) { return std::isdigit(c) != 0; });
  };
  for (std::size_t i = 0; i + 1 < row.size(); ++i) {
    if (!is_whole(row[i]) || !is_whole(row[i + 1].substr(0, row[i + 1].find_first_of("eE"))))
      continue;
    card.add(
        "decimal-comma",
        at_line(line, fmt::format("{} numbers stand where at most {} belong: a decimal comma in "
                                  "'{},{}' (write a point), or a column that is not read",
                                  row.size(), most, row[i], row[i + 1])));
    return;
  }
  card.add(
      "column-not-read",
      at_line(line, fmt::format("column {}, '{}', is not read (a temperature?); {} belong there",
                                most + 1, row[most], most)),
      false);
}

void check_single_material(const std::vector<KeywordBlock>& blocks, ReadCard& card) {
  const auto all = material_findings(blocks, false);
  card.findings.insert(card.findings.end(), all.begin(), all.end());
}

std::vector<CardFinding> material_findings(const std::vector<KeywordBlock>& blocks,
                                           bool may_have_several) {
  std::vector<CardFinding> out;
  const auto add = [&](const char* name, const std::string& text) {
    out.push_back({name, text, true});
  };
  bool has_material = false;
  std::vector<std::string> keywords;  // of the material
  for (const KeywordBlock& block : blocks) {
    const std::string word = block.keyword.substr(1);
    if (word == "MATERIAL") {
      if (has_material && !may_have_several) {
        add("several-materials",
            at_line(block.line, "a second material begins; choose one by --material-name"));
        return out;
      }
      has_material = true;
      keywords.clear();
      if (block.name().empty())
        add("missing-name", at_line(block.line, "the material has no NAME=, which solvers need"));
      if (!block.data.empty()) {
        add("data-without-keyword",
            at_line(block.data.front(), "'" + std::string(trimmed(block.data.front().text)) +
                                            "' stands below MATERIAL, which takes no data"));
      }
    }
    for (const char* law : {"ELASTIC", "HYPERELASTIC", "VISCOELASTIC", "DENSITY", "CREEP", "TRS"}) {
      if (word != law) continue;
      if (std::find(keywords.begin(), keywords.end(), word) != keywords.end())
        add("doubled-keyword",
            at_line(block.line, block.keyword + " stands in the material twice; delete one"));
      keywords.push_back(word);
    }
  }
  if (!has_material) add("missing-material", "no keyword MATERIAL begins the material");
  return out;
}

double density_in(const KeywordBlock& block) {
  const CardLine& line = block.first_data();
  return cell_number(cells(line.text, ','), 0, line, "density");
}

std::string keyword_head(const std::string& name, double density) {
  return "*MATERIAL, NAME=" + name + "\n" +
         (density > 0.0 ? "*DENSITY\n" + number_of_20(density) + ",\n" : "");
}

std::string prony_block(const char* domain, const std::vector<CardBranch>& branches) {
  std::string out = branches.empty() ? "" : fmt::format("*VISCOELASTIC, {}=PRONY\n", domain);
  for (const CardBranch& branch : branches) {
    out += number_of_20(branch.shear) + ", " + number_of_20(branch.bulk) + ", " +
           number_of_20(branch.time) + "\n";
  }
  return out;
}

void read_prony_rows(const std::vector<CardLine>& rows, ReadCard& card) {
  for (const CardLine& line : rows) {
    const auto row = cells(line.text, ',');
    check_width(line, 3, card);
    card.numbers.branches.push_back({cell_number(row, 0, line, "g_i"),
                                     cell_number_or_zero(row, 1, line, "k_i"),
                                     cell_number(row, 2, line, "tau_i")});
  }
}

void read_elastic(const KeywordBlock& block, ReadCard& card, CardNumbers& numbers) {
  const CardLine& line = block.first_data();
  const auto row = cells(line.text, ',');
  numbers.young = cell_number(row, 0, line, "E");
  numbers.poisson = cell_number(row, 1, line, "nu");
  // A third column is a temperature, if the second is a Poisson ratio.
  const bool is_ratio = numbers.poisson > -1.0 && numbers.poisson <= 0.5;
  check_width(line, is_ratio ? 3 : 2, card);
  for (std::size_t i = 2; i < row.size(); ++i) card.also_read += " " + row[i];
  if (block.data.size() < 2) return;
  card.add("more-elastic-rows",
           at_line(block.data[1], "only the first row of " + block.keyword +
                                      " is read; the others hold at other temperatures"),
           false);
}

void read_shift_rows(const KeywordBlock& block, ArrheniusRow form, ReadCard& card) {
  const bool is_arrhenius = block.has("DEFINITION=ARRHENIUS");
  if (!block.parameters.empty() && !block.has("DEFINITION=WLF") && !is_arrhenius) {
    card.add("shift-not-read", at_line(block.line, "only DEFINITION=WLF and ARRHENIUS are read"));
    return;
  }
  const CardLine& line = block.first_data();
  const auto row = cells(line.text, ',');
  if (is_arrhenius) {
    const bool is_ratio = form == ArrheniusRow::kRatioAndZero;
    const double zero = is_ratio ? cell_number(row, 2, line, "absolute zero") : kAbsoluteZero_C;
    card.numbers.shift =
        TemperatureShift{.law = ShiftLaw::kArrhenius,
                         .T_ref_C = cell_number(row, 0, line, "T_ref") - zero + kAbsoluteZero_C,
                         .activation_J_mol = cell_number(row, 1, line, "E_a") *
                                             (is_ratio ? kGasConstant_J_mol_K : 1.0)};
    return;
  }
  card.numbers.shift = TemperatureShift{.T_ref_C = cell_number(row, 0, line, "T_ref"),
                                        .C1 = cell_number(row, 1, line, "C1"),
                                        .C2_K = cell_number(row, 2, line, "C2")};
}

void check_static_step(const KeywordBlock& block, const char* wanted, ReadCard& card) {
  if (block.keyword != "*STATIC" || block.has("LONGTERM")) return;
  card.add("static-step",
           at_line(block.line, std::string("a *STATIC step does not relax; use ") + wanted));
}

void require_in_card(bool is_there, const std::string& what) {
  if (!is_there) throw std::runtime_error("the card has no " + what);
}

std::string number_of_20(double value) {
  return number_within(value, 20);
}

std::string arrhenius_row(const TemperatureShift& shift, ArrheniusRow form) {
  if (form == ArrheniusRow::kEnergy) {
    return fmt::format("{}, {}\n", number_of_20(shift.T_ref_C),
                       number_of_20(shift.activation_J_mol));
  }
  return fmt::format("{}, {}, {}\n", number_of_20(shift.T_ref_C),
                     number_of_20(shift.activation_J_mol / kGasConstant_J_mol_K),
                     number_of_20(kAbsoluteZero_C));
}

std::string wlf_row(const TemperatureShift& shift) {
  return fmt::format("{}, {}, {}\n", number_of_20(shift.T_ref_C), number_of_20(shift.C1),
                     number_of_20(shift.C2_K));
}

std::string keyword_cube() {
  return "*NODE, NSET=NALL\n1, 0., 0., 0.\n2, 1., 0., 0.\n3, 1., 1., 0.\n4, 0., 1., 0.\n"
         "5, 0., 0., 1.\n6, 1., 0., 1.\n7, 1., 1., 1.\n8, 0., 1., 1.\n"
         "*NSET, NSET=BASE\n1, 2, 3, 4\n*NSET, NSET=TOP\n5, 6, 7, 8\n";
}

std::string keyword_rollers_and_ramp(const DeckInput& input) {
  std::string out = "*BOUNDARY\nBASE, 3, 3\n1, 1, 2\n4, 1, 1\n5, 1, 2\n8, 1, 1\n2, 2, 2\n6, 2, 2\n";
  if (input.is_confined()) out += "2, 1, 1\n3, 1, 2\n4, 2, 2\n6, 1, 1\n7, 1, 2\n8, 2, 2\n";
  out += "*AMPLITUDE, NAME=RAMP, TIME=TOTAL TIME\n0., 0.\n";
  double load = 0.0;
  for (const DeckBlock& block : input.blocks()) {
    if (block.load != load) out += fmt::format("{}, {}.\n", number_of_20(block.end), block.load);
    load = block.load;
  }
  return out + fmt::format("{}, {}.\n", number_of_20(2.0 * input.end()), load);
}

std::string keyword_pull(const DeckInput& input) {
  return fmt::format("{}, AMPLITUDE=RAMP\nTOP, 3, {}{}\n",
                     input.is_creep() ? "*CLOAD" : "*BOUNDARY", input.is_creep() ? "" : "3, ",
                     number_of_20(input.pull()));
}

}  // namespace viscard
