// FrontISTR. Sources: manual and fstr_ctrl_material.f90 (rows mu_i, tau_i).
#include "io/cards/keyword_lines.h"
#include "io/cards/targets/card_targets.h"

#include <fmt/format.h>

namespace viscard {
namespace {

// INFINITESIMAL because the default is a total Lagrangian formulation.
std::string write_frontistr(const CardBody& body) {
  const CardNumbers& numbers = body.numbers;
  std::string out = fmt::format("!MATERIAL, NAME={}\n!ELASTIC\n {}, {}\n", body.name, numbers.young,
                                numbers.poisson);
  if (numbers.density > 0.0) out += fmt::format("!DENSITY\n {}\n", numbers.density);
  if (!numbers.branches.empty()) out += "!VISCOELASTIC, INFINITESIMAL\n";
  for (const CardBranch& branch : numbers.branches) {
    out += fmt::format(" {}, {}\n", branch.shear, branch.time);
  }
  if (numbers.shift) out += "!TRS, DEFINITION=WLF\n " + wlf_row(*numbers.shift);
  return out;
}

void read_frontistr(const std::string& text, ReadCard& card) {
  std::vector<CardLine> lines = card_lines(text, "#");
  std::erase_if(lines, [](const CardLine& line) { return trimmed(line.text).rfind("!!", 0) == 0; });
  bool has_elastic = false;
  for (const KeywordBlock& block : keyword_blocks(lines, '!')) {
    if (block.keyword == "!MATERIAL") {
      card.name = block.name();
    } else if (block.keyword == "!ELASTIC") {
      has_elastic = true;
      read_elastic(block, card, card.numbers);
    } else if (block.keyword == "!DENSITY") {
      card.numbers.density = density_in(block);
    } else if (block.keyword == "!VISCOELASTIC") {
      for (const CardLine& line : block.data) {
        const auto row = cells(line.text, ',');
        card.numbers.branches.push_back(
            {cell_number(row, 0, line, "mu_i"), 0.0, cell_number(row, 1, line, "tau_i")});
      }
    } else if (block.keyword == "!TRS") {
      read_wlf(block, card);
    } else if (block.keyword == "!SOLUTION" && block.has("TYPE=STATIC")) {
      card.add("static-step",
               at_line(block.line, "needs !SOLUTION, TYPE=NLSTATIC and !STEP, TYPE=VISCO"));
    }
  }
  require(has_elastic, "!ELASTIC");
}

std::string frontistr_mesh() {
  std::string out = "!HEADER\n one element\n!NODE\n";
  int id = 0;
  for (const auto& [x, y, z] : kCubeCorners) {
    out += fmt::format(" {}, {}., {}., {}.\n", ++id, x, y, z);
  }
  return out +
         "!ELEMENT, TYPE=361, EGRP=E\n 1, 1, 2, 3, 4, 5, 6, 7, 8\n"
         "!SECTION, TYPE=SOLID, EGRP=E, MATERIAL=M\n!MATERIAL, NAME=M, ITEM=1\n!ITEM=1, SUBITEM=2\n"
         " 1.0, 0.3\n!NGROUP, NGRP=X0\n 1, 4, 5, 8\n!NGROUP, NGRP=Y0\n 1, 2, 5, 6\n"
         "!NGROUP, NGRP=Z0\n 1, 2, 3, 4\n!NGROUP, NGRP=Z1\n 5, 6, 7, 8\n!END\n";
}

std::string frontistr_control(const DeckInput& input) {
  std::string card = input.card.text;
  // The mesh calls the material of its section M.
  const std::size_t at = card.find("!MATERIAL, NAME=");
  card.replace(at, card.find('\n', at) - at, "!MATERIAL, NAME=M");
  std::string out = "!VERSION\n 3\n!SOLUTION, TYPE=NLSTATIC\n!WRITE, RESULT\n" + card;
  out += fmt::format(
      "!AMPLITUDE, NAME=RAMP, VALUE=RELATIVE\n 0.0, 0.0, 1.0, {}, 1.0, {}\n"
      "!BOUNDARY, GRPID=1\n X0, 1, 1, 0.0\n Y0, 2, 2, 0.0\n Z0, 3, 3, 0.0\n",
      input.ramp(), 2.0 * input.end());
  out +=
      fmt::format("!{}, GRPID=1, AMP=RAMP\n Z1, 3, {}{}\n", input.is_creep() ? "CLOAD" : "BOUNDARY",
                  input.is_creep() ? "" : "3, ", input.pull());
  for (const DeckBlock& block : input.blocks()) {
    out += fmt::format("!STEP, TYPE=VISCO, CONVERG=1.0E-10\n {}, {}\n BOUNDARY, 1\n{}", block.step,
                       block.length, input.is_creep() ? " LOAD, 1\n" : "");
  }
  return out + "!SOLVER, METHOD=DIRECT\n 10000, 1\n 1.0E-12, 1.0, 0.0\n!END\n";
}

std::vector<DeckFile> frontistr_deck(const DeckInput& input, const std::string& name) {
  return {{name + ".cnt", frontistr_control(input)},
          {name + ".msh", frontistr_mesh()},
          {"hecmw_ctrl.dat", "!MESH, NAME=fstrMSH, TYPE=HECMW-ENTIRE\n " + name +
                                 ".msh\n!CONTROL, NAME=fstrCNT\n " + name +
                                 ".cnt\n!RESULT, NAME=fstrRES, IO=OUT\n " + name + ".res\n"}};
}

}  // namespace

CardTarget frontistr_target() {
  return {.name = "frontistr",
          .code = "FrontISTR",
          .extension = ".cnt",
          .comment = "#",
          .write = write_frontistr,
          .read = read_frontistr,
          .deck = DeckWriter{frontistr_deck, "fistr1"},
          .bulk = BulkRule::kConstantBulk,
          .takes_wlf = true,
          .evidence = Evidence::kRun,
          .evidence_note = "FrontISTR on one element, ramp and hold: 3e-8",
          .advice = "Needs !SOLUTION, TYPE=NLSTATIC and !STEP, TYPE=VISCO."};
}

}  // namespace viscard
