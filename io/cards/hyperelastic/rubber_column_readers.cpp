// Cards of rubber in columns: LS-DYNA 077 and OpenRadioss; conventions and sources as in rubber_rows.cpp and
// rubber_terms.cpp.
#include "io/cards/card_lines.h"
#include "io/cards/column_fields.h"
#include "io/cards/hyperelastic/rubber_readers.h"
#include "io/cards/keyword_lines.h"

#include <algorithm>
#include <stdexcept>

namespace viscard {
namespace {

using ColumnForm = HyperelasticForm;
using Lines = std::vector<CardLine>;

// Lines from the one that contains one of the words on; throws if there is none.
Lines lines_from(const Lines& lines, const std::vector<std::string>& words,
                 const std::string& what) {
  const auto found = std::find_if(lines.begin(), lines.end(), [&](const CardLine& line) {
    const std::string text = upper(line.text);
    return std::any_of(words.begin(), words.end(),
                       [&](const std::string& word) { return text.rfind(word, 0) == 0; });
  });
  require_in_card(found != lines.end(), what);
  return {found, lines.end()};
}

// Numbers of a row; blank fields are 0.
std::vector<double> row_at(const Lines& lines, std::size_t at, std::size_t width) {
  if (at >= lines.size()) throw std::runtime_error("the card ends before its last row");
  const auto row = columns(lines[at].text, width);
  std::vector<double> out;
  for (std::size_t i = 0; i < row.size(); ++i)
    out.push_back(cell_number_or_zero(row, i, lines[at], "number"));
  return out;
}

double at_or_zero(const std::vector<double>& row, std::size_t i) {
  return i < row.size() ? row[i] : 0.0;
}

// 077_H: C10, C01, C11, C20, C02, C30.
void take_077_H(std::vector<double> c, RubberNumbers& law) {
  c.resize(6, 0.0);
  take_invariant_law({c[0], c[1], c[3], c[2], c[4], c[5]}, law);
}

constexpr std::size_t kTen = 10, kTwenty = 20, kPerLine = 5;

// `count` numbers, five to a line, from line `at`, which moves on.
std::vector<double> list_at(const Lines& lines, std::size_t& at, std::size_t count) {
  std::vector<double> out;
  while (out.size() < count) {
    std::vector<double> row = row_at(lines, at++, kTwenty);
    if (row.empty()) throw std::runtime_error(at_line(lines[at - 1], "a row has no numbers"));
    row.resize(std::min({row.size(), kPerLine, count - out.size()}));
    out.insert(out.end(), row.begin(), row.end());
  }
  return out;
}

// LAW62: law and terms.
void read_law62(const Lines& lines, RubberText& out) {
  const auto head = columns(lines[3].text, kTen);  // nu in two of them, N, M
  const auto n = static_cast<std::size_t>(cell_integer(head, 2, lines[3], "N")),
             m = head.size() > 3 && !head[3].empty()
                     ? static_cast<std::size_t>(cell_integer(head, 3, lines[3], "M"))
                     : 0;
  out.poisson = cell_number_or_zero(columns(lines[3].text, kTwenty), 0, lines[3], "nu");
  out.has_poisson = true;  // 0 is compressible: K = 2 G/3 (hm_read_mat62.F)
  std::size_t at = 4;
  const auto mu = list_at(lines, at, n), alpha = list_at(lines, at, n);
  const auto has_row = [&](std::size_t i) {
    return i < lines.size() && !trimmed(lines[i].text).empty() && lines[i].text[0] != '/';
  };
  // A row of nu_i without terms: a foam; if all of them are 0, the nu of the first line holds.
  if (m == 0 && has_row(at)) {
    auto nu = list_at(lines, at, n);
    const bool is_zero = std::all_of(nu.begin(), nu.end(), [](double one) { return one == 0.0; });
    if (is_zero) nu.assign(n, out.poisson);
    take_foam_terms(mu, alpha, nu, out.numbers);
    out.has_poisson = false;
    if (!is_zero) out.also_read += std::to_string(out.poisson);
    out.poisson = 0.0;
    return;
  }
  take_ogden(mu, alpha, out.numbers);
  const auto gamma = list_at(lines, at, m), tau = list_at(lines, at, m);
  for (std::size_t i = 0; i < m; ++i) out.numbers.terms.push_back({gamma[i], tau[i]});
  // A row of nu_i, one for each term: a foam, if one is not 0.
  if (at >= lines.size() || trimmed(lines[at].text).empty() || lines[at].text[0] == '/') return;
  const auto nu = list_at(lines, at, n);
  for (std::size_t i = 0; i < nu.size(); ++i) {
    if (nu[i] == 0.0) continue;
    out.findings.push_back(
        {"other-law",
         at_line(lines[at - 1],
                 "nu_i is not 0: a foam (Ogden-Storakers), whose nu_i hold instead of nu"),
         true});
    return;
  }
}

double bulk_from(double d) {
  return d > 0.0 ? 2.0 / d : 0.0;
}

// /FAIL/MULLINS_OR/mat_ID/unit_ID of the law: R, beta, m (fail_mullins_or.cfg); R = 0 is read as 1.
void read_radioss_damage(const Lines& all, const CardLine& law, RubberText& out) {
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
    auto numbers = row_at(all, i + 1, kTwenty);
    numbers.resize(3, 0.0);
    out.numbers.damage = {numbers[0] == 0.0 ? 1.0 : numbers[0], numbers[2], numbers[1]};
    if (parts[4] != wanted[4]) {
      out.findings.push_back(
          {"unit-block",
           at_line(all[i],
                   "the damage takes other units than the law, and m is converted as an "
                   "energy, without the volume; name the same unit block"),
           true});
    }
    const std::string number = wanted[2].size() > 3 ? wanted[2].substr(3) : "";
    if (number != "92" && number != "95" && number != "100") {
      out.findings.push_back(
          {"ignored-damage",
           at_line(all[i],
                   "/FAIL/MULLINS_OR acts on LAW92, 95 and 100 only: the law has no damage"),
           true});
    }
    return;
  }
}

}  // namespace

