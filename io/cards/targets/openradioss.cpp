// OpenRadioss, /MAT/LAW40 (KELVINMAX): K, long-term shear modulus, five branches. The only target
// that declares its units. Source: Radioss Reference Guide (/MAT/LAW40, /PROP/TYPE14, /IMPDISP,
// /CLOAD, /TH); OpenRadioss has not run the one-element model here.
// Laws of rubber, not run:
//   LAW82   mu_i, alpha_i of ours, nu = 0 and D_1 = 2/K; LAW94 (Yeoh) and LAW92 (Arruda-Boyce) with the same D.
//           Mooney-Rivlin is LAW82 with exponents 2 and -2, mu = 2 C (Radioss Reference Guide 2021)
//   LAW62   with terms: mu_i, alpha_i of the law at once, gamma_i = g_i, tau_i, Poisson's ratio. Simo's rule, with
//           H_i <- exp(-x) H_i + exp(-x/2) (S_new - S_old) (sigeps62.F, hm_read_mat62.F, matl62_visc_hyp.cfg).
//           /VISC/PRONY, beside LAW82, 92 and others, adds a stress that is linear in the rate of the strain
//           (visc_prony.F), and is not used. Of foams the same mu_i, alpha_i, and nu_i; if one nu_i is not 0, the nu
//           of the first line is dropped (LAW62.cfg)
//   LAW100  beside damage, /FAIL/MULLINS_OR, which acts on LAW92, 95 and 100 only, so that the laws of the invariants
//           become LAW100 (hm_read_mat100.F: K = 2/D_1, no networks; fail_mullins_or.cfg)
#include "io/cards/card_lines.h"
#include "io/cards/column_fields.h"
#include "io/cards/keyword_lines.h"
#include "io/cards/law_numbers.h"
#include "io/cards/read_card.h"
#include "io/cards/targets/card_targets.h"
#include "io/cards/targets/radioss_model.h"
#include "io/cards/unit_system.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace viscard {
namespace {

std::string row20(const std::vector<double>& values) {
  std::string out;
  for (const double value : values) out += real(value, 20);
  return out + "\n";
}

// MUNIT, LUNIT, TUNIT.
std::string unit_row(const UnitSystem& units) {
  return right(units.mass, 20) + right(units.length, 20) + right(units.time, 20) + "\n";
}

// The law's title and density.
std::string radioss_law(const std::string& number, const CardBody& body) {
  return "/MAT/LAW" + number + "/1/1\n" + body.name + "\n#              RHO_I\n" +
         row20({body.numbers.density});
}

// The block /UNIT, with names of its columns or without.
std::string unit_block(const UnitSystem& units, const char* names) {
  return fmt::format("/UNIT/1\n{}\n{}", units.name, names) + unit_row(units);
}

std::string write_openradioss(const CardBody& body) {
  const CardNumbers& numbers = body.numbers;
  std::vector<double> shear(5, 0.0), decay(5, 0.0);
  for (std::size_t i = 0; i < numbers.branches.size(); ++i) {
    shear[i] = numbers.branches[i].shear;
    decay[i] = numbers.branches[i].time;
  }
  return unit_block(body.units, "#              MUNIT               LUNIT               TUNIT\n") +
         radioss_law("40", body) +
         "#                  K               G_inf              Astass              Bstass"
         "                 Kvm\n" +
         row20({numbers.bulk, numbers.equilibrium, 0.0, 0.0, 0.0}) +
         "#                 G1                  G2                  G3                  G4"
         "                  G5\n" +
         row20(shear) +
         "#              BETA1               BETA2               BETA3               BETA4"
         "               BETA5\n" +
         row20(decay);
}

// Where the law of one of the words begins, or the end of the lines. Takes the units of /UNIT.
std::size_t law_in(const std::vector<CardLine>& lines, const std::vector<std::string>& words,
                   ReadCard& card) {
  if (const std::string units = radioss_units(lines); !units.empty()) {
    card.units = unit_system(units);
    card.units_were_stated = true;
  }
  std::size_t at = lines.size();
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::string word = upper(trimmed(lines[i].text));
    if (std::none_of(words.begin(), words.end(),
                     [&](const std::string& one) { return word.rfind(one, 0) == 0; }))
      continue;
    if (at != lines.size()) card.add_second_material(lines[i]);
    at = std::min(at, i);
  }
  if (at + 1 >= lines.size()) return lines.size();
  const auto findings = radioss_keyword_findings(lines[at], lines);
  card.findings.insert(card.findings.end(), findings.begin(), findings.end());
  card.name = trimmed(lines[at + 1].text);
  return at;
}

