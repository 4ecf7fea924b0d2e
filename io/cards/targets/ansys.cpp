// ANSYS MAPDL. Sources: Command Reference (TB,PRONY,MATID,NTEMP,NPTS,SHEAR|BULK: NPTS pairs
// alpha_i, tau_i; without a BULK table the bulk modulus is constant); Material Reference,
// viscoelasticity, shift functions. Laws of rubber: TB,HYPER is the law at once, with Ogden's own
// 2 mu_i/alpha_i; NEO takes the shear modulus 2 C10; d = 2/K, 0 is incompressible (Structural Analysis Guide,
// TB,HYPER, OGDEN and NEO with examples; order of BOYCE, GENT and YEOH: Material Reference 4.6). No public text
// with the rule of its terms at large strain was found, nor one with the order of TB,CDM,,,3,PSE2 (damage).
#include "io/cards/keyword_lines.h"
#include "io/cards/law_numbers.h"
#include "io/cards/targets/card_targets.h"
#include "io/cards/targets/keyword_law.h"

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

std::string write_ansys_law(const CardBody& body) {
  const CardNumbers& law = body.numbers;
  using enum HyperelasticForm;
  const bool ogden = is_ogden(law.form);
  const char* const option = ogden                       ? "OGDEN"
                             : law.form == kNeoHooke     ? "NEO"
                             : law.form == kMooneyRivlin ? "MOONEY"
                             : law.form == kYeoh         ? "YEOH"
                             : law.form == kGent         ? "GENT"
                                                         : "BOYCE";
  const std::string count = ogden || law.form == kYeoh || law.form == kMooneyRivlin
                                ? std::to_string(law.moduli.size())
                                : "";
  CardNumbers own = law;
  if (ogden) own.moduli = own_moduli(law);
  if (law.form == kNeoHooke) own.moduli[0] *= 2.0;
  std::vector<double> numbers = ogden ? pairs_of(own) : own.moduli;
  if (!ogden) numbers.insert(numbers.end(), law.shapes.begin(), law.shapes.end());
  numbers.push_back(law.d());
  std::string text = law.density > 0.0 ? "MP,DENS,1," + number_of_20(law.density) + "\n" : "";
  text += fmt::format("TB,HYPER,1,1,{},{}\n", count, option);
  for (std::size_t i = 0; i < numbers.size(); ++i)
    text += fmt::format("TBDATA,{},{}\n", i + 1, number_of_20(numbers[i]));
  return text +
         (law.branches.empty() ? "" : prony_table("SHEAR", law.branches, &CardBranch::shear));
}

// One table of TB and the constants of its TBDATA lines.
struct MapdlTable {
  CardLine line;
  bool is_bulk = false;  // of TB,PRONY
  int pairs = 0;
  int next_location = 1;
  std::map<int, double> constants;

  // Up to the last location; those that are not given are 0.
  std::vector<double> all() const {
    std::vector<double> out;
    for (const auto& [location, value] : constants) {
      if (location < 1) continue;
      out.resize(static_cast<std::size_t>(location), 0.0);
      out.back() = value;
    }
    return out;
  }
};

std::vector<CardBranch> pairs_of(const MapdlTable& table) {
  std::vector<CardBranch> out;
  for (int pair = 0; pair < table.pairs; ++pair) {
    const auto alpha = table.constants.find(2 * pair + 1), tau = table.constants.find(2 * pair + 2);
    if (alpha == table.constants.end() || tau == table.constants.end()) break;
    out.push_back({alpha->second, 0.0, tau->second});
  }
  return out;
}

