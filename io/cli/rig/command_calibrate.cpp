#include "io/cli/rig/command_calibrate.h"

#include "io/basics/timestamp.h"
#include "io/basics/units.h"
#include "io/cli/rig/calibrate_words.h"
#include "io/cli/words/command_line.h"

#include <fmt/format.h>

#include <filesystem>
#include <ostream>

namespace po = boost::program_options;

namespace viscard {
namespace {

CommandSyntax calibrate_syntax() {
  CommandSyntax syntax;
  syntax.usage = "viscard calibrate [--compliance] --rig FILE|--data FILE --out FILE [OPTIONS]";
  syntax.description =
      "Finds the load cell's gain with dead weights put on and taken off again, or with "
      "--compliance\n"
      "the frame's stiffness on a rigid block, each with an uncertainty budget; the record goes to "
      "a\n"
      "file that the rig file names: [calibration] file = \"cell.toml\", [frame] file = "
      "\"frame.toml\".\n"
      "--data takes a table instead of the rig: mass_kg or force_N with volts_V, or position_m "
      "with\n"
      "force_N.";
  syntax.example = "viscard calibrate --emulate --speed 20 --out cell.toml";
  auto add = syntax.options.add_options();
  add("rig", po::value<std::string>(), "rig.toml: port and driver of the load cell");
  add("data", po::value<std::string>(), "table of weights and readings, in the order taken");
  add("compliance", "measure the frame on a rigid block");
  add("weights", po::value<std::string>(), "masses to put on, \"20 g, 50 g, 100 g, 200 g\"");
  add("series", po::value<int>()->default_value(3), "number of times to go up and down");
  add("mass-u", po::value<double>()->default_value(1e-4),
      "relative standard uncertainty of the masses");
  add("gravity", po::value<std::string>(), "gravity at this place, \"9.8067 m/s2\"");
  add("capacity", po::value<std::string>(), "rated load of the cell, if there is no rig file");
  add("settle", po::value<std::string>()->default_value("1 s"), "wait after putting on a weight");
  add("seconds", po::value<std::string>()->default_value("3 s"), "time of each mean reading");
  add("to", po::value<std::string>(), "highest force on the block (70 % of the soft limit)");
  add("steps", po::value<int>()->default_value(6), "number of steps of force on the block");
  add("id", po::value<std::string>(), "name of the record");
  add("valid-until", po::value<std::string>(), "last day of validity (a year from today)");
  add("out", po::value<std::string>(), "record to write (*.toml)");
  add("emulate", "calibrate an emulated rig");
  add("truth", po::value<std::string>(), "truth.toml: what the emulated cell is like");
  add("speed", po::value<double>()->default_value(1.0), "emulated clock over wall clock");
  add("yes", "do not wait for Enter before the block is pressed");
  add("force", "replace an existing record");
  return syntax;
}

double quantity(const po::variables_map& values, const char* name, const char* unit) {
  try {
    return si_from_text(values[name].as<std::string>(), unit);
  } catch (const std::invalid_argument& error) {
    throw UsageError(std::string("--") + name + ": " + error.what());
  }
}

std::vector<double> masses_from(const std::string& text) {
  std::vector<double> masses_kg;
  std::size_t from = 0;
  while (from <= text.size()) {
    const std::size_t comma = std::min(text.find(',', from), text.size());
    try {
      masses_kg.push_back(si_from_text(text.substr(from, comma - from), "kg"));
    } catch (const std::invalid_argument& error) {
      throw UsageError(std::string("--weights: ") + error.what());
    }
    if (!(masses_kg.back() >= 0.0)) throw UsageError("--weights: a mass is negative");
    from = comma + 1;
  }
  return masses_kg;
}

CalibrateWords calibrate_words_from(const po::variables_map& values) {
  const auto text = [&](const char* name) {
    return values.count(name) > 0 ? std::optional(values[name].as<std::string>()) : std::nullopt;
  };
  CalibrateWords words;
  words.rig_file = text("rig");
  words.data_file = text("data");
  words.truth_file = text("truth");
  words.out_file = text("out").value_or("");
  words.is_compliance = values.count("compliance") > 0;
  words.is_emulated = values.count("emulate") > 0;
  words.asks_nobody = values.count("yes") > 0;
  words.overwrite = values.count("force") > 0;
  words.as_json = values.count("json") > 0;
  words.id = text("id").value_or((words.is_compliance ? "frame " : "load cell ") + today());
  words.valid_until = text("valid-until").value_or("");
  if (const auto weights = text("weights")) words.masses_kg = masses_from(*weights);
  words.series = values["series"].as<int>();
  words.steps = values["steps"].as<int>();
  words.mass_relative_u = values["mass-u"].as<double>();
  words.is_gravity_given = values.count("gravity") > 0;
  if (words.is_gravity_given) words.gravity_m_s2 = quantity(values, "gravity", "m/s2");
  if (values.count("capacity") > 0) words.capacity_N = quantity(values, "capacity", "N");
  if (values.count("to") > 0) words.force_N = quantity(values, "to", "N");
  words.settle_s = quantity(values, "settle", "s");
  words.mean_s = quantity(values, "seconds", "s");
  words.speed = values["speed"].as<double>();
  return words;
}

void check_valid_until(const std::string& day) {
  const bool is_day = day.size() == 10 && day[4] == '-' && day[7] == '-' &&
                      day.find_first_not_of("0123456789-") == std::string::npos;
  if (!day.empty() && !is_day) {
    throw UsageError("--valid-until '" + day + "' is not a day such as 2027-11-21");
  }
  if (!day.empty() && day < today()) {
    throw UsageError("--valid-until " + day +
                     " is in the past; the record would be refused at once");
  }
}

void check_words(const CalibrateWords& words) {
  const int n_sources = (words.is_emulated ? 1 : 0) + (words.data_file ? 1 : 0) +
                        (words.rig_file && !words.is_emulated && !words.data_file ? 1 : 0);
  if (n_sources != 1) {
    throw UsageError(
        "calibrate needs one of --rig FILE (weights on the rig), --data FILE (a table) or "
        "--emulate");
  }
  if (words.out_file.empty()) throw UsageError("calibrate needs --out FILE, the record to write");
  if (words.series < 1 || words.series > 100) throw UsageError("--series is outside 1 to 100");
  if (words.steps < 3 || words.steps > 100) throw UsageError("--steps is outside 3 to 100");
  if (!(words.mean_s > 0.0) || !(words.settle_s >= 0.0)) {
    throw UsageError("--seconds must be positive and --settle not negative");
  }
  if (!(words.gravity_m_s2 > 9.7) || !(words.gravity_m_s2 < 9.9)) {
    throw UsageError(
        fmt::format("--gravity {} m/s2 does not occur on Earth, where it lies between "
                    "9.76 and 9.84 m/s2",
                    words.gravity_m_s2));
  }
  if (!(words.mass_relative_u >= 0.0) || !(words.mass_relative_u < 0.1)) {
    throw UsageError("--mass-u is outside 0 to 0.1");
  }
  if (!words.is_emulated && (words.truth_file || words.speed != 1.0)) {
    throw UsageError("--truth and --speed are for an emulated rig: add --emulate");
  }
  if (!(words.speed > 0.0) || words.speed > 500.0) {
    throw UsageError(fmt::format("--speed is {}; it must be above 0 and at most 500", words.speed));
  }
  check_valid_until(words.valid_until);
  if (!words.overwrite && std::filesystem::exists(words.out_file)) {
    throw std::runtime_error(
        "'" + words.out_file +
        "' exists already. Choose another --out, or add --force to replace it");
  }
}

}  // namespace

int run_calibrate(const std::vector<std::string>& words, Streams& streams) {
  CommandSyntax syntax = calibrate_syntax();
  const auto values = parse_words(syntax, words, streams);
  if (!values) return kDone;
  const CalibrateWords asked = calibrate_words_from(*values);
  check_words(asked);
  return asked.is_compliance ? calibrate_frame(asked, streams)
                             : calibrate_load_cell(asked, streams);
}

}  // namespace viscard