void read_openradioss(const std::string& text, ReadCard& card) {
  const std::vector<CardLine> lines = card_lines(text, "#");
  const std::size_t at = law_in(lines, {"/MAT/LAW40", "/MAT/KELVINMAX"}, card);
  if (at + 5 >= lines.size()) {
    throw std::runtime_error(
        "the card has no complete /MAT/LAW40 (title and four lines of numbers)");
  }
  const auto row = [&](std::size_t offset) { return columns(lines[at + offset].text, 20); };
  card.numbers.density = cell_number_or_zero(row(2), 0, lines[at + 2], "RHO_I");
  card.numbers.bulk = cell_number(row(3), 0, lines[at + 3], "K");
  card.numbers.equilibrium = cell_number(row(3), 1, lines[at + 3], "G_inf");
  for (std::size_t i = 0; i < 5; ++i) {
    const double shear = cell_number_or_zero(row(4), i, lines[at + 4], "G");
    if (shear == 0.0) continue;
    card.numbers.branches.push_back(
        {shear, 0.0, cell_number_or_zero(row(5), i, lines[at + 5], "BETA")});
  }
}

// Laws of rubber.

using RadiossLines = std::vector<CardLine>;
using RadiossRow = std::vector<double>;
constexpr std::size_t kFive = 5;  // numbers to a line

std::string rows_of_five(const RadiossRow& numbers) {
  std::string text;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    text += real(numbers[i], 20);
    if (i % kFive == kFive - 1 || i + 1 == numbers.size()) text += "\n";
  }
  return text;
}

// A law of Ogden or a foam; `rest` are the rows of its terms, or of its nu.
std::string radioss_law62(const CardBody& body, double nu, const RadiossRow& mu,
                          const RadiossRow& alpha, std::size_t n_terms, const std::string& rest) {
  return radioss_law("62", body) +
         "#                 nu         N         M              mu_max\n" + real(nu, 20) +
         right(std::to_string(mu.size()), 10) + right(std::to_string(n_terms), 10) + real(0.0, 20) +
         "\n# mu\n" + rows_of_five(mu) + "# alpha\n" + rows_of_five(alpha) + rest;
}

std::string law62_of_foam(const CardBody& body) {
  RadiossRow mu, alpha, nu;
  for (const CardNumbers::FoamTerm& term : body.numbers.foam) {
    mu.push_back(term.mu);
    alpha.push_back(term.alpha);
    nu.push_back(term.nu);
  }
  return radioss_law62(body, 0.0, mu, alpha, 0, "# nu\n" + rows_of_five(nu));
}

std::string law62_with_terms(const CardBody& body) {
  const CardNumbers& law = body.numbers;
  if (!has_ogden_form(law.form)) {
    throw std::invalid_argument(
        "openradioss takes terms of relaxation in LAW62, which has no " + name_of(law.form) +
        " law; fit neo-hooke, mooney-rivlin or ogden with viscard fit --model, or write the law "
        "without them by --elastic-only long-term");
  }
  const CardNumbers ogden = as_ogden(law);
  RadiossRow shares, times;
  for (const CardBranch& branch : law.branches) {
    shares.push_back(branch.shear);
    times.push_back(branch.time);
  }
  return radioss_law62(body, poisson_ratio_of(law), ogden.moduli, ogden.shapes, shares.size(),
                       "# gamma\n" + rows_of_five(shares) + "# tau\n" + rows_of_five(times));
}

// LAW100 without networks of flow: the law of the invariants alone, D_1 = 2/K.
std::string radioss_law100(const CardBody& body) {
  const CardNumbers& law = body.numbers;
  const bool is_yeoh = law.form == HyperelasticForm::kYeoh,
             is_mooney = law.form == HyperelasticForm::kMooneyRivlin;
  RadiossRow constants = law.moduli;
  constants.push_back(law.d());
  const char* const names =
      is_yeoh ? "#                C10                 C20                 C30                  D1\n"
      : is_mooney ? "#                C10                 C01                  D1\n"
                  : "#                C10                  D1\n";
  return radioss_law("100", body) + "#    N_net   Flag_HE   Flag_Cr\n" + right("0", 10) +
         right(is_yeoh     ? "5"
               : is_mooney ? "4"
                           : "3",
               10) +
         right("0", 10) + "\n" + names + row20(constants);
}

