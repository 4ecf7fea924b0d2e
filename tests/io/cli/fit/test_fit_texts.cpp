// Wording of what `viscard fit` prints about odd tables.
#include "fit/intervals/left_out.h"
#include "fit/intervals/slow_noise.h"
#include "io/flow/words/fit_text.h"
#include "tests/io/cli/fit/table_folder.h"
#include "tests/support/run_command.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <sstream>

using namespace viscard;
using namespace viscard::test;
using Catch::Contains;

TEST_CASE("rows left out as spikes are counted in the singular and the plural", "[cli]") {
  FitResult one, two;
  add_left_out(one, left_out::kSpike, 1);
  add_left_out(two, left_out::kSpike, 2);
  CHECK_THAT(left_out_text(one), Contains("1 row that is a spike"));
  CHECK_THAT(left_out_text(two), Contains("2 rows that are spikes"));
}

TEST_CASE("a table without numbers or with zeros alone is refused with the reason", "[cli]") {
  const TableFolder folder;
  const CommandOutcome bare = run_command({"fit", folder.write("a.csv", "time_s,modulus_Pa\n")});
  CHECK(bare.status == kFailed);
  CHECK_THAT(bare.err, Contains("has no line with a number in its only line; expected"));
  std::ostringstream zeros;
  zeros << "time_s,modulus_Pa\n";
  for (int i = 1; i <= 60; ++i) zeros << 0.1 * i << ",0\n";
  const CommandOutcome zero = run_command({"fit", folder.write("z.csv", zeros.str())});
  CHECK(zero.status == kFailed);
  CHECK_THAT(zero.err, Contains("every value of the fitted column is zero") &&
                           Contains("--column modulus_Pa=NAME") && !Contains("flip"));
}

TEST_CASE("a workbook is not called the file of a maker", "[cli]") {
  FittedFile fitted;
  std::ostringstream of_book, of_maker;
  fitted.maker = "Excel workbook, sheet 'Data' of 2";
  print_fit(fitted, of_book);
  CHECK_THAT(of_book.str(), Contains("\n  Excel workbook, sheet 'Data' of 2\n"));
  fitted.maker = "TRIOS";
  print_fit(fitted, of_maker);
  CHECK_THAT(of_maker.str(), Contains("\n  file of TRIOS\n"));
}

TEST_CASE("columns without a unit are read in SI, and a flag says so", "[cli]") {
  const TableFolder folder;
  const auto flag_of = [&](const std::string& header, const std::vector<std::string>& more = {}) {
    const std::string said = header + (more.empty() ? "" : more.back());
    const bool is_creep = said.find("compliance") != std::string::npos;
    const double unit = said.find("MPa") != std::string::npos ? 1.0 : 1e6;  // of what is written
    std::ostringstream rows;
    for (const double t : {0.01, 0.03, 0.1, 0.3, 1.0, 3.0, 10.0}) {
      const double modulus_MPa = 1.68 + 0.12 / (1.0 + t);
      rows << t << "," << (is_creep ? 1e-6 / modulus_MPa : modulus_MPa * unit) << "\n";
    }
    std::vector<std::string> words{"fit", folder.write("t.csv", header + "\n" + rows.str()),
                                   "--json"};
    words.insert(words.end(), more.begin(), more.end());
    const auto json = nlohmann::json::parse(run_command(words).out);
    for (const auto& flag : json.at("flags")) {
      if (flag["name"] == "unit-assumed") return flag["text"].get<std::string>();
    }
    return std::string();
  };
  CHECK(flag_of("time,modulus") ==
        "the columns 'time', 'modulus' state no unit and were read in s, Pa; write the unit in the "
        "header, as in 'modulus (kPa)'");
  CHECK(flag_of("time (s),modulus") ==
        "the column 'modulus' states no unit and was read in Pa; write the unit in the header, as "
        "in 'modulus (kPa)'");
  const std::string creep = flag_of("time (s),compliance", {"--terms", "0"});
  CHECK_THAT(creep, Contains("'compliance (1/MPa)'"));
  CHECK(flag_of("time_s,modulus_Pa").empty());
  CHECK(flag_of("time_s,modulus_MPa").empty());
  CHECK(flag_of("t [s],E [MPa]").empty());
  CHECK(flag_of("time_s,modulus", {"--column", "modulus_Pa=modulus [MPa]"}).empty());
}

TEST_CASE("a memory of the noise beyond the record is not printed in percent", "[cli]") {
  CHECK(memory_text(0.12, 8.1) ==
        "the noise of the record has a memory of 12 % of it, or 8.1 independent values");
  CHECK(memory_text(19.0, 2.7e-4) ==
        "the noise of the record has a memory longer than the record, so that not even one value "
        "is independent");
}

TEST_CASE("what several terms share is one line that names the others", "[cli]") {
  std::ostringstream out;
  print_flags({{"modulus-may-be-zero", 1, "term 1: the interval contains zero"},
               {"slow-noise", 0, "the noise is slow"},
               {"modulus-may-be-zero", 4, "term 4: the interval contains zero"},
               {"modulus-may-be-zero", 7, "term 7: the interval contains zero"},
               {"slow-noise", 0, "the noise is slow"}},
              out);
  CHECK(out.str() ==
        "  ! modulus-may-be-zero: term 1: the interval contains zero; likewise term 4, 7\n"
        "  ! slow-noise: the noise is slow\n");
}

TEST_CASE("a strain and a phase without a unit are flagged, where they are used", "[cli]") {
  const TableFolder folder;
  std::ostringstream strained, own, phase, moduli;
  strained << "time (s),stress (kPa),strain\n";
  own << "time_s,stress_Pa,strain\n";
  phase << "Frequency (Hz),|E*| (MPa),phase\n";
  moduli << "Frequency (Hz),E' (MPa),E'' (MPa),phase\n";
  for (int i = 1; i <= 60; ++i) {
    const double t = 0.1 * i, stress_Pa = 5e4 + 2e4 * std::exp(-t) + 20.0 * ((7 * i) % 11);
    strained << t << "," << 1e-3 * stress_Pa << ",0.05\n";
    own << t << "," << stress_Pa << ",0.05\n";
    const double x = std::pow(10.0, -2.0 + 0.05 * i), loss = 0.2 * x / (1.0 + x * x);
    const double storage = 1.0 + 0.2 * x * x / (1.0 + x * x) + 1e-4 * ((7 * i) % 11);
    phase << x << "," << std::hypot(storage, loss) << "," << std::atan2(loss, storage) << "\n";
    moduli << x << "," << storage << "," << loss << "," << (i % 3 == 0 ? "" : "1") << "\n";
  }
  const auto fitted = [&](const char* name, const std::ostringstream& text) {
    return run_command({"fit", folder.write(name, text.str())}).out;
  };
  CHECK_THAT(fitted("a.csv", strained), Contains("unit-assumed: 'strain' states no unit"));
  CHECK_THAT(fitted("b.csv", own), !Contains("unit-assumed"));
  CHECK_THAT(fitted("c.csv", phase), Contains("unit-assumed: the column 'phase' states no unit"));
  const std::string all =
      fitted("d.csv", moduli);  // the phase is not used, and its gaps leave no row out
  CHECK_THAT(all, !Contains("unit-assumed") && Contains("60 samples"));
}