void add_constants(const std::vector<std::string>& row, const CardLine& line, MapdlTable& table,
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

void check_pairs(const MapdlTable& table, ReadCard& card) {
  const std::size_t given = (table.constants.size() + 1) / 2;
  if (static_cast<int>(given) == table.pairs) return;
  card.add("npts-mismatch",
           at_line(table.line, "TB,PRONY announces " + std::to_string(table.pairs) + " pairs and " +
                                   std::to_string(given) + " are given"));
}

// Pairs of the shear and the bulk table with the same time are one branch.
void add_tables(const std::vector<MapdlTable>& tables, ReadCard& card) {
  for (const MapdlTable& table : tables) {
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

MapdlTable table_of(const std::vector<std::string>& row, const CardLine& line) {
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

// MPDATA,R5.0, 1,EX  , 1, 1, 2.2, as MAPDL's CDWRITE exports; typed by hand MPDATA,EX,1,1,2.2. As the row of an MP.
std::vector<std::string> property_of(const std::vector<std::string>& row, const CardLine& line,
                                     ReadCard& card) {
  if (upper(row[0]) == "MP") return row;
  const bool is_export = row.size() > 6 && upper(row[1]).rfind('R', 0) == 0;
  const std::size_t next = is_export ? 7 : 5;
  if (row.size() > next && !row[next].empty())
    card.add("more-temperatures", at_line(line, "values at further temperatures are not read"));
  if (is_export) return {row[0], row[3], row[4], row[6]};
  const auto cell = [&](std::size_t i) { return row.size() > i ? row[i] : ""; };
  return {row[0], cell(1), cell(2), cell(4)};
}

void read_ansys(const std::string& text, ReadCard& card) {
  std::vector<MapdlTable> tables;
  bool in_elastic = false, in_shift = false, has_young = false;
  std::string number;
  for (const CardLine& line : mapdl_commands(text)) {
    const std::vector<std::string> row = cells(line.text, ',');
    const std::string command = upper(row[0]);
    if (command == "MP" || command == "MPDATA") {
      const auto property = property_of(row, line, card);
      check_material_number(property, line, number, card);
      read_property(property, line, card, has_young);
    } else if (command == "TB") {
      check_material_number(row, line, number, card);
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

// The law of a TB,HYPER table, and how many of its numbers are constants and energies of the volume.
void take_table(const MapdlTable& table, ReadCard& card) {
  using enum HyperelasticForm;
  CardNumbers& law = card.numbers;
  const auto row = cells(table.line.text, ',');
  std::string option = row.size() > 5 ? upper(row[5]) : "";
  for (const char* known : {"OGDEN", "MOONEY", "BOYCE"}) {  // MAPDL reads four letters
    if (option.substr(0, 4) == std::string(known).substr(0, 4)) option = known;
  }
  const std::vector<double> numbers = table.all();
  const auto count = [&](int least) {
    return static_cast<std::size_t>(std::max(table.pairs, least));
  };
  const auto first = [&](std::size_t n) {
    require_count(numbers, n,
                  "TB,HYPER" + (option == "OGDEN" || option == "NEO" ? ",,,," + option : ""));
    return std::vector<double>(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(n));
  };
  std::size_t n = 2, n_volume = 1;
  if (option == "OGDEN") {
    n_volume = count(1);
    n = 2 * n_volume;
    const auto pairs = first(n);
    std::vector<double> own, shapes;
    for (std::size_t i = 0; i < n; i += 2) {
      own.push_back(pairs[i] * pairs[i + 1] / 2.0);
      shapes.push_back(pairs[i + 1]);
    }
    take_ogden(own, shapes, law);
  } else if (option == "NEO") {
    n = 1;
    take_law(kNeoHooke, {first(n)[0] / 2.0}, {}, law);
  } else if (option == "MOONEY" || option == "POLY") {
    // Two, three, five or nine constants of Mooney and Rivlin; POLY has all of its order.
    const bool is_poly = option == "POLY";
    if (is_poly) n_volume = count(1);
    n = is_poly ? n_volume * (n_volume + 3) / 2 : count(2);
    std::vector<double> constants = first(n);
    if (!is_poly && n == 3) constants = {numbers[0], numbers[1], 0.0, numbers[2]};  // C11
    take_invariant_law(constants, law);
  } else if (option == "YEOH") {
    n = n_volume = table.pairs > 0 ? count(1) : 3;
    std::vector<double> moduli = first(n);
    if (n > 3)
      throw std::runtime_error(at_line(table.line, "only the first three orders of YEOH are read"));
    moduli.resize(3, 0.0);
    take_law(kYeoh, moduli, {}, law);
  } else if (option == "BOYCE" || option == "GENT") {
    const auto both = first(n);
    take_law(option == "BOYCE" ? kArrudaBoyce : kGent, {both[0]}, {both[1]}, law);
  } else {
    throw std::runtime_error("TB,HYPER has '" + option +
                             "'; OGDEN, NEO, MOONEY, POLY, YEOH, BOYCE and GENT are read");
  }
  law.bulk = numbers.size() > n ? bulk_of_d(numbers[n]) : 0.0;
  if (numbers.size() <= n + n_volume) return;
  card.add("other-count",
           at_line(table.line, fmt::format("{} constants are given and {} of {} are read",
                                           numbers.size(), n + 1, option)));
}

void read_ansys_law(const std::string& text, ReadCard& card) {
  std::vector<MapdlTable> laws, shares;
  MapdlTable* table = nullptr;
  std::string number;
  for (const CardLine& line : mapdl_commands(text)) {
    const auto row = cells(line.text, ',');
    const std::string command = upper(row[0]), kind = row.size() > 1 ? upper(row[1]) : "";
    if (command == "MP" || command == "MPDATA") {
      const auto property = property_of(row, line, card);
      check_material_number(property, line, number, card);
      bool has_young = false;
      if (upper(property[1]) == "DENS") read_property(property, line, card, has_young);
    } else if (command == "TB") {
      check_material_number(row, line, number, card);
      table = nullptr;
      if (kind.rfind("HYPE", 0) == 0) {
        table = &laws.emplace_back(MapdlTable{.line = line});
        if (row.size() > 4 && !row[4].empty()) table->pairs = cell_integer(row, 4, line, "NPTS");
      } else if (kind.rfind("PRON", 0) == 0) {
        table = &shares.emplace_back(table_of(row, line));
        if (table->is_bulk)
          card.add("bulk-relaxes", at_line(line, "a table of BULK: the bulk modulus would relax"));
      } else {
        add_other_law(line, "TB," + kind + " changes the stress and is not read", card);
      }
    } else if (command.rfind("TBDAT", 0) == 0 && table != nullptr) {
      add_constants(row, line, *table, card);
    }
  }
  require_in_card(!laws.empty(), "TB,HYPER");
  take_table(laws.back(), card);
  add_tables(shares, card);
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
      .laws =
          LawColumn{.write = write_ansys_law,
                    .read = read_ansys_law,
                    .keywords = {"NEO: mu = 2 C10", "MOONEY: C10, C01", "YEOH: C10, C20, C30",
                                 "OGDEN: Ogden's own 2 mu_i/alpha_i, alpha_i", "BOYCE: mu, s_m",
                                 "GENT: mu, J_m"},
                    .volume = keyword_law_volume("d") + "; d = 2/K, 0: incompressible",
                    .may_be_incompressible = true,
                    .takes_terms = true,
                    .most_terms = 100,
                    .terms =
                        "the law at once, g_i of its deviator, constant bulk modulus, tau_i; NOT "
                        "CHECKED: no public text with its rule at large strain was found",
                    .damage = {"",
                               "no public text states the order of the constants of its "
                               "TB,CDM,,,3,PSE2"}},
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
