#include "io/plots/plot_svg.h"
#include "io/report/report_figures.h"
#include "io/report/report_numbers.h"
#include "io/report/report_sections.h"

#include <fmt/format.h>

#include <algorithm>

namespace viscard {
namespace {

// One test as a fit of its own, with the series of all.
FitResult part_of(const FitResult& fit, const FittedTest& test) {
  FitResult part;
  part.kind = test.kind;
  part.is_stiffness = test.is_stiffness;
  part.terms = fit.terms;
  part.n_samples = test.n_samples;
  part.noise = test.noise;
  part.curves = test.curves;
  return part;
}

std::string percent_html(double share) {
  return fmt::format("{:+.2g}", 100.0 * share);
}

HtmlTable tests_table(const FitResult& fit) {
  HtmlTable table({{"Test", false},
                   {"Samples"},
                   {"Noise"},
                   {"Terms alone"},
                   {"Scale"},
                   {"Difference (%)"},
                   {"Chance"}});
  for (const FittedTest& test : fit.tests) {
    const bool is_relative = test.kind == FitKind::kDma;
    const ShownUnit unit = shown_unit(test.curves.unit, {test.noise.sigma});
    const std::string noise = is_relative ? fmt::format("{:.2g} %", 100.0 * test.noise.sigma)
                                          : fmt::format("{:.2g} {}", test.noise.sigma * unit.per_si,
                                                        escaped_markup(unit.text));
    const Interval& range = test.difference_95;
    const std::string difference =
        test.difference_95.high > test.difference_95.low
            ? fmt::format("{} [{}, {}]", percent_html(test.difference), percent_html(range.low),
                          percent_html(range.high))
            : "none to compare";
    table.add_row({escaped_markup(test.name), fmt::format("{}", test.n_samples), noise,
                   fmt::format("{}", test.own_terms),
                   test.has_scale ? fmt::format("{:.4g} [{:.4g}, {:.4g}]", test.scale,
                                                test.scale_95.low, test.scale_95.high)
                                  : "1",
                   difference, test.freedom > 0 ? fmt::format("{:.2g}", test.p_value) : "–"});
  }
  return table;
}

}  // namespace

void add_tests(Page& page, const FitResult& fit) {
  for (const FittedTest& test : fit.tests) {
    const FitResult part = part_of(fit, test);
    const auto plot = fit_plot(part);
    std::string name = "fit_" + test.name;
    std::replace(name.begin(), name.end(), ' ', '_');
    if (!plot) continue;
    page.add_figure(*plot, name,
                    "<b>" + escaped_markup(test.name) + ".</b> " +
                        fit_caption(part, test.kind == FitKind::kDma));
  }
  if (fit.tests.empty()) return;
  page.add_table(
      tests_table(fit),
      "The tests that share the series. Noise: of one sample, by which the test counts. Scale: its "
      "values over those of the material, if its geometry is unknown or uncertain. Difference: a "
      "factor by which it lies above what the other tests allow, with its 95 % interval. Chance: "
      "the probability of so large a difference, in level or in course, between tests that agree.");
}

}  // namespace viscard