// R, beta, m: another order than that of Abaqus. m is converted as an energy, not as one per volume.
std::string radioss_damage(const CardNumbers& law) {
  if (!law.damage) return "";
  return "# /BEGIN needs the units of /UNIT/1: m would be converted as an energy, without the "
         "volume\n"
         "/FAIL/MULLINS_OR/1/1\n#                  R                BETA                   m\n" +
         row20({law.damage->r, law.damage->beta, law.damage->m});
}

std::string elastic_law(const CardBody& body) {
  const CardNumbers& law = body.numbers;
  if (law.form == HyperelasticForm::kArrudaBoyce) {
    return radioss_law("92", body) +
           "#                 mu                   D            lambda_m\n" +
           row20({law.moduli[0], law.d(), law.shapes[0]}) +
           "#    Itype    fct_ID                  nu              Fscale\n" + right("0", 10) +
           right("0", 10) + row20({0.0, 0.0});
  }
  if (law.damage) return radioss_law100(body);
  if (law.form == HyperelasticForm::kYeoh) {
    return radioss_law("94", body) +
           "\n#                C10                 C20                 C30\n" + row20(law.moduli) +
           "#                 D1                  D2                  D3\n" +
           row20({law.d(), 0.0, 0.0});
  }
  const CardNumbers ogden = as_ogden(law);
  RadiossRow d(ogden.moduli.size(), 0.0);
  d[0] = law.d();
  return radioss_law("82", body) + "#        N                            nu\n" +
         right(std::to_string(ogden.moduli.size()), 10) + right("", 10) + real(0.0, 20) +
         "\n# mu\n" + row20(ogden.moduli) + "# alpha\n" + row20(ogden.shapes) + "# D\n" + row20(d);
}

std::string write_openradioss_law(const CardBody& body) {
  const CardNumbers& law = body.numbers;
  return unit_block(body.units, "") +
         (!law.foam.empty()       ? law62_of_foam(body)
          : !law.branches.empty() ? law62_with_terms(body)
                                  : elastic_law(body)) +
         radioss_damage(law);
}

// At least `least` numbers of a row; blank fields are 0.
RadiossRow numbers_at(const RadiossLines& lines, std::size_t at, std::size_t least) {
  if (at >= lines.size()) throw std::runtime_error("the card ends before its last row");
  const auto row = columns(lines[at].text, 20);
  RadiossRow out;
  for (std::size_t i = 0; i < row.size(); ++i)
    out.push_back(cell_number_or_zero(row, i, lines[at], "number"));
  out.resize(std::max(out.size(), least), 0.0);
  return out;
}

// `count` numbers, five to a line, from line `at`, which moves on.
RadiossRow list_at(const RadiossLines& lines, std::size_t& at, std::size_t count) {
  RadiossRow out;
  while (out.size() < count) {
    RadiossRow row = numbers_at(lines, at++, 0);
    if (row.empty()) throw std::runtime_error(at_line(lines[at - 1], "a row has no numbers"));
    row.resize(std::min({row.size(), kFive, count - out.size()}));
    out.insert(out.end(), row.begin(), row.end());
  }
  return out;
}

void read_law62(const RadiossLines& lines, ReadCard& card) {
  const auto head = columns(lines[3].text, 10);  // nu in two of them, N, M
  const auto n = static_cast<std::size_t>(cell_integer(head, 2, lines[3], "N")),
             m = head.size() > 3 && !head[3].empty()
                     ? static_cast<std::size_t>(cell_integer(head, 3, lines[3], "M"))
                     : 0;
  CardNumbers& law = card.numbers;
  law.poisson = cell_number_or_zero(columns(lines[3].text, 20), 0, lines[3], "nu");
  std::size_t at = 4;
  const auto mu = list_at(lines, at, n), alpha = list_at(lines, at, n);
  const auto gamma = list_at(lines, at, m), tau = list_at(lines, at, m);
  for (std::size_t i = 0; i < m; ++i) law.branches.push_back({gamma[i], 0.0, tau[i]});
  const bool has_nu =
      at < lines.size() && !trimmed(lines[at].text).empty() && lines[at].text[0] != '/';
  RadiossRow nu = has_nu ? list_at(lines, at, n) : RadiossRow{};
  const bool is_zero = std::all_of(nu.begin(), nu.end(), [](double one) { return one == 0.0; });
  // A row of nu_i without terms: a foam; if all of them are 0, the nu of the first line holds.
  if (m == 0 && has_nu) {
    if (is_zero) nu.assign(n, law.poisson);
    if (!is_zero) card.also_read += std::to_string(law.poisson);
    law.poisson = 0.0;
    return take_foam_terms(mu, alpha, nu, law);
  }
  card.understood.elastic = ElasticForm::kPoissonOnly;  // 0: K = 2 G/3 (hm_read_mat62.F)
  take_ogden(mu, alpha, law);
  if (!is_zero)
    add_other_law(lines[at - 1],
                  "nu_i is not 0: a foam (Ogden-Storakers), whose nu_i hold instead of nu", card);
}

