// Readers of keyword files: Abaqus, CalculiX, FrontISTR.
#include "io/cards/card_lines.h"

#include <algorithm>
#include <stdexcept>

namespace viscard {
namespace {

// A keyword line, its parameters upper-cased without blanks, and the data lines below it.
struct KeywordBlock {
  CardLine line;
  std::string keyword;                  // "*ELASTIC"
  std::vector<std::string> parameters;  // "MODULI=INSTANTANEOUS"
  std::vector<CardLine> data;

  bool has(const std::string& parameter) const {
    return std::find(parameters.begin(), parameters.end(), parameter) != parameters.end();
  }
};

void add_words(const std::string& text, KeywordBlock& block) {
  for (std::string word : cells(text, ',')) {
    word = upper(word);
    if (block.keyword.empty()) {
      block.keyword = word;
    } else if (std::erase(word, ' '); !word.empty()) {
      block.parameters.push_back(word);
    }
  }
}

std::vector<KeywordBlock> keyword_blocks(const std::vector<CardLine>& lines, char mark) {
  std::vector<KeywordBlock> blocks;
  for (const CardLine& line : lines) {
    const std::string text = trimmed(line.text);
    if (text.empty()) continue;
    // A keyword line that ends with a comma goes on in the next one.
    const bool continues = !blocks.empty() && blocks.back().data.empty() &&
                           trimmed(blocks.back().line.text).ends_with(',');
    if (text[0] != mark && !continues) {
      if (!blocks.empty()) blocks.back().data.push_back(line);
      continue;
    }
    if (continues) {
      blocks.back().line.text = trimmed(blocks.back().line.text) + text;
      add_words(text, blocks.back());
    } else {
      KeywordBlock block{line, "", {}, {}};
      add_words(text, block);
      blocks.push_back(block);
    }
  }
  return blocks;
}

std::string name_of(const KeywordBlock& block) {
  const std::vector<std::string> words = cells(block.line.text, ',');
  for (const std::string& word : words) {
    const std::size_t equals = word.find('=');
    if (equals != std::string::npos && upper(trimmed(word.substr(0, equals))) == "NAME") {
      return trimmed(word.substr(equals + 1));
    }
  }
  return "";
}

const CardLine& first_data(const KeywordBlock& block) {
  if (block.data.empty()) {
    throw std::runtime_error("line " + std::to_string(block.line.number) + ": " + block.keyword +
                             " has no data line");
  }
  return block.data.front();
}

void read_elastic(const KeywordBlock& block, ReadCard& card, CardNumbers& numbers) {
  const CardLine& line = first_data(block);
  const auto row = cells(line.text, ',');
  numbers.young = cell_number(row, 0, line, "E");
  numbers.poisson = cell_number(row, 1, line, "nu");
  if (block.data.size() < 2) return;
  card.findings.push_back({"more-elastic-rows",
                           "line " + std::to_string(block.data[1].number) +
                               ": only the first row of " + block.keyword +
                               " is read; the others hold at other temperatures",
                           false});
}

void require(bool is_there, const std::string& what) {
  if (!is_there) throw std::runtime_error("the card has no " + what);
}

// T_ref, C1, C2 of a WLF law. Other laws are not read.
void read_wlf(const KeywordBlock& block, ReadCard& card) {
  if (!block.parameters.empty() && !block.has("DEFINITION=WLF")) {
    card.findings.push_back({"shift-not-read",
                             "line " + std::to_string(block.line.number) +
                                 ": only DEFINITION=WLF is read; the shift is left out",
                             false});
    return;
  }
  const CardLine& line = first_data(block);
  const auto row = cells(line.text, ',');
  card.numbers.shift = TemperatureShift{.T_ref_C = cell_number(row, 0, line, "T_ref"),
                                        .C1 = cell_number(row, 1, line, "C1"),
                                        .C2_K = cell_number(row, 2, line, "C2")};
}

void note_static_step(const KeywordBlock& block, const char* wanted, ReadCard& card) {
  if (block.keyword == "*STATIC" && !block.has("LONGTERM")) {
    card.findings.push_back({"static-step",
                             "line " + std::to_string(block.line.number) +
                                 ": a *STATIC step does not relax; use " + wanted,
                             true});
  }
}

}  // namespace

void read_abaqus(const std::string& text, ReadCard& card) {
  bool has_elastic = false;
  for (const KeywordBlock& block : keyword_blocks(card_lines(text, "**"), '*')) {
    if (block.keyword == "*MATERIAL") {
      card.name = name_of(block);
    } else if (block.keyword == "*DENSITY") {
      const CardLine& line = first_data(block);
      card.numbers.density = cell_number(cells(line.text, ','), 0, line, "density");
    } else if (block.keyword == "*ELASTIC") {
      has_elastic = true;
      read_elastic(block, card, card.numbers);
      card.understood.at =
          block.has("MODULI=INSTANTANEOUS") ? ModulusAt::kInstantaneous : ModulusAt::kLongTerm;
    } else if (block.keyword == "*TRS") {
      read_wlf(block, card);
    } else if (block.keyword == "*VISCOELASTIC") {
      if (!block.has("TIME=PRONY")) {
        throw std::runtime_error("line " + std::to_string(block.line.number) +
                                 ": only *VISCOELASTIC, TIME=PRONY can be read");
      }
      for (const CardLine& line : block.data) {
        const auto row = cells(line.text, ',');
        card.numbers.branches.push_back({cell_number(row, 0, line, "g_i"),
                                         cell_number_or_zero(row, 1, line, "k_i"),
                                         cell_number(row, 2, line, "tau_i")});
      }
    }
    note_static_step(block, "*VISCO or a dynamic step", card);
  }
  require(has_elastic, "*ELASTIC");
  if (card.numbers.branches.empty()) card.understood.at = ModulusAt::kInstantaneous;
}

void read_calculix(const std::string& text, ReadCard& card) {
  struct Part {
    double young = 0.0, creep = 0.0;
    bool creeps = false;
  };
  std::vector<Part> parts;
  for (const KeywordBlock& block : keyword_blocks(card_lines(text, "**"), '*')) {
    if (block.keyword == "*MATERIAL") {
      parts.emplace_back();
      if (card.name.empty()) card.name = name_of(block);
    } else if (parts.empty()) {
      continue;  // mesh and sections before the materials
    } else if (block.keyword == "*DENSITY") {
      const CardLine& line = first_data(block);
      card.numbers.density += cell_number(cells(line.text, ','), 0, line, "density");
    } else if (block.keyword == "*ELASTIC") {
      CardNumbers share;
      read_elastic(block, card, share);
      parts.back().young = share.young;
      if (parts.size() > 1 && share.poisson != card.numbers.poisson) {
        card.findings.push_back({"poisson-differs",
                                 "line " + std::to_string(block.line.number + 1) +
                                     ": all overlaid materials need the same Poisson ratio",
                                 true});
      }
      card.numbers.poisson = share.poisson;
    } else if (block.keyword == "*CREEP") {
      const CardLine& line = first_data(block);
      const auto row = cells(line.text, ',');
      parts.back().creeps = true;
      parts.back().creep = cell_number(row, 0, line, "A");
      if (cell_number(row, 1, line, "n") != 1.0 || cell_number_or_zero(row, 2, line, "m") != 0.0) {
        card.findings.push_back(
            {"creep-not-linear",
             "line " + std::to_string(line.number) + ": a Maxwell branch needs n = 1 and m = 0",
             true});
      }
    }
    if (block.keyword == "*VISCOELASTIC" || block.has("MODULI=INSTANTANEOUS")) {
      card.findings.push_back({"calculix-ignores-prony",
                               "line " + std::to_string(block.line.number) +
                                   ": CalculiX drops this line with a warning and stays elastic; "
                                   "use an overlay of Norton-creep materials",
                               true});
    }
    note_static_step(block, "*VISCO", card);
  }
  require(!parts.empty(), "*MATERIAL");
  for (const Part& part : parts) {
    if (part.creeps) {
      card.numbers.branches.push_back({part.young, 0.0, part.creep});
    } else {
      card.numbers.equilibrium += part.young;
    }
  }
  // Only the first of our names carries the suffix of the elastic part.
  if (card.name.size() > 4 && card.name.ends_with("_INF")) card.name.resize(card.name.size() - 4);
}

void read_frontistr(const std::string& text, ReadCard& card) {
  std::vector<CardLine> lines = card_lines(text, "#");
  std::erase_if(lines, [](const CardLine& line) { return trimmed(line.text).rfind("!!", 0) == 0; });
  bool has_elastic = false;
  for (const KeywordBlock& block : keyword_blocks(lines, '!')) {
    if (block.keyword == "!MATERIAL") {
      card.name = name_of(block);
    } else if (block.keyword == "!ELASTIC") {
      has_elastic = true;
      read_elastic(block, card, card.numbers);
    } else if (block.keyword == "!DENSITY") {
      const CardLine& line = first_data(block);
      card.numbers.density = cell_number(cells(line.text, ','), 0, line, "density");
    } else if (block.keyword == "!VISCOELASTIC") {
      for (const CardLine& line : block.data) {
        const auto row = cells(line.text, ',');
        card.numbers.branches.push_back(
            {cell_number(row, 0, line, "mu_i"), 0.0, cell_number(row, 1, line, "tau_i")});
      }
    } else if (block.keyword == "!TRS") {
      read_wlf(block, card);
    } else if (block.keyword == "!SOLUTION" && block.has("TYPE=STATIC")) {
      card.findings.push_back({"static-step",
                               "line " + std::to_string(block.line.number) +
                                   ": needs !SOLUTION, TYPE=NLSTATIC and !STEP, TYPE=VISCO",
                               true});
    }
  }
  require(has_elastic, "!ELASTIC");
}

}  // namespace viscard
