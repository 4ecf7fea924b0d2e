#include "io/report/report.h"
#include "tests/io/plots/markup.h"
#include "tests/io/report/synthetic_report.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <regex>
#include <set>

using namespace viscard;
using namespace viscard::test;

namespace {

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

bool shows(const std::vector<ShownNumber>& numbers, double value_SI) {
  return std::any_of(numbers.begin(), numbers.end(), [&](const ShownNumber& number) {
    return std::abs(number.value_SI - value_SI) <= 1e-14 * std::abs(value_SI);
  });
}

std::string html_of(const ReportInput& input) {
  return render_report(input).html;
}

// The page without its pictures and cards: what a reader sees as text.
std::string words_of(std::string html) {
  for (const auto& [begin, end] : {std::pair<std::string, std::string>{"<svg", "</svg>"},
                                   {"<style", "</style>"},
                                   {"<details", "</details>"}}) {
    for (std::size_t at = html.find(begin); at != std::string::npos; at = html.find(begin, at)) {
      html.erase(at, html.find(end, at) + end.size() - at);
    }
  }
  return text_of(html);
}

const std::string& full_page() {
  static const std::string html = html_of(synthetic_report());
  return html;
}

}  // namespace

TEST_CASE("the page is well-formed, with unique ids and links that lead somewhere",
          "[io][report]") {
  CHECK(first_fault(full_page()) == "");
  const std::vector<std::string> ids = ids_of(full_page());
  const std::set<std::string> unique(ids.begin(), ids.end());
  CHECK(unique.size() == ids.size());
  for (std::size_t at = full_page().find("href=\"#"); at != std::string::npos;
       at = full_page().find("href=\"#", at + 1)) {
    const std::size_t begin = at + 7;
    const std::string target = full_page().substr(begin, full_page().find('"', begin) - begin);
    CHECK(unique.count(target) == 1);
  }
}

TEST_CASE("the page needs nothing from outside and runs no script", "[io][report]") {
  for (const char* outside : {"<script", "<link", "<img", "<iframe", "@import", "url(", "src="}) {
    CAPTURE(outside);
    CHECK_FALSE(has(full_page(), outside));
  }
  for (std::size_t at = full_page().find("http"); at != std::string::npos;
       at = full_page().find("http", at + 1)) {
    CHECK(full_page().compare(at, 18, "http://www.w3.org/") == 0);  // names of XML dialects only
  }
}

TEST_CASE("numbers on the page are those of the input", "[io][report]") {
  const ReportInput input = synthetic_report();
  const std::vector<ShownNumber> numbers = numbers_of(full_page());
  for (const SpecimenReport& specimen : input.specimens) {
    const FitResult& fit = *specimen.fit;
    CHECK(shows(numbers, fit.E0_Pa));
    CHECK(shows(numbers, fit.E_inf_Pa));
    CHECK(shows(numbers, fit.two_point->modulus_Pa));
    CHECK(shows(numbers, fit.two_point->half_space_modulus_Pa));
    CHECK(shows(numbers, specimen.truth->material.E0_Pa));
    CHECK(shows(numbers, specimen.pillar->creep.largest_relative_error));
    for (const FittedTerm& term : fit.terms) {
      CHECK(shows(numbers, term.g));
      CHECK(shows(numbers, term.tau_s));
      CHECK(shows(numbers, term.modulus_Pa));
    }
  }
}

TEST_CASE("the page says that frame and load cell change shares and times", "[io][report]") {
  const std::string& page = full_page();
  CHECK(page.find("does not change <i>g</i>") == std::string::npos);
  CHECK(page.find("Frame and load cell change <i>g</i> and <i>τ</i> as well") != std::string::npos);
}

TEST_CASE("every shown number agrees with its full value to the digits shown", "[io][report]") {
  // moduli stand in MPa or kPa, shares in per cent, all else in SI
  int n_checked = 0;
  for (const ShownNumber& number : numbers_of(full_page())) {
    if (has(number.shown, "×") || has(number.shown, "−")) continue;
    const double shown = std::stod(number.shown);
    const double factor = std::round(std::log10(number.value_SI / shown));
    CAPTURE(number.shown, number.value_SI);
    CHECK((factor == 0.0 || factor == 3.0 || factor == 6.0 || factor == -2.0));
    // two digits of a half-width of a few per cent at the least: within 5 %
    CHECK(shown * std::pow(10.0, factor) == Approx(number.value_SI).epsilon(0.05));
    ++n_checked;
  }
  CHECK(n_checked > 60);
}

