#include "io/flow/design/judgement_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

// A number with a unit in which it is easy to read.
struct ShownUnit {
  const char* si;
  double factor;
  const char* unit;
};
constexpr ShownUnit kShown[] = {{"m", 1e6, "um"}, {"Pa", 1e-3, "kPa"},     {"Pa/K", 1e-3, "kPa/K"},
                                {"N", 1e3, "mN"}, {"V/Pa", 1e6, "mV/kPa"}, {"Hz", 1.0, "Hz"}};

// Four digits, without an exponent where a reader would write none: "12340", not "1.234e+04".
std::string plain(double value) {
  if (!(std::abs(value) >= 9999.5 && std::abs(value) < 1e7)) return fmt::format("{:.4g}", value);
  const double step = std::pow(10.0, std::floor(std::log10(std::abs(value))) - 3.0);
  return fmt::format("{:.0f}", step * std::round(value / step));
}

std::string shown(double value, const RequirementKind& kind, bool with_unit) {
  // Shares are shown in per cent; counts and margins, which have lower limits, as they are.
  if (std::string(kind.unit) == "1") {
    return kind.is_upper ? fmt::format("{:.3g}{}", 100.0 * value, with_unit ? " %" : "")
                         : fmt::format("{:.4g}", value);
  }
  for (const ShownUnit& one : kShown) {
    if (kind.unit != std::string(one.si)) continue;
    return plain(one.factor * value) + (with_unit ? std::string(" ") + one.unit : "");
  }
  return plain(value) + (with_unit ? std::string(" ") + kind.unit : "");
}

// Lines of at most 80 columns, the further ones indented like the first.
std::string wrapped(const std::string& text) {
  constexpr std::size_t kColumns = 80;
  const std::string indent = "      ";
  std::string out, line = indent;
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    const std::string word = text.substr(begin, end - begin);
    if (line.size() > indent.size() && line.size() + 1 + word.size() > kColumns) {
      out += line + "\n";
      line = indent;
    }
    line += (line.size() > indent.size() ? " " : "") + word;
    begin = end + 1;
  }
  return out + line + "\n";
}

std::string remedies_text(const JudgedLine& line) {
  std::string cut_off =
      "the search for single dimensions that would pass was cut off by --search-time, in which the "
      "judgement itself does not count; a longer one gives it more";
  if (line.remedies.empty() && !line.is_search_complete) return cut_off;
  if (line.remedies.empty()) {
    return "no single dimension within a factor of 4 would pass, others fixed";
  }
  std::string text = "would pass, others fixed: ";
  for (std::size_t i = 0; i < line.remedies.size(); ++i) {
    const Remedy& one = line.remedies[i];
    text += fmt::format("{}{} {:.3g} um in the place of {:.3g} um", i > 0 ? "; or " : "",
                        one.key.substr(one.key.find('.') + 1), 1e6 * one.to_m, 1e6 * one.from_m);
  }
  return line.is_search_complete ? text : text + "; " + cut_off;
}

}  // namespace

std::string text_from_judgement(const Judgement& judgement) {
  std::string text = judgement.name.empty() ? "" : wrapped("Requirements: " + judgement.name);
  text += fmt::format("  {:<20} {:>10} {:>9}    {:<12} {:>6}  {}\n", "requirement", "computed",
                      "+-", "limit", "margin", "verdict");
  for (const JudgedLine& line : judgement.lines) {
    const RequirementKind& kind = *line.kind;
    const bool has_value = line.found.is_answered;
    text += fmt::format("  {:<20} {:>10} {:>9} {} {:<12} {:>6}  {}\n", kind.key,
                        has_value ? shown(line.found.value, kind, false) : "-",
                        has_value ? shown(line.found.error_estimate, kind, false) : "-",
                        kind.is_upper ? "<=" : ">=", shown(line.limit, kind, true),
                        has_value ? fmt::format("{:.3g}", line.margin) : "-",
                        line.verdict == Verdict::kPass   ? "pass"
                        : line.verdict == Verdict::kFail ? "FAIL"
                                                         : word_of(line.verdict));
    std::string note = std::string(kind.what) + ": ";
    if (!has_value) note = "not answered: ";
    if (line.verdict == Verdict::kUndecided) note = "undecided within its error; " + note;
    text += wrapped(note + line.found.how);
    if (line.verdict == Verdict::kFail) text += wrapped(remedies_text(line));
  }
  const auto count = [&](Verdict verdict) {
    return std::count_if(judgement.lines.begin(), judgement.lines.end(),
                         [&](const JudgedLine& line) { return line.verdict == verdict; });
  };
  return text + fmt::format("  {} pass, {} fail, {} undecided, {} not answered\n",
                            count(Verdict::kPass), count(Verdict::kFail),
                            count(Verdict::kUndecided), count(Verdict::kNotAnswered));
}

void show_line(ResultVisitor& v, const JudgedLine& line, const std::function<void()>& more) {
  const RequirementKind kind = line.kind == nullptr ? requirement_kinds().front() : *line.kind;
  const auto if_answered = [&](double value) {
    return line.found.is_answered ? value : number_or_null(std::nullopt);
  };
  v("error_estimate", if_answered(line.found.error_estimate), "of the value, absolute");
  v("is_upper", kind.is_upper, "false: a lower limit");
  v("limit", line.limit, "that it must keep");
  v("margin", if_answered(line.margin),
    "limit over value, or its inverse for a lower limit: below 1 it fails");
  more();
  v("quantity", kind.what, "what was computed");
  v("reason", line.found.how, "how it was computed, or why it is not answered");
  v("requirement", kind.key, "key in [require]");
  v("unit", kind.unit, "SI, of limit, value and error");
  v("value", if_answered(line.found.value), "computed; null: not answered");
  v.word("verdict", word_of(line.verdict), {"pass", "fail", "undecided", "not answered"},
         "undecided: nearer to the limit than its error");
}

void show_keys(ResultVisitor& v, const Judgement& judgement) {
  v.list("lines", "the requirements", judgement.lines, [&](const JudgedLine& line) {
    show_line(v, line, [&] {
      v.list("remedies",
             "single dimensions that would pass, others fixed; the smallest change first",
             line.remedies, [&](const Remedy& one) {
               v("error_estimate", one.found.error_estimate, "its error");
               v("from_m", one.from_m, "what the scene has");
               v("key", one.key, "in the scene");
               v("to_m", one.to_m, "what passes");
               v("value", one.found.value, "the quantity there");
             });
      v("search_is_complete", line.is_search_complete,
        "false: the time for the remedies was not enough");
    });
  });
  v("name", judgement.name, "of the requirements");
  v("passes", judgement.passes(), "whether every requirement passes");
}

}  // namespace viscard
