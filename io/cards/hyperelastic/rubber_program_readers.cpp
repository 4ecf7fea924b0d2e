// Cards of rubber that are programs: a Python module for SfePy and an MFront behaviour, with any numbers but as
// viscard writes them; conventions and sources as in rubber_models.cpp and rubber_mfront.cpp.
#include "io/basics/patterns.h"
#include "io/cards/card_lines.h"
#include "io/cards/hyperelastic/rubber_readers.h"
#include "io/cards/named_values.h"

#include <algorithm>
#include <map>
#include <stdexcept>

namespace viscard {
namespace {

using ModelForm = HyperelasticForm;
using NumberLists = std::map<std::string, std::vector<double>>;

// Numbers of a list in a program, with brackets of any kind: "[[0.4, 2]]", "{1, 2}", "0.4".
std::vector<double> numbers_of_list(std::string text, const CardLine& line) {
  std::erase_if(text, [](char c) { return std::string("[]{}()").find(c) != std::string::npos; });
  std::vector<double> out;
  for (const std::string& cell : cells(text, ',')) {
    if (!cell.empty()) out.push_back(card_number(cell, line, "number"));
  }
  return out;
}

double only_number(const NumberLists& lists, const std::string& name) {
  const auto found = lists.find(name);
  if (found == lists.end()) throw std::runtime_error("the card has no " + name);
  if (found->second.size() == 1) return found->second[0];
  throw std::runtime_error(name + " must be one number and has " +
                           std::to_string(found->second.size()));
}

// Shares and times of relaxation of one length; those of no share are left out.
void take_terms(const NumberLists& lists, const char* share, const char* time, RubberText& out) {
  const auto g = lists.find(share), tau = lists.find(time);
  if (g == lists.end() && tau == lists.end()) return;
  if (g == lists.end() || tau == lists.end() || g->second.size() != tau->second.size())
    throw std::runtime_error(std::string(share) + " and " + time + " must have the same length");
  for (std::size_t i = 0; i < g->second.size(); ++i) {
    if (g->second[i] != 0.0) out.numbers.terms.push_back({g->second[i], tau->second[i]});
  }
}

// Rows of the dictionary VALUES and of the list TERMS of a module for SfePy, and its other lists.
struct SfepyModule {
  NumberLists values, others;
  std::vector<std::pair<std::string, std::string>> terms;  // of SfePy, and the value it takes
};

SfepyModule sfepy_module(const std::string& commented) {
  SfepyModule out;
  for (const CardLine& line : card_lines(without_line_comments(commented, "#"), "\n")) {
    if (const auto row =
            first_match(line.text, "^\\s+[\"'](\\w+)[\"']\\s*:\\s*([-+.\\deE, \\[\\]]+)$"))
      out.values[row->group[1]] = numbers_of_list(row->group[2], line);
    if (const auto row = first_match(
            line.text, "^\\s+\\(\\s*[\"'](dw_\\w+)[\"']\\s*,\\s*[\"'](\\w+)[\"']\\s*\\),?\\s*$"))
      out.terms.emplace_back(row->group[1], row->group[2]);
    if (const auto row = first_match(line.text, "^(G|TAU|DENSITY)\\s*=\\s*([-+.\\deE, \\[\\]]+)$"))
      out.others[row->group[1]] = numbers_of_list(row->group[2], line);
  }
  return out;
}

// Pairs of a factor and an exponent.
void take_pairs(const std::vector<double>& numbers, std::vector<double>& factors,
                std::vector<double>& exponents) {
  if (numbers.size() % 2 != 0) throw std::runtime_error("a list of pairs has an odd number");
  for (std::size_t i = 0; i + 1 < numbers.size(); i += 2) {
    factors.push_back(numbers[i]);
    exponents.push_back(numbers[i + 1]);
  }
}

// Yeoh's constants from the powers of I1 - 3.
std::vector<double> yeoh_of(const std::vector<double>& factors, const std::vector<double>& powers) {
  std::vector<double> out(3, 0.0);
  for (std::size_t i = 0; i < factors.size(); ++i) {
    if (powers[i] != 1.0 && powers[i] != 2.0 && powers[i] != 3.0)
      throw std::runtime_error("Yeoh's law has the powers 1, 2 and 3 of I1 - 3");
    out[static_cast<std::size_t>(powers[i]) - 1] += factors[i];
  }
  return out;
}

NumberLists mfront_parameters(const std::vector<CardLine>& lines) {
  NumberLists out;
  for (const CardLine& line : lines) {
    const auto row = first_match(
        line.text, "^\\s*@Parameter\\s+real\\s+(\\w+)(?:\\[\\w+\\])?\\s*=\\s*([^;]*);\\s*$");
    if (!row) continue;
    if (!out.emplace(row->group[1], numbers_of_list(row->group[2], line)).second)
      throw std::runtime_error(at_line(line, row->group[1] + " is set a second time"));
  }
  return out;
}

void take_mfront_law(const NumberLists& lists, RubberNumbers& law) {
  const auto has = [&](const char* name) { return lists.contains(name); };
  if (has("alpha")) {
    std::vector<double> mu = lists.contains("mu") ? lists.at("mu") : std::vector<double>{},
                        alpha = lists.at("alpha");
    while (mu.size() > 1 && mu.size() == alpha.size() && mu.back() == 0.0) {
      mu.pop_back();
      alpha.pop_back();
    }
    return take_ogden(mu, alpha, law);
  }
  if (has("s_m") || has("J_m")) {
    law.form = has("s_m") ? ModelForm::kArrudaBoyce : ModelForm::kGent;
    law.moduli = {only_number(lists, "mu")};
    law.shapes = {only_number(lists, has("s_m") ? "s_m" : "J_m")};
  } else if (has("C20")) {
    law.form = ModelForm::kYeoh;
    law.moduli = {only_number(lists, "C10"), only_number(lists, "C20"), only_number(lists, "C30")};
  } else {
    law.form = has("C01") ? ModelForm::kMooneyRivlin : ModelForm::kNeoHooke;
    law.moduli = {only_number(lists, "C10")};
    if (has("C01")) law.moduli.push_back(only_number(lists, "C01"));
  }
}

// The lines of a program that compute, without blanks at their end and comments, and without those of the pattern, whose
// numbers were read.
std::vector<CardLine> computing_lines(const std::string& text, const char* comment,
                                      const char* numbers, bool is_indented) {
  std::vector<CardLine> out;
  for (CardLine line : card_lines(without_line_comments(text, comment), "\n")) {
    if (first_match(line.text, numbers)) continue;
    const std::size_t indent = is_indented ? line.text.find_first_not_of(' ') : 0;
    std::erase_if(line.text, [](unsigned char c) { return c <= ' '; });
    if (line.text.empty()) continue;
    line.text.insert(0, indent, ' ');
    out.push_back(line);
  }
  return out;
}

// Throws for a program whose formula is not the one that viscard writes for the law.
void require_formula(const std::vector<CardLine>& found, const std::vector<CardLine>& expected) {
  for (std::size_t i = 0; i < expected.size(); ++i) {
    if (i < found.size() && found[i].text == expected[i].text) continue;
    const std::string what = "the formula of the card is not that of viscard's card of its law";
    throw std::runtime_error(i < found.size() ? at_line(found[i], what) : what + ": it ends early");
  }
  if (found.size() > expected.size())
    throw std::runtime_error(
        at_line(found[expected.size()], "viscard's card of this law has no such line"));
}

}  // namespace

RubberText read_sfepy_rubber(const std::string& text) {
  const SfepyModule module = sfepy_module(text);
  RubberText out;
  RubberNumbers& law = out.numbers;
  std::map<std::string, std::vector<double>> factors, exponents;
  double mu = 0.0, kappa = 0.0;
  for (const auto& [term, name] : module.terms) {
    if (term == "dw_tl_he_neohook") {
      mu += only_number(module.values, name);
    } else if (term == "dw_tl_he_mooney_rivlin") {
      kappa += only_number(module.values, name);
    } else if (term == "dw_tl_bulk_penalty") {
      law.bulk += only_number(module.values, name);
    } else if (term == "dw_tl_he_ogden" || term == "dw_tl_he_genyeoh") {
      const auto pairs = module.values.find(name);
      if (pairs == module.values.end()) throw std::runtime_error("the card has no " + name);
      take_pairs(pairs->second, factors[term], exponents[term]);
    } else {
      throw std::runtime_error("the term " + term + " of SfePy is not read");
    }
  }
  const bool has_invariants = mu != 0.0 || kappa != 0.0;
  if (factors.size() + (has_invariants ? 1 : 0) != 1)
    throw std::runtime_error(
        "the card has no terms dw_tl_he_... of one law in its TERMS, or those of several");
  if (has_invariants) {
    take_invariant_law({mu / 2.0, kappa / 2.0}, law);
  } else if (auto own = factors.find("dw_tl_he_ogden"); own != factors.end()) {
    const std::vector<double>& alpha = exponents.at(own->first);
    for (std::size_t i = 0; i < alpha.size(); ++i) own->second[i] *= alpha[i] / 2.0;
    take_ogden(own->second, alpha, law);
  } else {
    law.form = ModelForm::kYeoh;
    law.moduli = yeoh_of(factors.at("dw_tl_he_genyeoh"), exponents.at("dw_tl_he_genyeoh"));
  }
  if (module.others.contains("DENSITY")) law.density = only_number(module.others, "DENSITY");
  take_terms(module.others, "G", "TAU", out);
  const auto lines_of = [](const std::string& card) {
    const std::string list = "[-+.\\deE, \\[\\]]+$";
    const std::string pattern =
        "^\\s+[\"']\\w+[\"']\\s*:\\s*" + list +
        "|^\\s+\\(\\s*[\"']dw_\\w+[\"']\\s*,\\s*[\"']\\w+[\"']\\s*\\),?\\s*$" +
        "|^(G|TAU|DENSITY)\\s*=\\s*" + list;
    return computing_lines(card, "#", pattern.c_str(), true);
  };
  // A module of values alone computes nothing by itself.
  const auto found = lines_of(text);
  if (found.size() > 4) require_formula(found, lines_of(sfepy_rubber(law)));
  return out;
}

RubberText read_mfront_rubber(const std::string& text) {
  const auto lines = card_lines(text, "//");
  const auto name = [&] {
    for (const CardLine& line : lines) {
      if (const auto row = first_match(line.text, "^\\s*@Behaviour\\s+(\\w+)\\s*;\\s*$"))
        return row->group[1];
    }
    throw std::runtime_error("the card has no @Behaviour");
  }();
  const NumberLists lists = mfront_parameters(lines);
  RubberText out;
  out.numbers.bulk = only_number(lists, "K");
  take_mfront_law(lists, out.numbers);
  take_terms(lists, "g", "tau", out);
  const auto lines_of = [](const std::string& card) {
    return computing_lines(card, "//", "^\\s*@Parameter", false);
  };
  require_formula(lines_of(text), lines_of(mfront_rubber(out.numbers, name)));
  return out;
}

}  // namespace viscard
