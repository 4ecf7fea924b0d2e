// FrontISTR. Sources: manual and fstr_ctrl_material.f90 (rows mu_i, tau_i); fstr_AddBC.f90 and
// fstr_ass_load.f90 (what a step adds) of versions 5.6 to 5.9. Laws of rubber: NEOHOOKE C10, D; MOONEY-RIVLIN C10,
// C01, D; ARRUDA-BOYCE mu, s_m, D; D = 2/K, up to 1e-12 taken for 1/D (Hyperelastic.f90).
#include "io/cards/keyword_lines.h"
#include "io/cards/law_numbers.h"
#include "io/cards/targets/card_targets.h"
#include "io/cards/targets/keyword_law.h"
#include "models/maths/require.h"

#include <fmt/format.h>

#include <stdexcept>

namespace viscard {
namespace {

// INFINITESIMAL because the default of both keywords is a total Lagrangian formulation; the last of
// the two decides. !ELASTIC comes first: after !VISCOELASTIC it would make the material elastic.
std::string write_frontistr(const CardBody& body) {
  const CardNumbers& numbers = body.numbers;
  std::string out = fmt::format("!MATERIAL, NAME={}\n!ELASTIC, INFINITESIMAL\n {}, {}\n", body.name,
                                numbers.young, numbers.poisson);
  if (numbers.density > 0.0) out += fmt::format("!DENSITY\n {}\n", numbers.density);
  if (!numbers.branches.empty()) out += "!VISCOELASTIC, INFINITESIMAL\n";
  for (const CardBranch& branch : numbers.branches) {
    out += fmt::format(" {}, {}\n", branch.shear, branch.time);
  }
  if (!numbers.shift) return out;
  if (numbers.shift->law == ShiftLaw::kWlf) {
    return out + "!TRS, DEFINITION=WLF\n " + wlf_row(*numbers.shift);
  }
  return out + "!TRS, DEFINITION=ARRHENIUS\n " +
         arrhenius_row(*numbers.shift, ArrheniusRow::kRatioAndZero);
}

// Up to this FrontISTR takes a D for 1/D.
constexpr double kLeastD = 1e-12;

std::string write_frontistr_law(const CardBody& body) {
  using enum HyperelasticForm;
  const CardNumbers& law = body.numbers;
  require(law.d() > kLeastD,
          "frontistr takes D = 2/K up to 1e-12 for 1/D; choose units with smaller numbers (--units "
          "mm-t-s) or a smaller --bulk-modulus");
  std::string numbers;
  for (const double modulus : law.moduli) numbers += number_of_20(modulus) + ", ";
  for (const double shape : law.shapes) numbers += number_of_20(shape) + ", ";
  return "!MATERIAL, NAME=" + body.name + "\n!HYPERELASTIC, TYPE=" +
         (law.form == kNeoHooke       ? "NEOHOOKE"
          : law.form == kMooneyRivlin ? "MOONEY-RIVLIN"
                                      : "ARRUDA-BOYCE") +
         "\n" + numbers + number_of_20(law.d()) + "\n" +
         (law.density > 0.0 ? "!DENSITY\n" + number_of_20(law.density) + "\n" : "");
}

std::vector<KeywordBlock> frontistr_blocks(const std::string& text) {
  std::vector<CardLine> lines = card_lines(text, "#");
  std::erase_if(lines, [](const CardLine& line) { return trimmed(line.text).rfind("!!", 0) == 0; });
  return keyword_blocks(lines, '!');
}

void read_frontistr_law(const std::string& text, ReadCard& card) {
  using enum HyperelasticForm;
  CardNumbers& law = card.numbers;
  const std::vector<KeywordBlock> blocks = frontistr_blocks(text);
  for (const KeywordBlock& block : blocks) {
    if (block.keyword == "!DENSITY") law.density = density_in(block);
    if (!law.moduli.empty() && (block.keyword == "!VISCOELASTIC" || block.keyword == "!ELASTIC"))
      card.add("last-decides",
               at_line(block.line, block.keyword + " below !HYPERELASTIC replaces the law of "
                                                   "rubber"));
    if (block.keyword != "!HYPERELASTIC") continue;
    const bool is_boyce = block.has("TYPE=ARRUDA-BOYCE"), is_two = block.has("TYPE=MOONEY-RIVLIN");
    if (!is_boyce && !is_two && !block.has("TYPE=NEOHOOKE"))
      throw std::runtime_error(
          at_line(block.line, "only NEOHOOKE, MOONEY-RIVLIN and ARRUDA-BOYCE are read"));
    const CardLine& line = block.first_data();
    const auto row = cells(line.text, ',');
    const double first = cell_number(row, 0, line, "C10 or mu");
    const double second = is_boyce || is_two ? cell_number(row, 1, line, "C01 or s_m") : 0.0;
    const double D = cell_number(row, is_boyce || is_two ? 2 : 1, line, "D");
    if (is_boyce) take_law(kArrudaBoyce, {first}, {second}, law);
    if (is_two) take_law(kMooneyRivlin, {first, second}, {}, law);
    if (!is_boyce && !is_two) take_law(kNeoHooke, {first}, {}, law);
    law.bulk = D > kLeastD ? 2.0 / D : 0.0;
    if (!(D > kLeastD))
      card.add("replaced-D", at_line(line, "FrontISTR takes a D up to 1e-12 for 1/D"));
  }
  require_in_card(!law.moduli.empty(), "!HYPERELASTIC");
  check_single_material(blocks, card);
}

void read_frontistr(const std::string& text, ReadCard& card) {
  bool has_elastic = false, is_small_strain = false;
  const std::vector<KeywordBlock> blocks = frontistr_blocks(text);
  check_single_material(blocks, card);
  for (const KeywordBlock& block : blocks) {
    if (block.keyword == "!ELASTIC" || block.keyword == "!VISCOELASTIC") {
      is_small_strain = block.has("INFINITESIMAL") || block.has("INFINITE");
    }
    if (block.keyword == "!MATERIAL") {
      card.name = block.name();
    } else if (block.keyword == "!ELASTIC") {
      has_elastic = true;
      read_elastic(block, card, card.numbers);
      if (!card.numbers.branches.empty()) {
        card.add("elastic-after-viscoelastic",
                 at_line(block.line,
                         "!ELASTIC after !VISCOELASTIC makes the material elastic; put it first"));
      }
    } else if (block.keyword == "!DENSITY") {
      card.numbers.density = density_in(block);
    } else if (block.keyword == "!VISCOELASTIC") {
      for (const CardLine& line : block.data) {
        const auto row = cells(line.text, ',');
        check_width(line, 2, card);
        card.numbers.branches.push_back(
            {cell_number(row, 0, line, "mu_i"), 0.0, cell_number(row, 1, line, "tau_i")});
      }
    } else if (block.keyword == "!TRS") {
      read_shift_rows(block, ArrheniusRow::kRatioAndZero, card);
    } else if (block.keyword == "!SOLUTION" && block.has("TYPE=STATIC")) {
      card.add("static-step",
               at_line(block.line, "needs !SOLUTION, TYPE=NLSTATIC and !STEP, TYPE=VISCO"));
    }
  }
  require_in_card(has_elastic, "!ELASTIC");
  if (is_small_strain) return;
  card.add("finite-strain",
           "the last of !ELASTIC and !VISCOELASTIC lacks INFINITESIMAL: the formulation is total "
           "Lagrangian, 3e-3 off at a strain of 1e-3",
           false);
}

std::string frontistr_mesh(const DeckInput& input) {
  std::string out = "!HEADER\n one element\n!NODE\n";
  int id = 0;
  for (const auto& [x, y, z] : kCubeCorners) {
    out += fmt::format(" {}, {}., {}., {}.\n", ++id, x, y, z);
  }
  std::string temperature;
  if (const auto& shift = input.card.written.shift) {
    temperature = fmt::format(
        "!NGROUP, NGRP=NALL\n 1, 2, 3, 4, 5, 6, 7, 8\n"
        "!INITIAL CONDITION, TYPE=TEMPERATURE\n NALL, {}\n",
        input.temperature_C.value_or(shift->T_ref_C));
  }
  return out +
         "!ELEMENT, TYPE=361, EGRP=E\n 1, 1, 2, 3, 4, 5, 6, 7, 8\n"
         "!SECTION, TYPE=SOLID, EGRP=E, MATERIAL=M\n!MATERIAL, NAME=M, ITEM=1\n!ITEM=1, SUBITEM=2\n"
         " 1.0, 0.3\n!NGROUP, NGRP=X0\n 1, 4, 5, 8\n!NGROUP, NGRP=Y0\n 1, 2, 5, 6\n"
         "!NGROUP, NGRP=X1\n 2, 3, 6, 7\n!NGROUP, NGRP=Y1\n 3, 4, 7, 8\n"
         "!NGROUP, NGRP=Z0\n 1, 2, 3, 4\n!NGROUP, NGRP=Z1\n 5, 6, 7, 8\n" +
         temperature + "!END\n";
}

// In a step of TYPE=VISCO a prescribed displacement is an increment: the first increment of the step
// adds all of it, and ignores the amplitude (fstr_AddBC.f90). So the ramp is one increment of the
// first step, and the displacement of the other steps is 0. A force rises linearly over the first
// step in which it is active and stays in the next ones (fstr_ass_load.f90).
// INC_TYPE=AUTO because increments of fixed size must not be shorter than 1e-4 (m_step.f90), the
// bounds keep them at their size. CONVERG: the residual of version 5.9 stays at 2e-9 to 4e-8.
std::string frontistr_steps(const DeckInput& input) {
  std::string out;
  const std::string loads = std::string(input.is_creep() ? " LOAD, 1\n" : "") +
                            (input.card.written.shift ? " LOAD, 2\n" : "");
  int group = 1;
  for (const DeckBlock& block : input.blocks()) {
    const bool is_jump = group == 1 && !input.is_creep();
    const double step = is_jump ? block.length : block.step;
    out += fmt::format(
        "!STEP, TYPE=VISCO, INC_TYPE=AUTO, CONVERG=1.0E-7\n {}, {}, {}, {}\n BOUNDARY, {}\n{}",
        step, block.length, 1e-3 * step, step, input.is_creep() ? 1 : group, loads);
    group = 2;
  }
  return out;
}

std::string frontistr_control(const DeckInput& input) {
  std::string card = input.card.text;
  // The mesh calls the material of its section M.
  const std::size_t at = card.find("!MATERIAL, NAME=");
  card.replace(at, card.find('\n', at) - at, "!MATERIAL, NAME=M");
  const char* sides = input.is_confined() ? " X1, 1, 1, 0.0\n Y1, 2, 2, 0.0\n" : "";
  const auto boundary = [sides](int group, const std::string& pulled) {
    return fmt::format("!BOUNDARY, GRPID={}\n X0, 1, 1, 0.0\n Y0, 2, 2, 0.0\n Z0, 3, 3, 0.0\n{}{}",
                       group, sides, pulled);
  };
  std::string out = "!VERSION\n 3\n!SOLUTION, TYPE=NLSTATIC\n!WRITE, RESULT\n" + card;
  if (input.is_creep()) {
    out += boundary(1, "") + fmt::format("!CLOAD, GRPID=1\n Z1, 3, {}\n", input.pull());
  } else {
    out +=
        boundary(1, fmt::format(" Z1, 3, 3, {}\n", input.pull())) + boundary(2, " Z1, 3, 3, 0.0\n");
  }
  // As in FrontISTR's own tests of !TRS: the temperature is a load beside the initial condition.
  if (const auto& shift = input.card.written.shift) {
    out += fmt::format("!TEMPERATURE, GRPID=2\n NALL, {}\n",
                       input.temperature_C.value_or(shift->T_ref_C));
  }
  return out + frontistr_steps(input) +
         "!SOLVER, METHOD=DIRECT\n 10000, 1\n 1.0E-12, 1.0, 0.0\n!END\n";
}

std::vector<DeckFile> frontistr_deck(const DeckInput& input, const std::string& name) {
  return {{name + ".cnt", frontistr_control(input)},
          {name + ".msh", frontistr_mesh(input)},
          {"hecmw_ctrl.dat", "!MESH, NAME=fstrMSH, TYPE=HECMW-ENTIRE\n " + name +
                                 ".msh\n!CONTROL, NAME=fstrCNT\n " + name +
                                 ".cnt\n!RESULT, NAME=fstrRES, IO=OUT\n " + name + ".res\n"}};
}

}  // namespace

CardTarget frontistr_target() {
  return {
      .name = "frontistr",
      .code = "FrontISTR",
      .extension = ".cnt",
      .comment = "#",
      .write = write_frontistr,
      .read = read_frontistr,
      // Geometrically linear, so the strain is 1: forces below 1e-8 units would be compared with
      // an absolute residual (fstr_CheckConvergence.f90).
      // The ramp of relaxation is one increment at any step, in which the lateral strain at constant
      // K is not linear; a short one leaves an error of its square, 1e-10 instead of 6e-5.
      .deck = DeckWriter{frontistr_deck,
                         "fistr1",
                         {.amplitude = 1.0, .steps_per_tau = 8, .ramp_in_tau = 1e-3}},
      .laws = LawColumn{.write = write_frontistr_law,
                        .read = read_frontistr_law,
                        .keywords = {"NEOHOOKE: C10", "MOONEY-RIVLIN: C10, C01", "", "",
                                     "ARRUDA-BOYCE: mu, s_m", ""},
                        .volume = keyword_law_volume("D") + "; D = 2/K",
                        .terms = "the last of !HYPERELASTIC and !VISCOELASTIC decides on the "
                                 "material",
                        .evidence = "run in FrontISTR 5.9"},
      .bulk = BulkRule::kConstantBulk,
      .is_case_sensitive = false,
      .reads_fortran_numbers = true,
      .takes_wlf = true,
      .takes_arrhenius = true,
      .set_temperature = "!INITIAL CONDITION, TYPE=TEMPERATURE and !TEMPERATURE (0 if not given)",
      .evidence = Evidence::kRun,
      .evidence_note = "FrontISTR 5.9 on one element, relaxation and creep",
      .advice =
          "Needs !SOLUTION, TYPE=NLSTATIC and !STEP, TYPE=VISCO; each such step adds its "
          "prescribed displacements again. INFINITESIMAL: small strain; without it the formulation "
          "is total Lagrangian."};
}

}  // namespace viscard
