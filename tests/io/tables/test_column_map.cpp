#include "io/tables/column_map.h"
#include "io/tables/column_names.h"
#include "tests/support/error_text.h"

#include <catch2/catch.hpp>

#include <numbers>

namespace viscard {
namespace {

using test::contains;
using test::error_text;

// First value of a quantity, in SI, of a table with one row.
double first(const std::string& text, const std::string& name,
             const std::vector<std::string>& words = {}) {
  CsvTable table = csv_from_text(text, "t.csv");
  table.judged = Plausible::kOff;  // the numbers are chosen to be told apart
  return column_SI(table, name, column_map_from_words(words)).at(0);
}

std::string error_of(const std::string& text, const std::string& name,
                     const std::vector<std::string>& words = {}) {
  return error_text([&] { first(text, name, words); });
}

TEST_CASE("columns are found by name and unit", "[io][csv]") {
  CHECK(first("time_s,force_N\n2,3\n", "force_N") == 3.0);
  CHECK(first("t (ms);F [mN]\n2;3\n", "time_s") == 2.0 * 1e-3);
  CHECK(first("t (ms);F [mN]\n2;3\n", "force_N") == 3.0 * 1e-3);
  CHECK(first("Time (s);Load (gf)\n2;3\n", "force_N") == Approx(3e-3 * 9.80665).epsilon(1e-15));
  CHECK(first("t,E_relax\ns, MPa\n2,3\n", "modulus_Pa") == 3e6);
  CHECK(first("t,G(t)\n2,3\n", "modulus_Pa") == 3.0);
  CHECK(first("f,E_stor,E_loss,T\nHz,MPa,MPa,C\n1,2,3,-5\n", "storage_modulus_Pa") == 2e6);
  CHECK(first("f,E_stor,E_loss,T\nHz,MPa,MPa,C\n1,2,3,-5\n", "loss_modulus_Pa") == 3e6);
  // 1e-12: the offset of the kelvin scale costs the last digits.
  CHECK(first("f,E_stor,E_loss,T\nHz,MPa,MPa,C\n1,2,3,-5\n", "temperature_C") ==
        Approx(-5.0).margin(1e-12));
  CHECK(first("f,T\nHz,K\n1,296.15\n", "temperature_C") == Approx(23.0).margin(1e-12));
  CHECK(first("force_mN,depth_um\n2,3\n", "force_N") == 2.0 * 1e-3);
  CHECK(first("force_mN,depth_um\n2,3\n", "depth_m") == 3.0 * 1e-6);
  CHECK(first("strain (%),stress (kPa)\n2,3\n", "strain") == 2.0 * 1e-2);
  CHECK(first("t,J(t)\ns,1/MPa\n2,3\n", "compliance_1_Pa") == Approx(3e-6).epsilon(1e-15));
  CHECK(first("G',G''\n2,3\n", "loss_modulus_Pa") == 3.0);
}

TEST_CASE("columns of a sweep and of a creep are found as people write them", "[io][csv]") {
  const double per_Hz = 2.0 * std::numbers::pi;
  for (const char* header : {"ω in rad/s", "angular_frequency_1_s", "Ang. frequency (rad/s)",
                             "omega", "Ang. freq. (rad/s)", "omega_1_s"}) {
    CAPTURE(header);
    CHECK(first(std::string(header) + ",Gp,Gpp\n3,1,2\n", "frequency_Hz") ==
          Approx(3.0 / per_Hz).epsilon(1e-15));
  }
  CHECK(first("omega,Gp,Gpp\n3,1,2\n", "loss_modulus_Pa") == 2.0);
  CHECK(first("omega,G prime,G double prime\n3,1,2\n", "storage_modulus_Pa") == 1.0);
  CHECK(first("Zeit in s,Kraft in mN\n3,1\n", "force_N") == 1e-3);
  CHECK(first("time_s,compliance_1_per_MPa\n3,1\n", "compliance_1_Pa") ==
        Approx(1e-6).epsilon(1e-15));
  CHECK(first("time_s,compliance_per_Pa\n3,1\n", "compliance_1_Pa") == 1.0);
}

TEST_CASE("columns are found by headers in German, French and Chinese", "[io][csv]") {
  CHECK(first("Prüfzeit;Standardkraft;Standardweg\ns;mN;µm\n1;2;3\n", "force_N") == 2.0 * 1e-3);
  CHECK(first("Prüfzeit;Standardkraft;Standardweg\ns;mN;µm\n1;2;3\n", "depth_m") == 3.0 * 1e-6);
  CHECK(first("Zeit (min),Spannung (kPa),Dehnung (%)\n1,2,3\n", "time_s") == 60.0);
  CHECK(first("Zeit (min),Spannung (kPa),Dehnung (%)\n1,2,3\n", "stress_Pa") == 2000.0);
  CHECK(first("Kraft (N),Spannung (V)\n1,2\n", "volts_V") == 2.0);
  CHECK(first("Kreisfrequenz (rad/s),Speichermodul (Pa)\n3,1\n", "frequency_Hz") ==
        Approx(3.0 / (2.0 * std::numbers::pi)).epsilon(1e-15));
  CHECK(first("Temps (s),Déplacement (mm),Contrainte (MPa)\n1,2,3\n", "depth_m") == 2.0 * 1e-3);
  CHECK(first("Fréquence (Hz),Module de perte (kPa)\n1,2\n", "loss_modulus_Pa") == 2000.0);
  CHECK(first("时间 (s),位移 (mm),载荷 (N)\n1,2,3\n", "force_N") == 3.0);
  CHECK(first("试验时间（s）,位移（mm）,试验力（kN）\n1,2,3\n", "force_N") == 3000.0);
  CHECK(first("角频率 (rad/s),储能模量 (MPa),损耗模量 (MPa)\n1,2,3\n", "loss_modulus_Pa") == 3e6);
}

TEST_CASE("words of two meanings name no column without a unit of one", "[io][csv]") {
  // tau is a relaxation time or a shear stress, charge and tension are forces in one language only.
  const CsvTable table = csv_from_text("tau,charge,tension\n1,2,3\n", "t.csv");
  for (const std::string& name : column_names()) CHECK_FALSE(find_column(table, name).has_value());
}

TEST_CASE("primes of moduli are read as instruments write them", "[io][csv]") {
  CHECK(first("w,G',G\"\n1,2,3\n", "loss_modulus_Pa") == 3.0);
  CHECK(first("w\tG\u2032 (kPa)\tG\u2033 (kPa)\n1\t2\t3\n", "loss_modulus_Pa") == 3000.0);
  CHECK(first("w\tE\u2019\tE\u2019\u2019\n1\t2\t3\n", "loss_modulus_Pa") == 3.0);
  CHECK(first("w\tE\u2019\tE\u2019\u2019\n1\t2\t3\n", "storage_modulus_Pa") == 2.0);
}

TEST_CASE("angular frequency becomes frequency", "[io][csv]") {
  const double two_pi = 2.0 * std::numbers::pi;
  CHECK(first("omega,G'\n3,1\n", "frequency_Hz") == Approx(3.0 / two_pi).epsilon(1e-15));
  for (const char* name : {"omega_rad_s", "angular_frequency_rad_s", "frequency_rad_s"}) {
    CAPTURE(name);
    CHECK(first(std::string(name) + ",G'\n3,1\n", "frequency_Hz") ==
          Approx(3.0 / two_pi).epsilon(1e-15));
  }
  CHECK(first("w (rad/s),G' (Pa)\n3,1\n", "frequency_Hz") == Approx(3.0 / two_pi).epsilon(1e-15));
  CHECK(first("f (Hz),G'\n3,1\n", "frequency_Hz") == 3.0);
  CHECK(first("f (rad/s),G'\n3,1\n", "frequency_Hz") == Approx(3.0 / two_pi).epsilon(1e-15));
}

TEST_CASE("case distinguishes time from temperature and force from frequency", "[io][csv]") {
  const std::string text = "t,T,f,F\n1,2,3,4\n";
  CHECK(first(text, "time_s") == 1.0);
  CHECK(first(text, "temperature_C") == 2.0);
  CHECK(first(text, "frequency_Hz") == 3.0);
  CHECK(first(text, "force_N") == 4.0);
}

TEST_CASE("the command line names, flips, scales and numbers columns", "[io][csv]") {
  const std::string text = "Time (s),tip_sample_separation_m,Force [nN],aux\n5,0.25,7,9\n";
  CHECK(first(text, "depth_m", {"depth_m=-tip_sample_separation_m"}) == -0.25);
  CHECK(first(text, "force_N", {"force_N=1e9*Force [nN]"}) == Approx(7.0).epsilon(1e-15));
  CHECK(first(text, "force_N", {"force_N=Force"}) == 7.0 * 1e-9);
  CHECK(first(text, "force_N", {"force_N=-0.5*3"}) == -3.5 * 1e-9);
  CHECK(first(text, "time_s", {"time_s=Time (s)"}) == 5.0);
  CHECK(first(text, "time_s", {"time_s=1"}) == 5.0);
  CHECK(first(text, "time_s", {"time_s=4"}) == 9.0);
  const std::string bare = "0 1.5\n1 2.5\n";
  CHECK(first(bare, "modulus_Pa", {"modulus_Pa=2"}) == 1.5);
  CHECK(first(bare, "modulus_Pa", {"modulus_Pa=2 [MPa]"}) == 1.5e6);
  CHECK(first("load_cell_mN,x\n2,3\n", "force_N", {"force_N=load_cell_mN"}) == 2.0 * 1e-3);
}

TEST_CASE("a found column describes its name, number and scale", "[io][csv]") {
  const CsvTable table = csv_from_text("t (ms),Force [nN]\n1,2\n", "t.csv");
  CHECK(find_column(table, "force_N")->description == "force_N: column 2 'Force [nN]' x 1e-09");
  CHECK(find_column(table, "force_N")->index == 1);
  CHECK_FALSE(find_column(table, "depth_m").has_value());
}

TEST_CASE("a viscard name is preferred to an alias, and two equal matches are refused",
          "[io][csv]") {
  CHECK(first("force_N,Load (N)\n2,3\n", "force_N") == 2.0);
  CHECK(first("Load (N),Force (N)\n2,3\n", "force_N") == 3.0);  // its own name before another
  CHECK(contains(error_of("Load (N),Kraft (N)\n2,3\n", "force_N"),
                 "t.csv: columns 1 'Load (N)' and 2 'Kraft (N)' could both be force_N; choose one "
                 "with --column force_N=2"));
}

TEST_CASE("a missing column is refused with a list of the columns", "[io][csv]") {
  CHECK(error_of("t,x\n1,2\n", "force_N") ==
        "t.csv: has no column for force_N; there are 1 't', 2 'x'");
  CHECK(error_of("t,x\ns,mm\n1,2\n", "force_N") ==
        "t.csv: has no column for force_N; there are 1 't' in s, 2 'x' in mm");
  CHECK(contains(error_of("1 2\n", "force_N"),
                 "there is no header, so give the column by its number"));
  CHECK(contains(error_of("t,f\n1,2\n", "force_N", {"force_N=Force"}), "has no column 'Force'"));
  CHECK(contains(error_of("t,f\n1,2\n", "force_N", {"force_N=3"}), "has no column '3'"));
  CHECK(contains(error_of("t (s),x (mm)\n1,2\n", "force_N", {"force_N=x"}),
                 "t.csv: column 'x (mm)' for force_N: 'mm' is not a unit of N"));
}

TEST_CASE("a bad cell is refused with file, line, column and its text", "[io][csv]") {
  CHECK(error_of("time_s,force_N\n0,1\n1,abc\n", "force_N") ==
        "t.csv:3: column 2 'force_N' for force_N: 'abc' is not a finite number; expected a number");
  CHECK(contains(error_of("time_s,force_N\n0,1\n1,\n", "force_N"), "the cell is empty"));
  CHECK(contains(error_of("time_s,force_N\n0,1\n1,nan\n", "force_N"),
                 "'nan' is not a finite number"));
  CHECK(first("time_s,force_N\n0,1\n1,abc\n", "time_s") == 0.0);  // the other column is good
}

TEST_CASE("a column without any number is refused as a whole", "[io][csv]") {
  const std::string gaps = GENERATE(as<std::string>(), "0,nan\n1,nan\n", "0,\n1,n/a\n");
  CHECK(error_of("time_s,force_N\n" + gaps, "force_N") ==
        "t.csv: column 2 'force_N' for force_N: no row has a number; fill it in, or give another "
        "column");
}

TEST_CASE("rows of one segment are selected by name", "[io][csv]") {
  const CsvTable table =
      csv_from_text("segment,time_s\nextend,oops\npause,1\npause,2\nretract,3\n", "t.csv");
  const CsvTable pause = rows_of_segment(table, "pause");
  CHECK(column_SI(pause, "time_s") == std::vector<double>{1.0, 2.0});  // the bad cell is elsewhere
  CHECK(pause.lines.all() == std::vector<std::uint32_t>{3, 4});
  CHECK(contains(error_text([&] { column_SI(rows_of_segment(table, "extend"), "time_s"); }),
                 "t.csv:2:"));
  CHECK(error_text([&] { rows_of_segment(table, "hold"); }) ==
        "t.csv: has no segment 'hold'; there are extend, pause, retract");
  const CsvTable numbered = csv_from_text("Set,t\n0,5\n1,6\n", "t.csv");
  CHECK(column_SI(rows_of_segment(numbered, "1"), "time_s") == std::vector<double>{6.0});
}

TEST_CASE("words that a message proposes run nothing in a shell", "[io][csv]") {
  const auto words_of = [](const std::string& header) {
    const CsvTable table = csv_from_text("time_s,\"" + header + "\"\n1,2\n3,4\n", "t.csv");
    return words_for_factor(table, "modulus_Pa",
                            *find_column(table, "modulus_Pa", {{"modulus_Pa", "2"}}), 1e6);
  };
  CHECK(words_of("E $(touch a)") == "write --column 'modulus_Pa=1e6*E $(touch a)'");
  CHECK(words_of("E `touch a`") == "write --column 'modulus_Pa=1e6*E `touch a`'");
  CHECK(words_of("it's") == "write --column 'modulus_Pa=1e6*it'\\''s'");
  CHECK(words_of("a\x1b[2J") == "write --column 'modulus_Pa=1e6*2'");
}

TEST_CASE("bad words of --column are refused", "[io][csv]") {
  CHECK(contains(error_text([] { column_map_from_words({"time_s"}); }),
                 "is not of the form NAME=COLUMN"));
  CHECK(contains(error_text([] { column_map_from_words({"time_s="}); }),
                 "is not of the form NAME=COLUMN"));
  CHECK(contains(error_text([] { column_map_from_words({"tme_s=1"}); }), "did you mean 'time_s'?"));
  CHECK(contains(error_text([] { column_map_from_words({"time_s=1", "time_s=2"}); }), "twice"));
}

}  // namespace
}  // namespace viscard
