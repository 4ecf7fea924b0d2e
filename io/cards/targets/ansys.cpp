// ANSYS MAPDL. Sources: Command Reference (TB,PRONY,MATID,NTEMP,NPTS,SHEAR|BULK: NPTS pairs
// alpha_i, tau_i; without a BULK table the bulk modulus is constant); Material Reference,
// viscoelasticity, shift functions.
#include "io/cards/keyword_lines.h"
#include "io/cards/targets/card_targets.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <stdexcept>

namespace viscard {
namespace {

std::string prony_table(const char* kind, const std::vector<CardBranch>& branches,
                        double CardBranch::*share) {
  std::string out = fmt::format("TB,PRONY,1,1,{},{}\n", branches.size(), kind);
  for (std::size_t i = 0; i < branches.size(); ++i) {
    // Each row has its own location: a second row with the same one overwrites the first.
    out += fmt::format("TBDATA,{},{},{}\n", 2 * i + 1, number_of_20(branches[i].*share),
                       number_of_20(branches[i].time));
  }
  return out;
}

std::string write_ansys(const CardBody& body) {
  const CardNumbers& numbers = body.numbers;
  std::string out = "MP,EX,1," + number_of_20(numbers.young) + "\nMP,PRXY,1," +
                    number_of_20(numbers.poisson) + "\n";
  if (numbers.density > 0.0) out += "MP,DENS,1," + number_of_20(numbers.density) + "\n";
  const std::vector<CardBranch>& branches = numbers.branches;
  if (!branches.empty()) out += prony_table("SHEAR", branches, &CardBranch::shear);
  if (std::any_of(branches.begin(), branches.end(),
                  [](const CardBranch& branch) { return branch.bulk != 0.0; })) {
    out += prony_table("BULK", branches, &CardBranch::bulk);
  }
  // MAPDL multiplies time by A = 1/a_T, log10 A = C1 (T - Tref)/(C2 + T - Tref): the usual
  // constants keep their sign. No text of the maker with this formula was found in public.
  if (numbers.shift) {
    std::string row = wlf_row(*numbers.shift);
    std::erase(row, ' ');
    out +=
        "! WLF (formula not verified: compare one warm run): time is multiplied by A,\n"
        "! log10 A = C1 (T - Tref)/(C2 + T - Tref)\n"
        "TB,SHIFT,1,1,3,WLF\nTBDATA,1," +
        row;
  }
  return out;
}

// One TB,PRONY table and the constants of its TBDATA lines.
struct PronyTable {
  CardLine line;
  bool is_bulk = false;
  int pairs = 0;
  int next_location = 1;
  std::map<int, double> constants;
};

std::vector<CardBranch> pairs_of(const PronyTable& table) {
  std::vector<CardBranch> out;
  for (int pair = 0; pair < table.pairs; ++pair) {
    const auto alpha = table.constants.find(2 * pair + 1), tau = table.constants.find(2 * pair + 2);
    if (alpha == table.constants.end() || tau == table.constants.end()) break;
    out.push_back({alpha->second, 0.0, tau->second});
  }
  return out;
}

void add_constants(const std::vector<std::string>& row, const CardLine& line, PronyTable& table,
                   ReadCard& card) {
  int location = row.size() > 1 && !row[1].empty() ? cell_integer(row, 1, line, "location")
                                                   : table.next_location;
  for (std::size_t i = 2; i < row.size(); ++i, ++location) {
    if (row[i].empty()) continue;
    if (!table.constants.emplace(location, card_number(row[i], line, "constant")).second) {
      card.add("tbdata-overwritten",
               at_line(line, "constant " + std::to_string(location) +
                                 " was given before and is overwritten; increase the location "
                                 "(1, 3, 5 ...)"));
      table.constants[location] = card_number(row[i], line, "constant");
    }
  }
  table.next_location = location;
}

void check_pairs(const PronyTable& table, ReadCard& card) {
  const std::size_t given = (table.constants.size() + 1) / 2;
  if (static_cast<int>(given) == table.pairs) return;
  card.add("npts-mismatch",
           at_line(table.line, "TB,PRONY announces " + std::to_string(table.pairs) + " pairs and " +
                                   std::to_string(given) + " are given"));
}

// Pairs of the shear and the bulk table with the same time are one branch.
void add_tables(const std::vector<PronyTable>& tables, ReadCard& card) {
  for (const PronyTable& table : tables) {
    check_pairs(table, card);
    for (const CardBranch& pair : pairs_of(table)) {
      auto& branches = card.numbers.branches;
      auto same = std::find_if(branches.begin(), branches.end(), [&](const CardBranch& b) {
        return b.time == pair.time && (table.is_bulk ? b.bulk : b.shear) == 0.0;
      });
      if (same == branches.end()) same = branches.insert(same, {0.0, 0.0, pair.time});
      CardBranch& branch = *same;
      (table.is_bulk ? branch.bulk : branch.shear) = pair.shear;
    }
  }
}

// All commands of the card must be of one material number.
void check_material_number(const std::vector<std::string>& row, const CardLine& line,
                           std::string& number, ReadCard& card) {
  const std::string found = row.size() > 2 ? row[2] : "";
  if (number.empty()) number = found;
  if (found == number) return;
  card.add("material-number-differs",
           at_line(line, row[0] + " is of material '" + found + "' and the commands before of '" +
                             number + "'"));
}

void read_property(const std::vector<std::string>& row, const CardLine& line, ReadCard& card,
                   bool& has_young) {
  const std::string property = upper(row.size() > 1 ? row[1] : "");
  const double value = cell_number(row, 3, line, property);
  if (property == "EX") {
    card.numbers.young = value;
    has_young = true;
  } else if (property == "PRXY" || property == "NUXY") {
    card.numbers.poisson = value;
  } else if (property == "DENS") {
    card.numbers.density = value;
  }
}

PronyTable table_of(const std::vector<std::string>& row, const CardLine& line) {
  const std::string part = upper(row.size() > 5 ? row[5] : "SHEAR").substr(0, 4);
  if (part != "SHEA" && part != "BULK") {
    throw std::runtime_error(at_line(line, "'" + row[5] + "' is neither SHEAR nor BULK"));
  }
  if (cell_number_or_zero(row, 3, line, "number of temperatures") > 1.0) {
    throw std::runtime_error(at_line(line, "tables at more than one temperature are not read"));
  }
  return {.line = line,
          .is_bulk = part == "BULK",
          .pairs = cell_integer(row, 4, line, "number of pairs")};
}

void read_ansys(const std::string& text, ReadCard& card) {
  std::vector<PronyTable> tables;
  bool in_elastic = false, in_shift = false, has_young = false;
  std::string number;
  for (const CardLine& line : mapdl_commands(text)) {
    const std::vector<std::string> row = cells(line.text, ',');
    const std::string command = upper(row[0]);
    if (command == "MP" || command == "TB") check_material_number(row, line, number, card);
    if (command == "MP") {
      read_property(row, line, card, has_young);
    } else if (command == "MPDATA") {
      // MPDATA,R5.0, 1,EX  , 1, 1, 2.2, as MAPDL's CDWRITE exports; typed by hand MPDATA,EX,1,1,2.2.
      const bool is_export = row.size() > 6 && upper(row[1]).rfind('R', 0) == 0;
      const std::vector<std::string> property =
          is_export ? std::vector{row[0], row[3], row[4], row[6]}
                    : std::vector{row[0], row.size() > 1 ? row[1] : "",
                                  row.size() > 2 ? row[2] : "", row.size() > 4 ? row[4] : ""};
      check_material_number(property, line, number, card);
      read_property(property, line, card, has_young);
      const std::size_t next = is_export ? 7 : 5;
      if (row.size() > next && !row[next].empty())
        card.add("more-temperatures", at_line(line, "values at further temperatures are not read"));
    } else if (command == "TB") {
      const std::string kind = upper(row.size() > 1 ? row[1] : "").substr(0, 4);
      in_elastic = kind == "ELAS";
      in_shift = kind == "SHIF" && upper(row.size() > 5 ? row[5] : "") == "WLF";
      // The count and the option of tables whose numbers have fixed places.
      for (std::size_t i = 4; (in_elastic || in_shift) && i < std::min<std::size_t>(row.size(), 6);
           ++i)
        card.also_read += " " + row[i];
      if (kind == "PRON") tables.push_back(table_of(row, line));
    } else if (command.rfind("TBDAT", 0) == 0 && in_elastic) {
      card.numbers.young = cell_number(row, 2, line, "E");
      card.numbers.poisson = cell_number(row, 3, line, "nu");
      has_young = true;
    } else if (command.rfind("TBDAT", 0) == 0 && in_shift) {
      card.numbers.shift = TemperatureShift{.T_ref_C = cell_number(row, 2, line, "Tref"),
                                            .C1 = cell_number(row, 3, line, "C1"),
                                            .C2_K = cell_number(row, 4, line, "C2")};
    } else if (command.rfind("TBDAT", 0) == 0 && !tables.empty()) {
      add_constants(row, line, tables.back(), card);
    }
  }
  if (!has_young) throw std::runtime_error("the card has no MP,EX and no TB,ELASTIC");
  add_tables(tables, card);
}

std::vector<DeckFile> ansys_deck(const DeckInput& input, const std::string& name) {
  std::string out = "/PREP7\nET,1,SOLID185\nKEYOPT,1,6,1\n" + input.card.text;
  out +=
      "BLOCK,0,1,0,1,0,1\nESIZE,1\nVMESH,1\nNSEL,S,LOC,X,0\nD,ALL,UX,0\nNSEL,S,LOC,Y,0\n"
      "D,ALL,UY,0\nNSEL,S,LOC,Z,0\nD,ALL,UZ,0\nALLSEL\nFINISH\n/SOLU\nANTYPE,STATIC\n"
      "NLGEOM,OFF\nKBC,0\nOUTRES,ALL,ALL\nNSEL,S,LOC,Z,1\n";
  out += (input.is_creep() ? "F,ALL,FZ," : "D,ALL,UZ,") + number_of_20(input.pull()) + "\n";
  out += "ALLSEL\n";
  // MAPDL starts at TUNIF, which is 0 where it is not given.
  if (const auto& shift = input.card.written.shift) {
    out +=
        "TREF," + number_of_20(shift->T_ref_C) + "\nTUNIF," + number_of_20(shift->T_ref_C) + "\n";
  }
  for (const DeckBlock& block : input.blocks()) {
    out += fmt::format("TIME,{0}\nNSUBST,{1},{1},{1}\nSOLVE\n", number_of_20(block.end),
                       block.increments);
  }
  out += "FINISH\n/POST26\n";
  out += input.is_creep() ? "NSOL,2,NODE(1,1,1),U,Z,UZ\nPRVAR,2\n"
                          : "NSEL,S,LOC,Z,0\n! the sum of the FZ of these nodes is the force\n"
                            "RFORCE,2,NODE(0,0,0),F,Z,FZ\nPRVAR,2\n";
  return {{name + ".mac", out + "FINISH\n"}};
}

}  // namespace

CardTarget ansys_target() {
  return {
      .name = "ansys",
      .code = "ANSYS MAPDL",
      .extension = ".mac",
      .comment = "!",
      .write = write_ansys,
      .read = read_ansys,
      .deck = DeckWriter{ansys_deck, "mapdl -b -i {}.mac"},
      .is_case_sensitive = false,
      .reads_fortran_numbers = true,
      .max_terms = 100,
      .takes_wlf = true,
      .set_temperature = "TUNIF or BF,ALL,TEMP (0 if not given)",
      .evidence = Evidence::kParsed,
      .evidence_note = "public command manual; an independent reader found the numbers",
      .advice = "EX is always instantaneous. Near nu = .5 use SOLID185/186/187 with KEYOPT(6) = 1.",
      // Ansys FAQ, harmonic analyses with viscoelastic materials.
      .harmonic = "exact in full harmonic analyses, not after a linear perturbation"};
}

}  // namespace viscard