TEST_CASE("truth, estimate, interval and verdict are in one row", "[io][report]") {
  const std::string words = words_of(full_page());
  CHECK(has(words, "Truth Estimate 95 % interval Difference Truth inside?"));
  ReportInput input = synthetic_report();
  for (SpecimenReport& specimen : input.specimens) specimen.truth.reset();
  const std::string without = words_of(html_of(input));
  CHECK_FALSE(has(without, "Truth"));
  CHECK_FALSE(has(without, "emulated rig whose truth"));
}

TEST_CASE("a truth far outside is counted as missed", "[io][report]") {
  ReportInput input = synthetic_report();
  input.specimens.resize(1);
  FitResult& fit = *input.specimens[0].fit;
  MaterialTerm& term = input.specimens[0].truth->material.terms[0];
  term.g = term.k = 3.0 * fit.terms[0].g;
  const std::string words = words_of(html_of(input));
  CAPTURE(words.substr(words.find("whose truth"), 200));
  CHECK(has(words, " of 6 intervals contain it"));
  CHECK(has(html_of(input), "<span class=\"no\">no</span>"));
}

TEST_CASE("names and texts of any spelling stay text", "[io][report]") {
  const std::string nasty = "<script>alert(1)</script> & \"x\" 'y' </pre></details>";
  ReportInput input = synthetic_report();
  input.specimens.resize(1);
  input.title = input.introduction = input.command = nasty;
  SpecimenReport& specimen = input.specimens[0];
  specimen.specimen.id = specimen.specimen.material = nasty;
  specimen.run->rig.name = specimen.run->command = specimen.run->status = nasty;
  specimen.run->events[0].value = nasty;
  specimen.fit->flags = {{nasty, 1, nasty}};
  specimen.fit->two_point->bias = nasty;
  specimen.pillar->setup = nasty;
  specimen.notes = {nasty};
  specimen.files = {{nasty, nasty}};
  specimen.cards[0] = {nasty, nasty, nasty, nasty, ""};
  const std::string html = html_of(input);
  CHECK(first_fault(html) == "");
  CHECK_FALSE(has(html, "<script"));
  CHECK(has(text_of(html), nasty));
}

TEST_CASE("the page names the term of a flag once", "[io][report]") {
  ReportInput input = synthetic_report();
  input.specimens.resize(1);
  input.specimens[0].fit->flags = {{"tau-below-ramp", 1, "term 1: relaxation time 0.1 s"}};
  const std::string text = text_of(html_of(input));
  CHECK(has(text, "term 1: relaxation time 0.1 s"));
  CHECK_FALSE(has(text, "term 1: term 1:"));
}

TEST_CASE("NaN and infinity are never printed", "[io][report]") {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  ReportInput input = synthetic_report();
  input.specimens.resize(2);
  FitResult& fit = *input.specimens[0].fit;
  fit.E0_interval_95 = {kNaN, kNaN};
  fit.terms[0].tau_s_95 = {0.05, std::numeric_limits<double>::infinity()};
  fit.terms[1].g_95 = {kNaN, kNaN};
  fit.covariance.setConstant(kNaN);
  fit.orders[0].cv = fit.orders[0].aicc = fit.orders[1].bic = kNaN;
  fit.curves.measured[5] = kNaN;
  fit.curves.sigma[7] = 0.0;
  fit.systematic_relative = kNaN;
  fit.noise.inflation = kNaN;
  fit.two_point->se_Pa = kNaN;
  input.specimens[0].pillar->creep.largest_relative_error = kNaN;
  input.specimens[0].pillar->creep.solver[3] = kNaN;
  input.specimens[1].fit->E_inf_Pa = kNaN;
  input.specimens[1].run->load_samples[10].counts = kNaN;
  const std::string html = html_of(input);
  CHECK(first_fault(html) == "");
  const std::string words = words_of(html);
  static const std::regex bad("[^A-Za-z](nan|NaN|NAN|inf|Inf|INF)[^A-Za-z]");
  std::smatch found;
  const bool has_bad = std::regex_search(words, found, bad);
  CAPTURE(found.str());
  CHECK_FALSE(has_bad);
  CHECK_FALSE(has(html, "value=\"nan"));
  CHECK(has(words, "unbounded"));
}

