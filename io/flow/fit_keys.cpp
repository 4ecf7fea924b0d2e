// The keys of fits.
#include "fit/intervals/fit_result_keys.h"
#include "io/basics/written_path.h"
#include "io/flow/command_error.h"
#include "io/flow/fit_file.h"

namespace viscard {
namespace {

void show_rows(ResultVisitor& v, const FittedFile& fitted) {
  const FitResult& fit = fitted.result;
  v("n_spikes", fit.n_spikes, "samples taken out as spikes");
  v.when(!fitted.chosen.empty(),
         [&] { v("chosen", fitted.chosen, "which part of the record was fitted"); });
  v("n_rows", fit.n_samples + fit.n_left_out, "rows of the record");
  v("n_left_out", fit.n_left_out, "rows that were not fitted");
  v.map("left_out", "rows that were not fitted, by reason", fit.left_out,
        [&](const LeftOutRows& left) { v(left.reason, left.count, "rows"); });
  v.when(fit.n_contacts > 0,
         [&] { v("n_contacts", fit.n_contacts, "how often contact was made"); });
  v("n_before_test", fitted.n_before_test, "rows before the test");
}

void show_tests(ResultVisitor& v, const FittedFile& fitted) {
  const std::vector<FittedTest>& tests = fitted.result.tests;
  std::size_t k = 0;
  v.list("tests", "the tests of a joint answer", tests, [&](const FittedTest& test) {
    show_keys(v, test, k < fitted.tests.size() ? fitted.tests[k].path : "");
    ++k;
  });
}

// The kind of modulus that was measured, and its values beside Young's.
void show_measured(ResultVisitor& v, const FittedFile& fitted) {
  v.when(fitted.modulus.has_value(), [&] {
    const MeasuredModulus modulus = fitted.modulus.value_or(MeasuredModulus{});
    const ModulusKindText& text = text_of(modulus.kind);
    v.word("modulus_kind", text.word, {"tension", "shear", "plane-strain", "indentation", "bulk"},
           "what was measured; E0_Pa and all other moduli are Young's");
    v("modulus_kind_from", modulus.assumed_header.empty() ? modulus.from : "assumed",
      "what states it: a header, a format or an option");
    v("nu", modulus.nu, "Poisson ratio of the conversion");
    v.when(modulus.nu_95.has_value(), [&] {
      v("nu_interval_95", modulus.nu_95.value_or(Interval{}),
        "95 % interval, if it was fitted from tests in shear and in tension; [low, high]");
    });
    v("nu_stated", modulus.is_nu_stated, "whether it was given, and not assumed");
    const FitResult& fit = fitted.result;
    const double share = 1.0 / modulus.young_factor();
    const auto of = [&](const Interval& range) {
      return Interval{range.low * share, range.high * share};
    };
    v.when(modulus.kind == ModulusKind::kShear, [&] {
      v("G0_Pa", fit.E0_Pa * share, "instantaneous shear modulus");
      v("G_inf_Pa", fit.E_inf_Pa * share, "equilibrium shear modulus");
      v("G0_interval_95", of(fit.E0_interval_95), "95 % interval of G0, [low, high]");
      v("G_inf_interval_95", of(fit.E_inf_interval_95), "95 % interval of G_inf, [low, high]");
    });
  });
}

// What only some fits have.
void show_wanted(ResultVisitor& v, const FittedFile& fitted) {
  const FitResult& fit = fitted.result;
  v.when(fit.n_bootstrap > 0, [&] { v("n_bootstrap", fit.n_bootstrap, "resamples"); });
  v.when(!fit.profiles.empty(),
         [&] { v("profiles", fit.profiles, "profile likelihoods, with --profiles"); });
  v("spectrum", fit.spectrum, "the continuous relaxation spectrum, with --spectrum");
  v("shift", fitted.master, "the master curve of several temperatures");
  v("fractional_zener", fitted.fractional, "the fractional Zener model beside the series");
  v.when(!fit.laws.empty(),
         [&] { v("laws", fit.laws, "laws of few parameters, with --diagnose or --model"); });
  v.when(!fitted.model.empty(),
         [&] { v("model", fitted.model, "the law that answers, with --model"); });
  v.when(!fit.tests.empty(), [&] { show_tests(v, fitted); });
}

CommandError reason_of(const std::exception_ptr& thrown) {
  if (!thrown) return {};
  try {
    std::rethrow_exception(thrown);
  } catch (const std::exception& error) {
    return command_error(error);
  }
}

}  // namespace

void show_keys(ResultVisitor& v, const FittedFile& fitted) {
  std::vector<TestFile> tests = fitted.tests;
  write_paths_of(tests);
  std::string files = tests.empty() ? written_path(fitted.path) : tests.front().path;
  for (std::size_t k = 1; k < tests.size(); ++k) files += " + " + tests[k].path;
  const FitResult& fit = fitted.result;
  const ModulusNames names = modulus_names(fit.is_stiffness, fitted.has_no_depth);
  v("file", files, "the table or capture");
  v.when(!fitted.maker.empty(),
         [&] { v("maker", fitted.maker, "maker of the machine that wrote the table"); });
  v.when(!fitted.notes.empty(),
         [&] { v("notes", fitted.notes, "how the record was read, where that was not plain"); });
  v.word("kind", name_of_kind(fit.kind), {"indentation", "relaxation", "creep", "dma", "several"},
         "kind of test");
  v("trustworthy", fit.is_trustworthy,
    "whether the result may be used; if not, flags state why and the exit status is 1");
  show_moduli(v, fit, names);
  show_measured(v, fitted);
  show_quality(v, fit);
  show_systematic(v, fit, names);
  v("temperature", fitted.temperature, "measured during the test");
  show_measured_ends(v, fit, names);
  show_lack_of_fit(v, fit, fitted.fitted_unit);
  show_rig(v, fit);
  show_wanted(v, fitted);
  show_rows(v, fitted);
  if (v.is_in_memory()) show_arrays(v, fit);
}

void show_keys(ResultVisitor& v, const FileOutcome& outcome) {
  if (outcome.fitted) return show_keys(v, *outcome.fitted);
  v("file", written_path(outcome.path), "the table or capture");
  v("error", reason_of(outcome.error),
    "why this file could not be fitted; the other keys are then missing");
}

}  // namespace viscard