namespace {

// *MAT_HILL_FOAM (177): MID RO K N MU LCID FITTYPE LCSR / C1 to C8 / B1 to B8 / R M.
RubberText read_hill_foam(const Lines& all, const Lines& lines) {
  const std::size_t width = dyna_width(all, lines[0]);
  std::size_t at = upper(lines[0].text).find("_TITLE") != std::string::npos ? 2 : 1;
  RubberText out;
  if (at < lines.size()) {
    const auto fields = columns(lines[at].text, width);
    out.findings = material_number_findings(fields.empty() ? "" : fields[0], lines[at]);
  }
  const auto head = row_at(lines, at++, width);
  out.numbers.density = at_or_zero(head, 1);
  out.numbers.bulk = at_or_zero(head, 2);
  const double beta = at_or_zero(head, 3), nu = beta / (1.0 + 2.0 * beta);
  out.also_read = std::to_string(at_or_zero(head, 4));  // damping
  if (at_or_zero(head, 5) != 0.0)
    throw std::runtime_error("LCID is not 0: LS-DYNA fits the constants, and the card has none");
  const auto factors = row_at(lines, at++, width), exponents = row_at(lines, at++, width);
  std::vector<double> mu, alpha;
  for (std::size_t i = 0; i < factors.size() && i < exponents.size(); ++i) {
    if (factors[i] == 0.0 || exponents[i] == 0.0) break;
    mu.push_back(factors[i] * exponents[i] / 2.0);
    alpha.push_back(exponents[i]);
  }
  take_foam_terms(mu, alpha, std::vector<double>(mu.size(), nu), out.numbers);
  const auto last = at < lines.size() ? row_at(lines, at, width) : std::vector<double>{};
  if (at_or_zero(last, 0) == 0.0) return out;
  out.findings.push_back(
      {"other-law", at_line(lines[at], "R is not 0: a foam with damage, which is not read"), true});
  return out;
}

}  // namespace

RubberText read_lsdyna_rubber(const std::string& text) {
  const Lines all = card_lines(text, "$");
  const auto is_foam = [](const CardLine& line) {
    const std::string word = upper(line.text);
    return word.rfind("*MAT_HILL_FOAM", 0) == 0 || word.rfind("*MAT_177", 0) == 0;
  };
  if (const auto found = std::find_if(all.begin(), all.end(), is_foam); found != all.end())
    return read_hill_foam(all, {found, all.end()});
  const Lines lines =
      lines_from(all, {"*MAT_OGDEN_RUBBER", "*MAT_077_O", "*MAT_HYPERELASTIC_RUBBER", "*MAT_077_H"},
                 "*MAT_OGDEN_RUBBER or *MAT_HYPERELASTIC_RUBBER");
  const std::string keyword = upper(lines[0].text);
  const std::size_t width = dyna_width(all, lines[0]);
  std::size_t at = keyword.find("_TITLE") != std::string::npos ? 2 : 1;
  RubberText out;
  RubberNumbers& law = out.numbers;
  if (at < lines.size()) {
    const auto fields = columns(lines[at].text, width);
    out.findings = material_number_findings(fields.empty() ? "" : fields[0], lines[at]);
  }
  const auto head = row_at(lines, at++, width);
  law.density = at_or_zero(head, 1);
  out.poisson = at_or_zero(head, 2);
  out.has_poisson = true;
  if (at_or_zero(head, 3) != 0.0)
    throw std::runtime_error("N is not 0: LS-DYNA fits the constants, and the card has none");
  const auto first = row_at(lines, at++, width);
  if (keyword.find("HYPER") != std::string::npos || keyword.find("077_H") != std::string::npos) {
    take_077_H(first, law);
  } else {
    const auto alpha = row_at(lines, at++, width);
    std::vector<double> moduli, shapes;
    for (std::size_t i = 0; i < first.size() && i < alpha.size(); ++i) {
      if (first[i] == 0.0 || alpha[i] == 0.0) break;
      moduli.push_back(first[i] * alpha[i] / 2.0);  // Ogden's own constants
      shapes.push_back(alpha[i]);
    }
    take_ogden(moduli, shapes, law);
  }
  for (; at < lines.size() && !lines[at].text.starts_with('*'); ++at) {
    const auto row = row_at(lines, at, width);
    if (row.empty() || row[0] == 0.0) continue;
    if (!(at_or_zero(row, 1) > 0.0))
      throw std::runtime_error(at_line(lines[at], "a row G_i lacks its BETA_i above 0"));
    law.terms.push_back({row[0], 1.0 / row[1]});
  }
  out.is_long_term = out.has_absolute_terms = !law.terms.empty();
  return out;
}

