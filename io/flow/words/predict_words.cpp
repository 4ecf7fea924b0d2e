#include "io/flow/words/predict_words.h"

#include "io/basics/option_quantity.h"
#include "io/basics/option_use.h"
#include "io/basics/words.h"
#include "io/flow/fit_request.h"

#include <algorithm>
#include <stdexcept>

namespace viscard {
namespace {

std::optional<PredictedTest> predicted_test(const PredictWords::Text& word) {
  if (!word) return std::nullopt;
  const std::vector<std::string>& names = names_of_predicted_tests();
  const auto found = std::find(names.begin(), names.end(), *word);
  if (found != names.end()) return static_cast<PredictedTest>(found - names.begin());
  throw OptionError("--test " + *word + " is not known" + did_you_mean(*word, names) + " Use " +
                    listed(names));
}

PredictionRequest prediction_request(const PredictWords& words, bool is_sweep, Plausible judged) {
  // A quantity that has to be positive if it is given.
  const auto positive = [&](const PredictWords::Text& text, const char* name, const char* unit) {
    const auto value = option_quantity(std::string("--") + name, text, unit, judged);
    if (value && !(*value > 0.0)) {
      throw OptionError(std::string("--") + name + " must be positive, such as \"1 " + unit + "\"");
    }
    return value;
  };
  PredictionRequest request;
  request.strain = option_strain("--strain", words.strain, judged);
  request.stress_Pa = option_quantity("--stress", words.stress, quantities::kStress, judged);
  if (request.strain && request.stress_Pa) {
    throw OptionError("--strain and --stress exclude each other: one of them is the input");
  }
  request.ramp_s = positive(words.ramp, "ramp", "s").value_or(0.0);
  request.hold_s = positive(words.hold, "hold", "s");
  request.recovery_s = positive(words.recovery, "recovery", "s");
  request.period_s = positive(words.period, "period", "s").value_or(1.0);
  request.n_cycles = words.cycles.value_or(request.n_cycles);
  request.from = positive(words.from, "from", is_sweep ? "Hz" : "s");
  request.to = positive(words.to, "to", is_sweep ? "Hz" : "s");
  if (request.from && request.to && !(*request.to > *request.from)) {
    throw OptionError("--from " + *words.from + " --to " + *words.to +
                      ": the range must end after it begins; exchange them");
  }
  request.points = words.points.value_or(request.points);
  if (request.n_cycles < 1 || request.n_cycles > 10000) {
    throw OptionError("--cycles must lie between 1 and 10000");
  }
  if (request.points < 2 || request.points > 100000) {
    throw OptionError("--points must lie between 2 and 100000");
  }
  const double in_cycles = 2.0 * request.points * request.n_cycles;
  if (words.cycles && in_cycles > kMostCyclePoints) {
    throw OptionError("--cycles " + std::to_string(request.n_cycles) + " with " +
                      std::to_string(request.points) +
                      " points of each motion are above the limit of " +
                      std::to_string(kMostCyclePoints) + " points; give fewer with --points");
  }
  return request;
}

// Options that contradict the test, and those without an effect on it, as far as the test is known
// before its tables are read.
void check_known_test(const PredictFileRequest& request) {
  const bool is_history = !request.history.empty();
  if (!request.test && !is_history && !request.against.empty()) return;
  const PredictedTest test =
      request.test.value_or(is_history ? PredictedTest::kHistory : PredictedTest::kRelaxation);
  refuse_idle<OptionError>(uses_in(test, request));
}

// Options that contradict the test.
void check_test(const PredictFileRequest& request) {
  if (!request.test) return;
  const PredictedTest test = *request.test;
  const std::string& name = names_of_predicted_tests()[static_cast<std::size_t>(test)];
  const bool is_creep = test == PredictedTest::kCreep || test == PredictedTest::kRecovery;
  if (request.prediction.strain && is_creep) {
    throw OptionError("--strain does not belong to --test " + name +
                      ", which holds a stress; give --stress");
  }
  if (request.prediction.stress_Pa && test == PredictedTest::kRelaxation) {
    throw OptionError(
        "--stress does not belong to --test relaxation, which holds a strain; give "
        "--strain, or --test creep");
  }
  if (test == PredictedTest::kHistory && request.history.empty() && request.against.empty()) {
    throw OptionError("--test history needs --history TABLE");
  }
  if (test != PredictedTest::kHistory && !request.history.empty()) {
    throw OptionError("--history is a test of its own; omit --test " + name);
  }
}

}  // namespace

OptionList options_of(PredictWords& words) {
  OptionList list;
  list.group("The test");
  list.add("test", &words.test,
           "relaxation, creep, recovery, cycles, oscillation or history; by default the columns of "
           "--history or --against decide, or else relaxation")
      .among(names_of_predicted_tests());
  list.add("strain", &words.strain,
           "size of the strain, such as 0.01 or \"1 %\"; relaxation without it is E(t) after an "
           "ideal step, cycles have 0.01")
      .of("1");
  list.add("stress", &words.stress,
           "size of the stress, such as \"10 kPa\"; creep without it is J(t) after an ideal step, "
           "recovery has 1 kPa")
      .of("Pa");
  list.add("ramp", &words.ramp,
           "relaxation, creep, recovery: duration of loading and of unloading; default: a jump")
      .of("s");
  list.add("hold", &words.hold,
           "relaxation, creep, recovery: time under load, such as \"60 s\"; default: to the end of "
           "the window")
      .of("s");
  list.add("recovery", &words.recovery, "recovery: time after unloading; default: that of the hold")
      .of("s");
  list.add("period", &words.period, "cycles: of one cycle, up and down again")
      .of("s")
      .by_default("1 s");
  list.add("cycles", &words.cycles, "cycles: their number").by_default("5");
  list.add("from", &words.from,
           "relaxation, creep, recovery: first time of the curve; oscillation: lowest frequency; "
           "default: the window")
      .of("s");
  list.add("to", &words.to, "last time (or --hold), or highest frequency").of("s");
  list.add("points", &words.points, "of the curve, or of each motion; not of a history")
      .by_default("200");
  list.add("temperature", &words.temperature,
           "predict at this temperature, such as \"40 degC\", by the material's temperature "
           "shift")
      .of("degC");
  list.group("Tables");
  list.add("history", &words.history,
           "table with time_s and any strain or stress_Pa, linear between rows; with both columns, "
           "the strain is the input and the stress is compared")
      .read_from_file();
  list.add("driven-by", &words.driven_by, "the input of such a table, if it has both columns")
      .among({"strain", "stress"});
  list.add("against", &words.against,
           "table of measured values: rms, worst, and the share inside the band")
      .read_from_file();
  list.add("column", &words.column,
           "NAME=HEADER or NAME=2: the column of a quantity in these tables, as in viscard fit");
  list.add(
          "modulus-kind", &words.modulus_kind,
          "what their moduli, compliances or stresses are of, as in viscard fit; they are compared "
          "as Young's, by the Poisson ratio of the material")
      .among(modulus_kind_words());
  list.add("plausible", &words.plausible,
           "off: accept values that no test or material can have (a wrong unit, most often); the "
           "result states it")
      .among({"on", "off"})
      .by_default("on");
  list.add("unverified", &words.unverified, kUnverifiedHelp);
  list.add("time-zero", &words.time_zero, "time in the tables where t = 0").of("s").by_default("0");
  return list;
}

PredictFileRequest predict_request(const PredictWords& words, const std::string& material) {
  PredictFileRequest request;
  request.material = material;
  PredictWords copy = words;
  const OptionList list = options_of(copy);
  for (const Option& option : list.all()) {
    if (is_set(option)) request.given.push_back(option.name);
  }
  request.test = predicted_test(words.test);
  request.history = words.history.value_or("");
  request.against = words.against.value_or("");
  const std::string driver = words.driven_by.value_or("strain");
  if (driver != "strain" && driver != "stress") {
    throw OptionError("--driven-by " + driver + " is not known; use strain or stress");
  }
  request.is_driven_by_stress = driver == "stress";
  request.accepts_unverified = words.unverified;
  try {
    request.columns = column_map_from_words(words.column);
  } catch (const std::invalid_argument& error) {
    throw OptionError(error.what());
  }
  try {
    if (words.modulus_kind) request.modulus_kind = modulus_kind_from_word(*words.modulus_kind);
    request.plausible = plausible_from_word(words.plausible.value_or("on"), Plausible::kMeasured);
    request.time_zero_s =
        option_quantity("--time-zero", words.time_zero, "s", request.plausible).value_or(0.0);
    request.temperature_C =
        option_quantity("--temperature", words.temperature, "degC", request.plausible);
    request.prediction =
        prediction_request(words, request.test == PredictedTest::kOscillation, request.plausible);
  } catch (const std::invalid_argument& error) {
    throw OptionError(error.what());
  }
  check_test(request);
  check_known_test(request);
  return request;
}

}  // namespace viscard