TEST_CASE("missing parts are omitted with their headings", "[io][report]") {
  const std::string html = html_of(bare_report());
  CHECK(first_fault(html) == "");
  const std::string words = words_of(html);
  CHECK(has(words, "Summary"));
  CHECK(has(words, "PDMS 1:10"));
  for (const char* absent : {"Truth and estimate", "in a pillar", "Material cards", "Two-point",
                             "Ratio", "Orders tried", "What the data could not determine"}) {
    CAPTURE(absent);
    CHECK_FALSE(has(words, absent));
  }
}

TEST_CASE("each optional part can be missing by itself", "[io][report]") {
  const int part = GENERATE(range(0, 8));
  ReportInput input = synthetic_report();
  input.specimens.resize(1);
  SpecimenReport& specimen = input.specimens[0];
  if (part == 0) specimen.run.reset();
  if (part == 1) specimen.fit.reset();
  if (part == 2) specimen.material.reset();
  if (part == 3) specimen.fit->curves = {};
  if (part == 4) specimen.fit->terms.clear();
  if (part == 5) specimen.run->load_samples.clear();
  if (part == 6) specimen.pillar->creep = {};
  if (part == 7) specimen.fit->contact_position_m.reset();
  CAPTURE(part);
  CHECK(first_fault(html_of(input)) == "");
}

TEST_CASE("the page calls stiffnesses stiffnesses and claims no modulus", "[io][report]") {
  ReportInput input = synthetic_report();
  input.specimens.resize(1);
  input.specimens[0].fit->is_stiffness = true;
  input.specimens[0].material.reset();
  const std::string words = words_of(html_of(input));
  CHECK(has(words, "no modulus is claimed"));
  CHECK(has(words, "N/m"));
  CHECK_FALSE(has(words, "Young"));
  ReportInput mixed = synthetic_report();
  mixed.specimens[1].fit->is_stiffness = true;
  CHECK_THROWS_WITH(html_of(mixed), Catch::Contains("cannot share a page"));
}

TEST_CASE("a report on nothing is refused", "[io][report]") {
  CHECK_THROWS_WITH(html_of({}), Catch::Contains("no specimen"));
  ReportInput empty;
  empty.specimens.resize(1);
  CHECK_THROWS_WITH(html_of(empty), Catch::Contains("neither a fit nor a material"));
}

TEST_CASE("the same input gives the same bytes", "[io][report]") {
  CHECK(html_of(synthetic_report()) == full_page());
}

TEST_CASE("tables have headers for rows and columns, figures a description", "[io][report]") {
  const std::string& html = full_page();
  CHECK(has(html, "<th scope=\"col\""));
  CHECK(has(html, "<th scope=\"row\""));
  CHECK(has(html, "<html lang=\"en\">"));
  std::size_t n_svg = 0, n_described = 0, n_captions = 0;
  for (std::size_t at = html.find("<svg"); at != std::string::npos;
       at = html.find("<svg", at + 1)) {
    ++n_svg;
  }
  for (std::size_t at = html.find("role=\"img\" aria-labelledby"); at != std::string::npos;
       at = html.find("role=\"img\" aria-labelledby", at + 1)) {
    ++n_described;
  }
  for (std::size_t at = html.find("<figcaption>"); at != std::string::npos;
       at = html.find("<figcaption>", at + 1)) {
    ++n_captions;
  }
  CHECK(n_svg == 10);  // relaxation, ratio, spectrum, pillar, and run and fit of three specimens
  CHECK(n_described == n_svg);
  CHECK(n_captions == n_svg);
}

TEST_CASE("the page reports an interrupted run and the reason of a refused card", "[io][report]") {
  ReportInput input = synthetic_report();
  input.specimens.resize(1);
  input.specimens[0].run->status = "interrupted";
  input.specimens[0].cards = {{"febio", "SI", "x.feb", "", "nu = 0.5 has no finite bulk modulus"}};
  const std::string words = words_of(html_of(input));
  CHECK(has(words, "This run was interrupted"));
  CHECK(has(words, "was not written: nu = 0.5 has no finite bulk modulus"));
}