namespace {

// LAW100: N_net, Flag_HE, Flag_Cr, then the constants of the law (hm_read_mat100.F).
void read_law100(const Lines& rows, RubberText& out) {
  const auto flags = rows.empty() ? std::vector<std::string>{} : columns(rows[0].text, kTen);
  const auto flag = [&](std::size_t i, const char* name) {
    return i < flags.size() && !flags[i].empty() ? cell_integer(flags, i, rows[0], name) : 0;
  };
  if (flag(0, "N_net") != 0 || flag(2, "Flag_Cr") != 0) {
    out.findings.push_back(
        {"other-law", at_line(rows[0], "networks of flow or creep of LAW100 are not read"), true});
  }
  const int form = flag(1, "Flag_HE");
  auto first = row_at(rows, 1, kTwenty);
  first.resize(5, 0.0);
  RubberNumbers& law = out.numbers;
  if (form == 1) {
    auto second = row_at(rows, 2, kTwenty);
    second.resize(4, 0.0);
    first.insert(first.end(), second.begin(), second.end());
    take_invariant_law(first, law);
    law.bulk = bulk_from(at_or_zero(row_at(rows, 3, kTwenty), 0));
  } else if (form == 2) {
    law.form = ColumnForm::kArrudaBoyce;
    law.moduli = {first[0]};
    law.shapes = {first[2]};
    law.bulk = bulk_from(first[1]);
  } else if (form >= 3 && form <= 5) {
    law.form = form == 3   ? ColumnForm::kNeoHooke
               : form == 4 ? ColumnForm::kMooneyRivlin
                           : ColumnForm::kYeoh;
    const auto n = n_moduli(law.form);
    law.moduli.assign(first.begin(), first.begin() + n);
    law.bulk = bulk_from(first[static_cast<std::size_t>(n)]);
  } else {
    throw std::runtime_error("LAW100 has Flag_HE " + std::to_string(form) + "; 1 to 5 are read");
  }
}

}  // namespace

RubberText read_openradioss_rubber(const std::string& text) {
  const Lines all = card_lines(text, "#");
  const Lines lines =
      lines_from(all, {"/MAT/LAW62", "/MAT/LAW82", "/MAT/LAW92", "/MAT/LAW94", "/MAT/LAW100"},
                 "/MAT/LAW62, 82, 92, 94 or 100");
  if (lines.size() < 4) throw std::runtime_error("the card ends before its last row");
  RubberText out;
  out.units = radioss_units(all);
  out.findings = radioss_keyword_findings(lines[0], all);
  RubberNumbers& law = out.numbers;
  law.density = at_or_zero(row_at(lines, 2, kTwenty), 0);
  read_radioss_damage(all, lines[0], out);
  const std::string number = lines[0].text.substr(8, 2);
  if (number == "62") {
    read_law62(lines, out);
    return out;
  }
  Lines rows(lines.begin() + 3, lines.end());
  std::erase_if(rows, [](const CardLine& line) { return trimmed(line.text).empty(); });
  if (upper(lines[0].text).rfind("/MAT/LAW100", 0) == 0) {
    read_law100(rows, out);
    return out;
  }
  if (number == "82") {
    const auto n = static_cast<std::size_t>(
        rows.empty() ? 0 : cell_integer(columns(rows[0].text, kTen), 0, rows[0], "N"));
    std::size_t at = 1;
    const auto mu = list_at(rows, at, n), alpha = list_at(rows, at, n), d = list_at(rows, at, n);
    take_ogden(mu, alpha, law);
    law.bulk = bulk_from(d[0]);
    return out;
  }
  auto first = row_at(rows, 0, kTwenty);
  first.resize(3, 0.0);
  if (number == "94") {
    law.form = ColumnForm::kYeoh;
    law.moduli = first;
    law.bulk = bulk_from(at_or_zero(row_at(rows, 1, kTwenty), 0));
  } else {
    law.form = ColumnForm::kArrudaBoyce;
    law.moduli = {first[0]};
    law.bulk = bulk_from(first[1]);
    law.shapes = {first[2]};
  }
  return out;
}

}  // namespace viscard