// /FAIL/MULLINS_OR/mat_ID/unit_ID of the law: R, beta, m (fail_mullins_or.cfg); R = 0 is read as 1.
void read_radioss_damage(const RadiossLines& all, const CardLine& law, ReadCard& card) {
  const auto parts_of = [](const CardLine& line) {
    auto parts = cells(trimmed(line.text), '/');  // "", FAIL, MULLINS_OR, 1, 1
    parts.resize(std::max<std::size_t>(parts.size(), 5));
    return parts;
  };
  const auto wanted = parts_of(law);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto parts = parts_of(all[i]);
    if (upper(parts[1]) != "FAIL" || upper(parts[2]) != "MULLINS_OR" || parts[3] != wanted[3])
      continue;
    const auto numbers = numbers_at(all, i + 1, 3);
    card.numbers.damage = {numbers[0] == 0.0 ? 1.0 : numbers[0], numbers[2], numbers[1]};
    if (parts[4] != wanted[4]) {
      card.add("unit-block",
               at_line(all[i],
                       "the damage takes other units than the law, and m is converted "
                       "as an energy, without the volume; name the same unit block"));
    }
    const std::string number = wanted[2].size() > 3 ? wanted[2].substr(3) : "";
    if (number != "92" && number != "95" && number != "100") {
      card.add("ignored-damage",
               at_line(all[i],
                       "/FAIL/MULLINS_OR acts on LAW92, 95 and 100 only: the law has no damage"));
    }
    return;
  }
}

// LAW100: N_net, Flag_HE, Flag_Cr, then the constants of the law (hm_read_mat100.F).
void read_law100(const RadiossLines& rows, ReadCard& card) {
  using enum HyperelasticForm;
  const auto flags = rows.empty() ? std::vector<std::string>{} : columns(rows[0].text, 10);
  const auto flag = [&](std::size_t i, const char* name) {
    return i < flags.size() && !flags[i].empty() ? cell_integer(flags, i, rows[0], name) : 0;
  };
  if (flag(0, "N_net") != 0 || flag(2, "Flag_Cr") != 0)
    add_other_law(rows[0], "networks of flow or creep of LAW100 are not read", card);
  const int form = flag(1, "Flag_HE");
  auto first = numbers_at(rows, 1, kFive);
  CardNumbers& law = card.numbers;
  if (form == 1) {
    const auto second = numbers_at(rows, 2, 4);
    first.resize(kFive);
    first.insert(first.end(), second.begin(), second.end());
    take_invariant_law(first, law);
    law.bulk = bulk_of_d(numbers_at(rows, 3, 1)[0]);
  } else if (form == 2) {
    take_law(kArrudaBoyce, {first[0]}, {first[2]}, law);
    law.bulk = bulk_of_d(first[1]);
  } else if (form >= 3 && form <= 5) {
    const auto n = form - 2;
    const HyperelasticForm forms[] = {kNeoHooke, kMooneyRivlin, kYeoh};
    take_law(forms[form - 3], {first.begin(), first.begin() + n}, {}, law);
    law.bulk = bulk_of_d(first[static_cast<std::size_t>(n)]);
  } else {
    throw std::runtime_error("LAW100 has Flag_HE " + std::to_string(form) + "; 1 to 5 are read");
  }
}

