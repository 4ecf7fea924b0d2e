// What the page shows of curves: sweeps, shift factors, residuals; dark mode and narrow screens.
#include "io/report/report.h"
#include "tests/io/plots/markup.h"
#include "tests/io/report/synthetic_report.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace viscard;
using namespace viscard::test;

namespace {

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::string page_of(const ReportInput& input) {
  return render_report(input).html;
}

// A frequency sweep at several temperatures, as a table gives it: no run, no pillar.
ReportInput sweep_report() {
  ReportInput input;
  input.specimens.resize(1);
  SpecimenReport& specimen = input.specimens[0];
  specimen.specimen.id = "melt";
  FitResult fit;
  fit.kind = FitKind::kDma;
  fit.E0_Pa = 2e6;
  fit.E_inf_Pa = 1e6;
  fit.terms = {{1e6, 0.5, 1.0}};
  fit.noise.sigma = 0.0125;
  fit.n_samples = 40;
  fit.curves.unit = "Pa";
  for (int i = 0; i < 40; ++i) {
    const double x = std::pow(10.0, -2.0 + 0.1 * i);
    const double storage_Pa = 1e6 + 1e6 * x * x / (1.0 + x * x), loss_Pa = 1e6 * x / (1.0 + x * x);
    fit.curves.add(x, 1.01 * storage_Pa, storage_Pa, 0.0125 * storage_Pa);
    fit.curves.add_loss(0.99 * loss_Pa, loss_Pa, 0.0125 * loss_Pa);
  }
  specimen.fit = fit;
  specimen.shift = ShiftReport{20.0,
                               {0.0, 20.0, 40.0},
                               {2.0, 0.0, -1.5},
                               {0.05, 0.0, 0.05},
                               {2.1, 0.0, -1.4},
                               {0.1, 0.0, 0.1},
                               "WLF law",
                               "WLF, C1 = 8, C2 = 100 K",
                               {0.0, 20.0, 40.0},
                               {2.0, 0.0, -1.5}};
  return input;
}

}  // namespace

TEST_CASE("a sweep shows both moduli, the loss factor, and the shift factors with their law",
          "[io][report]") {
  const std::string html = page_of(sweep_report());
  CHECK(first_fault(html) == "");
  for (const char* part : {"storage modulus E′", "loss modulus E″", "tan δ", "Shift factors",
                           "taken: WLF law", "free, 95 % interval", "WLF, C1 = 8, C2 = 100 K"}) {
    CAPTURE(part);
    CHECK(has(html, part));
  }
  // The noise of a sweep is relative; it was shown as 0.0125 Pa.
  CHECK(has(text_of(html), "Noise: 1.25 % of each modulus"));
  CHECK_FALSE(has(text_of(html), "0.0125 Pa"));
}

TEST_CASE("residuals are shown over log time and in time order", "[io][report]") {
  const std::string html = page_of(synthetic_report());
  CHECK(has(html, "time (s), in time order"));
  CHECK(has(text_of(html), "over the logarithm of time and in time order"));
}

TEST_CASE("the page has a dark mode and keeps captions within a narrow screen", "[io][report]") {
  const std::string html = page_of(synthetic_report());
  CHECK(has(html, "content=\"light dark\""));
  CHECK(has(html, "prefers-color-scheme: dark"));
  CHECK(has(html, "caption { max-width: calc(100vw - 32px); }"));
}

TEST_CASE("curves of specimens differ by dashes and symbols, not by colour alone", "[io][report]") {
  const std::string html = page_of(synthetic_report());
  CHECK(has(html, "stroke-dasharray"));
  // Square and triangle beside the round dots of the first specimen.
  CHECK(has(html, "-gpPt6'"));
  CHECK(has(html, "-gpPt8'"));
}