void read_openradioss_law(const std::string& text, ReadCard& card) {
  using enum HyperelasticForm;
  const RadiossLines all = card_lines(text, "#");
  const std::size_t begin =
      law_in(all, {"/MAT/LAW62", "/MAT/LAW82", "/MAT/LAW92", "/MAT/LAW94", "/MAT/LAW100"}, card);
  require_in_card(begin < all.size(), "/MAT/LAW62, 82, 92, 94 or 100");
  const RadiossLines lines(all.begin() + static_cast<std::ptrdiff_t>(begin), all.end());
  if (lines.size() < 4) throw std::runtime_error("the card ends before its last row");
  CardNumbers& law = card.numbers;
  law.density = numbers_at(lines, 2, 1)[0];
  read_radioss_damage(all, lines[0], card);
  const std::string number = std::string(trimmed(lines[0].text)).substr(8, 2);
  if (number == "62") return read_law62(lines, card);
  RadiossLines rows(lines.begin() + 3, lines.end());
  std::erase_if(rows, [](const CardLine& line) { return trimmed(line.text).empty(); });
  if (number == "10") return read_law100(rows, card);
  if (number == "82") {
    const auto n = static_cast<std::size_t>(
        rows.empty() ? 0 : cell_integer(columns(rows[0].text, 10), 0, rows[0], "N"));
    std::size_t at = 1;
    const auto mu = list_at(rows, at, n), alpha = list_at(rows, at, n), d = list_at(rows, at, n);
    take_ogden(mu, alpha, law);
    law.bulk = bulk_of_d(d[0]);
    return;
  }
  auto first = numbers_at(rows, 0, 3);
  if (number == "94") {
    first.resize(3);
    take_law(kYeoh, first, {}, law);
    law.bulk = bulk_of_d(numbers_at(rows, 1, 1)[0]);
  } else {
    take_law(kArrudaBoyce, {first[0]}, {first[2]}, law);
    law.bulk = bulk_of_d(first[1]);
  }
}

// Explicit: about (end time) * (wave speed) / (edge) cycles, half a minute for a few seconds of
// PDMS on one element with an edge of 1 mm.
std::vector<DeckFile> openradioss_deck(const DeckInput& input, const std::string& name) {
  const double end = input.end();
  const RadiossModel model{.name = name,
                           .units = unit_row(input.units),
                           .card = input.card.text,
                           .curve = ramp_rows(input),
                           .is_creep = input.is_creep()};
  return {{name + "_0000.rad", radioss_starter(model)},
          {name + "_0001.rad", "#RADIOSS ENGINE\n/RUN/" + name + "/1\n" + real(end, 20) +
                                   "\n/VERS/2022\n/TFILE\n" + real(end / 1000.0, 20) +
                                   "\n/PRINT/-100000\n"}};
}

}  // namespace

CardTarget openradioss_target() {
  return {
      .name = "openradioss",
      .code = "OpenRadioss /MAT/LAW40",
      .extension = ".rad",
      .comment = "#",
      .write = write_openradioss,
      .read = read_openradioss,
      .deck = DeckWriter{openradioss_deck, "starter -i {0}_0000.rad && engine -i {0}_0001.rad"},
      .laws =
          LawColumn{
              .write = write_openradioss_law,
              .read = read_openradioss_law,
              .keywords = {"as Ogden: mu = 2 C10, alpha = 2",
                           "as Ogden: mu = 2 C10, 2 C01, alpha = 2, -2", "LAW94: C10, C20, C30",
                           "LAW82 (with terms LAW62): mu_i, alpha_i", "LAW92: mu, lambda_m = s_m",
                           "", "LAW62: mu_i, alpha_i, nu_i of sum 2 mu_i/alpha_i^2 (...)"},
              .volume = "by D_1 = 2/K (LAW62: by Poisson's ratio)",
              .takes_terms = true,
              .most_terms = 50,
              .terms = "LAW62: the law at once, gamma_i = g_i of its deviator, tau_i; Simo's "
                       "rule at large strain (its source), not run",
              .damage = {"/FAIL/MULLINS_OR: R, beta, m",
                         "its /FAIL/MULLINS_OR acts on LAW92, 95 and 100 only, which have no "
                         "such law",
                         {HyperelasticForm::kNeoHooke, HyperelasticForm::kMooneyRivlin,
                          HyperelasticForm::kYeoh, HyperelasticForm::kArrudaBoyce},
                         "LAW100 without networks: C10, C01 or C10, C20, C30; LAW92: mu, "
                         "lambda_m = s_m"}},
      .elastic = ElasticForm::kBulkOnly,
      .at = ModulusAt::kLongTerm,
      .branch = BranchNumber::kAbsoluteShear,
      .time = TimeNumber::kBeta,
      .bulk = BulkRule::kConstantBulk,
      .states_equilibrium = true,
      .is_case_sensitive = false,
      .reads_fortran_numbers = true,
      .max_terms = 5,
      .needs_density = true,
      .evidence = Evidence::kSource,
      .evidence_note = "format definition of the open source code; not run",
      .advice = "The card declares its units in /UNIT; solid elements only."};
}

}  // namespace viscard
