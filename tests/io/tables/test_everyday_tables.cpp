// Tables as people have them: notes, gaps, clocks, several tables, other quantities, kinds of modulus.
#include "io/tables/clock_times.h"
#include "io/tables/column_map.h"
#include "io/tables/column_proposal.h"
#include "io/tables/derived_columns.h"
#include "io/tables/modulus_of_columns.h"
#include "tests/support/error_text.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>
#include <string>
#include <vector>

namespace viscard {
namespace {

using test::contains;
using test::error_text;
using Numbers = std::vector<double>;

CsvTable read(const std::string& text, const TableChoice& choice = {}) {
  CsvTable table = csv_from_text(text, "t.csv", choice);
  table.judged = Plausible::kOff;  // the numbers are chosen to be told apart
  return table;
}

// The table with the columns that follow from others.
CsvTable derived(const std::string& text, const SpecimenSize& size = {}) {
  CsvTable table = read(text);
  derive_columns(table, {}, size);
  return table;
}

TableModulusKind kind_of(const CsvTable& table) {
  return modulus_kind_of(table, {},
                         {"modulus_Pa", "stress_Pa", "strain", "compliance_1_Pa",
                          "storage_modulus_Pa", "loss_modulus_Pa"});
}

// A variable of a MATLAB file of level 4: a row of doubles.
std::string level_4(const std::string& name, const Numbers& values) {
  const std::uint32_t head[] = {0, 1, static_cast<std::uint32_t>(values.size()), 0,
                                static_cast<std::uint32_t>(name.size() + 1)};
  std::string bytes(sizeof head, '\0');
  std::memcpy(bytes.data(), head, sizeof head);
  bytes += name;
  bytes += '\0';
  const std::size_t at = bytes.size();
  bytes.resize(at + values.size() * sizeof(double));
  std::memcpy(bytes.data() + at, values.data(), values.size() * sizeof(double));
  return bytes;
}

TEST_CASE("the header is found below notes that separators make as wide as the table",
          "[io][csv]") {
  for (const char* note : {"Sample;PDMS;;\nThickness (mm);3;;\n;;;\n", "Width (mm);6;;\n", "3;;;\n",
                           "Operator;A B;Machine;7\n"}) {
    CAPTURE(note);
    const CsvTable table = read(std::string(note) +
                                "Time (s);Force (N);Displacement (mm);Temp (C)\n"
                                "0,1;0,5;0,2;23\n0,2;0,4;0,2;23\n0,3;0,3;0,2;23\n");
    CHECK(column_SI(table, "force_N") == Numbers{0.5, 0.4, 0.3});
    CHECK(column_SI(table, "temperature_C").size() == 3);
  }
  // Notes of two cells are no header, and the names of quantities beat the last line of notes.
  const CsvTable two = read("Operator,AB\nTemperature,23\nt,F\n0,1\n1,2\n2,4\n");
  CHECK(column_SI(two, "force_N") == Numbers{1.0, 2.0, 4.0});
  const CsvTable units = read("Operator,AB\nDate,today\nTime,Modulus\ns,MPa\n0,1\n1,2\n");
  CHECK(column_SI(units, "modulus_Pa") == Numbers{1e6, 2e6});
}

TEST_CASE("rows of empty cells, a name more than columns and long notes do not hide a table",
          "[io][csv]") {
  CHECK(column_SI(read("Time (s),Modulus (MPa),\n0,1,\n1,2,\n,,\n,,\n"), "modulus_Pa") ==
        Numbers{1e6, 2e6});
  const CsvTable wide = read("Time (s),Modulus (MPa),Comment\n0,1\n1,2\n");
  CHECK(column_SI(wide, "modulus_Pa") == Numbers{1e6, 2e6});
  const CsvTable numbered = read("\"time_s\" \"modulus_Pa\"\n\"1\" 0.5 7\n\"2\" 0.6 8\n");
  CHECK(column_SI(numbered, "time_s") == Numbers{0.5, 0.6});
  std::string text;
  for (int i = 0; i < 300; ++i) text += "line of notes, of the machine\n";
  text += "Time (s);E (MPa)\n";
  for (int i = 0; i < 400; ++i) text += std::to_string(i) + ";1\n";
  CHECK(column_SI(read(text), "modulus_Pa").size() == 400);
}

TEST_CASE("rows with gaps in a column that is used are left out and counted", "[io][csv]") {
  for (const char* gap : {"", "NaN", "nan", "inf", "n/a", "#N/A", "-", "#DIV/0!", "null"}) {
    CAPTURE(gap);
    const CsvTable all =
        read("time_s,modulus_Pa,note\n0,5,a\n1," + std::string(gap) + ",\n2,6,b\n");
    std::size_t n_left_out = 0;
    const CsvTable table = rows_without_gaps(all, {"time_s", "modulus_Pa"}, {}, n_left_out);
    CHECK(n_left_out == 1);
    CHECK(column_SI(table, "modulus_Pa") == Numbers{5.0, 6.0});
    CHECK(table.lines.all() == std::vector<std::uint32_t>{2, 4});
  }
  // A word is no gap.
  std::size_t n_left_out = 0;
  const CsvTable word = rows_without_gaps(read("time_s,modulus_Pa\n0,5\n1,abc\n2,6\n"),
                                          {"time_s", "modulus_Pa"}, {}, n_left_out);
  CHECK(n_left_out == 0);
  CHECK(contains(error_text([&] { column_SI(word, "modulus_Pa"); }), "t.csv:3: column 2"));
}

TEST_CASE("clock times become seconds", "[io][csv]") {
  const auto seconds = [](const char* cell, DateOrder order = DateOrder::kDayFirst) {
    return clock_time_from(cell, order).value().seconds;
  };
  CHECK(seconds("01:02:03") == 3723.0);
  CHECK(seconds("02:03") == 123.0);
  CHECK(clock_time_from("00:00:01,250").value().fraction == 0.25);
  CHECK(seconds("1970-01-02T00:00:01Z") == 86401.0);
  CHECK(seconds("2024-02-29 12:00:00") == 1709208000.0);  // of the command date -u
  CHECK(seconds("29.02.2024 12:00:00") == 1709208000.0);
  CHECK(seconds("2/29/2024 12:00:00 PM", DateOrder::kMonthFirst) == 1709208000.0);
  CHECK_FALSE(clock_time_from("2/29/2024 12:00:00 PM").has_value());
  for (const char* none : {"12", "1.5", "a:b", "12:61:00", "2024-02-30 10:00:00", "12:00:00 x"}) {
    CAPTURE(none);
    CHECK_FALSE(clock_time_from(none).has_value());
  }
  const auto times = [](const std::string& header, const std::vector<std::string>& cells) {
    std::string text = header + ",modulus_Pa\n";
    for (const std::string& cell : cells) text += cell + ",5\n";
    return column_SI(read(text), "time_s");
  };
  CHECK(times("Time (mm:ss)", {"00:00.10", "00:00.20", "01:00"}) == Numbers{0.1, 0.2, 60.0});
  CHECK(times("Time", {"12:00:00.100", "12:00:00.200"}) == Numbers{0.05, 0.1 + 0.05});
  CHECK(times("Timestamp", {"2024-05-01T12:00:00.5", "2024-05-01T12:00:01.5"}) ==
        Numbers{0.5, 1.5});
  CHECK(times("Clock", {"23:59:59", "00:00:01"}) == Numbers{1.0, 3.0});
  CHECK(times("Time (hh:mm)", {"00:01", "00:02"}) == Numbers{60.0, 120.0});
}

TEST_CASE("several tables in a file are listed and chosen by number", "[io][csv]") {
  const std::string below =
      "First\nTime (s),E (MPa)\n0,1\n1,2\n\nSecond\nTime (s),E (MPa)\n0,3\n1,4\n2,5\n";
  const CsvTable most = read(below);
  CHECK(column_SI(most, "modulus_Pa") == Numbers{3e6, 4e6, 5e6});
  REQUIRE(most.notes.size() == 1);
  CHECK(contains(most.notes[0], "table 2 of 2, from line 8 on"));
  CHECK(most.lines.all() == std::vector<std::uint32_t>{8, 9, 10});
  CHECK(column_SI(read(below, {"", 1, 0}), "modulus_Pa") == Numbers{1e6, 2e6});
  CHECK(contains(error_text([&] { read(below, {"", 3, 0}); }), "no table 3; there are 2"));
  const std::string side = "A,,,B,\nTime (s),E (MPa),,Time (s),E (MPa)\n0,1,,0,3\n1,2,,,\n";
  CHECK(column_SI(read(side, {"", 1, 0}), "modulus_Pa") == Numbers{1e6, 2e6});
  CHECK(column_SI(read(side, {"", 2, 0}), "modulus_Pa") == Numbers{3e6});
  const std::string close = "Time (s),Force (N),Time (s),Force (N)\n0,1,0,3\n1,2,1,4\n";
  CHECK(column_SI(read(close, {"", 2, 0}), "force_N") == Numbers{3.0, 4.0});
  CHECK(column_SI(read("1,2\n3,4\ntime_s,force_N\n5,6\n7,8\n", {"", 0, 2}), "force_N") ==
        Numbers{6.0, 8.0});
  CHECK(contains(error_text([&] { read("a,b\n1,2\n", {"", 0, 9}); }), "--skip"));
}

TEST_CASE("lines below a table are no rows, and lines of text within it stay errors", "[io][csv]") {
  const CsvTable footer = read("time_s,force_N\n0,1\n1,2\nMean,1.5\nEnd of data\n");
  CHECK(column_SI(footer, "force_N") == Numbers{1.0, 2.0});
  REQUIRE(footer.notes.size() == 1);
  CHECK(contains(footer.notes[0], "lines from 4 on"));
  CHECK(contains(error_text([] { read("time_s,force_N\n0,1\nlifted\n1,2\n"); }), "t.csv:3"));
}

TEST_CASE("headers in Italian, Spanish, Russian and Japanese are found", "[io][csv]") {
  CHECK(column_SI(read("Tempo (s);Forza (mN);Spostamento (mm)\n0;1;2\n1;2;3\n"), "force_N")[1] ==
        Approx(2e-3).epsilon(1e-15));
  CHECK(column_SI(read("Tiempo (s);Fuerza (N);Desplazamiento (mm)\n0;1;2\n1;2;3\n"),
                  "depth_m")[0] == Approx(2e-3).epsilon(1e-15));
  const CsvTable russian = read("Время, с;Сила, мН;Перемещение, мм\n0;1;2\n1;2;3\n");
  CHECK(column_SI(russian, "time_s") == Numbers{0.0, 1.0});
  CHECK(column_SI(russian, "force_N")[0] == Approx(1e-3).epsilon(1e-15));
  CHECK(column_SI(russian, "depth_m")[1] == Approx(3e-3).epsilon(1e-15));
  const CsvTable sweep =
      read("Частота, Гц;МОДУЛЬ НАКОПЛЕНИЯ, МПа;Модуль потерь, МПа\n1;2;3\n2;3;4\n");
  CHECK(column_SI(sweep, "storage_modulus_Pa") == Numbers{2e6, 3e6});
  const CsvTable japanese = read("周波数 (Hz),貯蔵弾性率 (MPa),損失弾性率 (MPa)\n1,2,3\n2,3,4\n");
  CHECK(column_SI(japanese, "loss_modulus_Pa") == Numbers{3e6, 4e6});
  CHECK(column_SI(read("時間 (秒),荷重 (N)\n0,1\n1,2\n"), "force_N") == Numbers{1.0, 2.0});
  const char* relaxation[] = {
      "Tijd (s);Spanning (kPa);Rek (%)", "Tid (s);Spänning (kPa);Töjning (%)",
      "Čas (s);Napětí (kPa);Deformace (%)", "Zaman (s);Gerilme (kPa);Gerinim (%)",
      "시간 (s);응력 (kPa);변형률 (%)"};
  for (const std::string header : relaxation) {
    CAPTURE(header);
    const CsvTable table = read(header + "\n0;1;2\n1;2;2\n");
    CHECK(column_SI(table, "time_s") == Numbers{0.0, 1.0});
    CHECK(column_SI(table, "stress_Pa") == Numbers{1e3, 2e3});
    CHECK(column_SI(table, "strain") == Numbers{0.02, 0.02});
  }
}

TEST_CASE("a force in grams or kilograms is read as a weight, and says so", "[io][csv]") {
  const CsvTable table = read("Time (s),Load (kg),Force (g)\n0,2,3\n");
  CHECK_FALSE(find_column(read("Time (s),Load (kgf)\n0,2\n"), "force_N")->is_weight);
  const auto use = find_column(table, "force_N");
  REQUIRE(use);
  CHECK(use->is_weight);
  CHECK(column_SI(table, "force_N")[0] == Approx(3e-3 * 9.80665).epsilon(1e-14));
  CHECK(column_SI(read("Time (s),Load (kg)\n0,2\n"), "force_N")[0] == 2.0 * 9.80665);
}

TEST_CASE("symbols and kinds of load beside a name do not hide its quantity", "[io][csv]") {
  const auto value = [](const std::string& header, const char* name) {
    return column_SI(read("a," + header + "\n1,2\n"), name).at(0);
  };
  CHECK(value("Shear relaxation modulus G(t) (MPa)", "modulus_Pa") == 2e6);
  CHECK(value("Young's modulus E (kPa)", "modulus_Pa") == 2e3);
  CHECK(value("Storage Modulus (E') (kPa)", "storage_modulus_Pa") == 2e3);
  CHECK(value("E'' - Loss modulus [Pa]", "loss_modulus_Pa") == 2.0);
  CHECK(value("Tensile stress (MPa)", "stress_Pa") == 2e6);
  CHECK(value("Compressive strain (%)", "strain") == 0.02);
  CHECK(value("τ (kPa)", "stress_Pa") == 2e3);
  CHECK_FALSE(find_column(read("a,Shear rate (1/s)\n1,2\n"), "strain"));
  CHECK_FALSE(find_column(read("a,τ\n1,2\n"), "stress_Pa"));
}

TEST_CASE("the kind of modulus comes from headers and formats, and is assumed where none tells it",
          "[io][csv]") {
  const auto kind = [](const std::string& headers) {
    const std::string row = headers.find(",", headers.find(",") + 1) == std::string::npos
                                ? "1,2\n2,3\n"
                                : "1,2,3\n2,3,4\n";
    return kind_of(read(headers + "\n" + row));
  };
  for (const char* shear : {"t (s),G(t) (MPa)", "t (s),Shear modulus (MPa)", "t (s),J(t) (1/MPa)",
                            "f (Hz),G' (Pa),G'' (Pa)", "t (s),Shear stress (Pa),Shear strain (%)",
                            "t (s),τ (Pa),γ (%)", "w (rad/s),Gp,Gpp", "t,G_relax (Pa)",
                            "Zeit (s),Schubspannung (Pa),Scherung (%)", "t (s),剪切应力 (Pa)"}) {
    CAPTURE(shear);
    CHECK(kind(shear).kind == ModulusKind::kShear);
    CHECK_FALSE(kind(shear).is_assumed);
  }
  for (const char* tension : {"t (s),E(t) (MPa)", "t (s),D(t) (1/MPa)", "f (Hz),E' (Pa),E'' (Pa)",
                              "t (s),Tensile stress (Pa),Strain (%)", "time_s,modulus_Pa",
                              "time_s,stress_Pa,strain", "t (s),Young's modulus (kPa)"}) {
    CAPTURE(tension);
    CHECK(kind(tension).kind == ModulusKind::kTension);
    CHECK_FALSE(kind(tension).is_assumed);
  }
  for (const char* open : {"t (s),Modulus (MPa)", "f (Hz),Storage modulus (Pa),Loss modulus (Pa)",
                           "t (s),Stress (Pa),Strain (%)", "t (s),stress (MPa),strain"}) {
    CAPTURE(open);
    CHECK(kind(open).is_assumed);
  }
  CHECK(contains(error_text([&] { kind("f (Hz),E' (Pa),G'' (Pa)"); }), "--modulus-kind"));
  const CsvTable reptate = csv_from_text("gamma=0.5;\n1 2\n2 1\n", "a.gt");
  CHECK(kind_of(reptate).kind == ModulusKind::kShear);
  const CsvTable bare = read(
      "Point No.,Angular Frequency,Storage Modulus,Loss Modulus,Damping Factor\n"
      ",[rad/s],[Pa],[Pa],[1]\n1,1,2,3,1.5\n2,2,3,4,1.3\n");
  CHECK(bare.modulus_kind == ModulusKind::kShear);
  const CsvTable notes = read("Instrument name,DHR-3 rheometer\nTime (s),Modulus (Pa)\n0,1\n1,2\n");
  CHECK(kind_of(notes).kind == ModulusKind::kShear);
}

TEST_CASE("storage and loss modulus follow from what instruments write instead", "[io][csv]") {
  // E' = 3, E'' = 4: |E*| = 5, tan delta = 4/3.
  const double delta = std::atan2(4.0, 3.0);
  const std::string rad = std::to_string(delta),
                    deg = std::to_string(delta * 180.0 / std::numbers::pi);
  const std::string two_pi = std::to_string(2.0 * std::numbers::pi);
  const auto check = [](const std::string& header, const std::string& row, ModulusKind kind) {
    CAPTURE(header);
    const CsvTable table = derived(header + "\n" + row + "\n" + row + "\n");
    CHECK(column_SI(table, "storage_modulus_Pa")[1] == Approx(3e6).epsilon(1e-5));
    CHECK(column_SI(table, "loss_modulus_Pa")[0] == Approx(4e6).epsilon(1e-5));
    CHECK(kind_of(table).kind == kind);
  };
  check("f (Hz),|E*| (MPa),delta (rad)", "1,5," + rad, ModulusKind::kTension);
  check("f (Hz),|G*| (MPa),delta (deg)", "1,5," + deg, ModulusKind::kShear);
  check("f (Hz),Complex modulus (MPa),Phase angle (°)", "1,5," + deg, ModulusKind::kTension);
  check("f (Hz),G* (MPa),tan(δ)", "1,5,1.3333333333", ModulusKind::kShear);
  check("f (Hz),E' (MPa),tan delta", "1,3,1.3333333333", ModulusKind::kTension);
  check("f (Hz),G'' (MPa),Loss factor", "1,4,1.3333333333", ModulusKind::kShear);
  check("w (rad/s),|η*| (Pa·s),phase angle (deg)", "2,2.5e6," + deg, ModulusKind::kShear);
  check("f (Hz),Complex viscosity (Pa.s),tan delta",
        "1," + std::to_string(5e6 / 6.283185307179586) + ",1.3333333333", ModulusKind::kShear);
  CHECK(kind_of(derived("f (Hz),Complex modulus (MPa),tan delta\n1,5,1\n2,5,1\n")).is_assumed);
  CHECK(contains(error_text([] { derived("f (Hz),|E*| (MPa),delta\n1,5,53\n2,5,53\n"); }),
                 "--column 'phase_rad=delta [deg]'"));
}

TEST_CASE("nominal stress and strain follow from true ones and from load and extension",
          "[io][csv]") {
  // Stretch 2, nominal stress 3 MPa: true stress 6 MPa, true strain ln 2.
  const CsvTable both = derived("True strain,True stress (MPa)\n0.69314718056,6\n0,0\n");
  CHECK(column_SI(both, "strain")[0] == Approx(1.0).epsilon(1e-10));
  CHECK(column_SI(both, "stress_Pa")[0] == Approx(3e6).epsilon(1e-10));
  CHECK(column_SI(derived("stretch,True stress (MPa)\n2,6\n1,0\n"), "stress_Pa")[0] == 3e6);
  const SpecimenSize size{0.025, 12e-6, 0.0};
  const CsvTable load = derived("Extension (mm),Load (N)\n25,36\n0,0\n", size);
  CHECK(column_SI(load, "strain")[0] == 1.0);
  CHECK(column_SI(load, "stress_Pa")[0] == Approx(3e6).epsilon(1e-14));
  CHECK_FALSE(find_column(derived("Extension (mm),Load (N)\n25,36\n0,0\n"), "stress_Pa"));
  CsvTable notes = read(
      "Gauge length (mm);25;\nWidth (mm);6,0;\nThickness;2;mm\n"
      "Time (s);Load (N);Extension (mm)\n0,1;36;25\n0,2;18;25\n");
  const SpecimenSize found = size_from_notes(notes, {});
  CHECK(found.gauge_length_m == 0.025);
  CHECK(found.area_m2 == Approx(12e-6).epsilon(1e-14));
  CHECK(size_from_notes(notes, {0.05, 0.0, 0.0}).gauge_length_m == 0.05);
}

TEST_CASE("a relative modulus needs the modulus that it is relative to", "[io][csv]") {
  const std::string text = "time (s),g_R(t)\n0.1,0.9\n1,0.8\n";
  CHECK(column_SI(derived(text, {0.0, 0.0, 2e6}), "modulus_Pa")[1] == Approx(1.6e6).epsilon(1e-14));
  CHECK(contains(error_text([&] { derived(text); }), "--youngs-modulus"));
}

TEST_CASE("MATLAB files of level 4 are read, and damaged ones are not taken for them",
          "[io][csv]") {
  const std::string bytes =
      level_4("time_s", {0.0, 1.0, 2.0}) + level_4("force_N", {3.0, 4.0, 5.0});
  CHECK(column_SI(csv_from_text(bytes, "a.mat"), "force_N") == Numbers{3.0, 4.0, 5.0});
  for (const std::size_t length : {bytes.size() - 1, std::size_t{30}}) {
    CHECK_FALSE(error_text([&] { csv_from_text(bytes.substr(0, length), "a.mat"); }).empty());
  }
}

TEST_CASE("words are proposed only where headers or units support them", "[io][csv]") {
  CHECK(proposed_words(read("a,b\n0,5\n1,4\n2,3\n")).empty());
  CHECK(proposed_words(read("Frequency (Hz),Storage mod. (MPa)\n1,5\n2,4\n")).empty());
  CHECK(proposed_words(read("std frequency,my storage modulus,my loss modulus\n1,5,1\n2,6,2\n"))
            .empty());
  CHECK(proposed_words(read("Strain rate (1/s),Viscosity (Pa s)\n1,5\n2,4\n")).empty());
  // A unit that is not known keeps its column unread.
  CHECK_FALSE(find_column(read("Time,Modulus\ns,Mpa\n0,1\n1,2\n"), "modulus_Pa"));
}

TEST_CASE("a column of logarithms is read as what it is the logarithm of", "[io][csv]") {
  const CsvTable rheometer = read("log10 f (Hz),log10 E' (Pa),lg E'' (Pa)\n0,6,5\n1,6,5\n");
  CHECK(column_SI(rheometer, "frequency_Hz") == Numbers{1.0, 10.0});
  CHECK(column_SI(rheometer, "storage_modulus_Pa") == Numbers{1e6, 1e6});
  CHECK(column_SI(rheometer, "loss_modulus_Pa") == Numbers{1e5, 1e5});
  REQUIRE(rheometer.notes.size() == 3);
  CHECK(contains(rheometer.notes.front(), "'log10 f (Hz)' was read as logarithms to base 10"));
  const CsvTable inside = read("log(t/s);ln E (MPa)\n-1;0\n0;1\n");
  CHECK(column_SI(inside, "time_s") == Numbers{0.1, 1.0});
  CHECK(column_SI(inside, "modulus_Pa")[1] == Catch::Detail::Approx(1e6 * std::exp(1.0)));
  // Hencky's strain is a quantity of its own, and a logger no logarithm.
  const CsvTable hencky = read("t,log strain,logged\n0,0.1,1\n1,0.2,2\n");
  CHECK(column_SI(hencky, "true_strain") == Numbers{0.1, 0.2});
  CHECK(hencky.notes.empty());
}

TEST_CASE("numbers with thousands, quoted decimal commas and Fortran's exponents are read",
          "[io][csv]") {
  const Numbers expected{1498996.5, 998.0};
  CHECK(column_SI(read("t,E\n0,\"1,498,996.5\"\n1,\"998.0\"\n"), "modulus_Pa") == expected);
  CHECK(column_SI(read("t;E\n0;1,498,996.5\n1;998.0\n"), "modulus_Pa") == expected);
  for (const std::string sign :
       {"'", "\xE2\x80\x99", " ", "\xC2\xA0", "\xE2\x80\xAF", "\xE2\x80\x89"}) {
    CAPTURE(sign);
    const std::string grouped = "1" + sign + "498" + sign + "996";
    CHECK(column_SI(read("t;E\n0;" + grouped + ".5\n1;998.0\n"), "modulus_Pa") == expected);
    CHECK(column_SI(read("t;E\n0;" + grouped + ",5\n1;998,0\n"), "modulus_Pa") == expected);
    CHECK_THROWS(column_SI(read("t;E\n0;998\n1;1" + sign + "49\n2;997\n"), "modulus_Pa"));
  }
  // Points between thousands, which two of them in one number prove, beside decimal commas.
  CHECK(column_SI(read("t;E\n0;1.498.996,5\n1;998,0\n"), "modulus_Pa") == expected);
  CHECK(column_SI(read("t;E\n1;1.165.741\n9;1.000.127\n15;920.327\n"), "modulus_Pa") ==
        Numbers{1165741.0, 1000127.0, 920327.0});
  CHECK(column_SI(read("Version;1.234.567\nt;E\n0.5;998.5\n1.5;997.5\n"), "modulus_Pa") ==
        Numbers{998.5, 997.5});
  // Thousands that come and go, or decimals that do: refused.
  CHECK(contains(error_text([] { read("t;E\n1;1,038\n2;1,021\n3;990\n"); }),
                 "with as many decimals"));
  CHECK(column_SI(read("t E\n0 1.4989965D+06\n1 9.98d2\n"), "modulus_Pa") == expected);
  CHECK(column_SI(read("t,E\n\"0,1\",\"1,25\"\n\"1,2\",\"1,5\"\n"), "modulus_Pa") ==
        Numbers{1.25, 1.5});
  CHECK(column_SI(read("t,E\n0.5,\"1,498\"\n1.5,\"1,500\"\n"), "modulus_Pa") ==
        Numbers{1498.0, 1500.0});
  // A point in a note does not make thousands of decimal commas.
  CHECK(contains(error_text([] { read("Version;3.5\nt;E\n1,000;1,498\n2,000;1,500\n"); }),
                 "use the same decimal sign"));
  // A note with a comma does not change the decimal sign of the table.
  CHECK(column_SI(read("Rate,\"1,5\"\nt,E\n0.5,2.5\n1.5,3.5\n"), "modulus_Pa") ==
        Numbers{2.5, 3.5});
  CHECK(
      contains(error_text([] { read("t,E\n0,\"1,498\"\n1,\"1,500\"\n"); }),
               "line 2 has '1,498', which may be a number with thousands or with a decimal comma"));
}

TEST_CASE("units in capitals, microstrain, dynes and the names of mean values are read",
          "[io][csv]") {
  const CsvTable capitals = read("TIME(SEC),STRESS(PSI),STRAIN(IN/IN)\n0,1,0.05\n1,2,0.05\n");
  CHECK(column_SI(capitals, "stress_Pa")[0] == Catch::Detail::Approx(6894.757293));
  CHECK(column_SI(capitals, "strain")[0] == 0.05);
  for (const char* unit : {"µε", "με", "ustrain", "microstrain"}) {
    CAPTURE(unit);
    const CsvTable gauge = read("t (s),Strain (" + std::string(unit) + ")\n0,50000\n1,50000\n");
    CHECK(column_SI(gauge, "strain")[0] == Catch::Detail::Approx(0.05));
  }
  const CsvTable mean = read("Time (s),Mean modulus (dyn/cm²),SD\n0,10,1\n1,20,1\n");
  CHECK(column_SI(mean, "modulus_Pa")[1] == Catch::Detail::Approx(2.0));
}

TEST_CASE("a unit behind a name without brackets is read, and decides what an elongation is",
          "[io][csv]") {
  const CsvTable table = read("Time s,Load mN,Elongation %,Stress MPa\n0,1,5,2\n1,2,5,3\n");
  CHECK(column_SI(table, "force_N")[0] == Catch::Detail::Approx(1e-3));
  CHECK(column_SI(table, "strain")[0] == Catch::Detail::Approx(0.05));
  CHECK(column_SI(table, "stress_Pa") == Numbers{2e6, 3e6});
  CHECK(column_SI(read("t (s),Elongation (mm)\n0,5\n1,5\n"), "depth_m")[0] ==
        Catch::Detail::Approx(5e-3));
  const CsvTable bare = read("t (s),Elongation\n0,5\n1,5\n");
  CHECK_FALSE(find_column(bare, "strain", {}));
  CHECK_FALSE(find_column(bare, "depth_m", {}));
  CHECK(column_SI(read("Eng. Strain (mm/mm),Eng. Stress (N/mm^2)\n0.1,1\n0.2,2\n"),
                  "nominal_stress_Pa") == Numbers{1e6, 2e6});
}

TEST_CASE("tables in older encodings are read by the names that they hold", "[io][csv]") {
  // "Время, с;Модуль, МПа" in Windows-1251, "Czas [s];Naprężenie [MPa];..." in Windows-1250, "時間" in Shift-JIS.
  const CsvTable russian =
      read("\xc2\xf0\xe5\xec\xff, \xf1;\xcc\xee\xe4\xf3\xeb\xfc, \xcc\xcf\xe0\n0;1\n1;2\n");
  CHECK(column_SI(russian, "modulus_Pa") == Numbers{1e6, 2e6});
  const CsvTable polish = read(
      "Czas [s];Napr\xea\xbf"
      "enie [MPa];Odkszta\xb3"
      "cenie [%]\n0;1;5\n1;2;5\n");
  CHECK(column_SI(polish, "stress_Pa") == Numbers{1e6, 2e6});
  CHECK(column_SI(polish, "strain")[0] == Catch::Detail::Approx(0.05));
  const CsvTable japanese = read("\x8e\x9e\x8a\xd4 (s),\x89\x9e\x97\xcd (MPa)\n0,1\n1,2\n");
  CHECK(column_SI(japanese, "stress_Pa") == Numbers{1e6, 2e6});
  const CsvTable german = read(
      "Zeit [s];Weg [\xb5m];Kraft [N];Pr\xfc"
      "fer\n0;1;2;3\n1;2;3;4\n");
  CHECK(column_SI(german, "depth_m")[1] == Catch::Detail::Approx(2e-6));
}

TEST_CASE(
    "dates are read in the order in which the record goes on, and days of a spreadsheet become "
    "seconds",
    "[io]") {
  // From 23:50 on 1 May to 00:10 on 2 May, in steps of a minute.
  const auto rows = [](bool is_month_first) {
    std::string text = "Time,E(t) (MPa)\n";
    for (int minute = 0; minute < 20; ++minute) {
      const int day = minute < 10 ? 1 : 2;
      const std::string clock =
          (minute < 10 ? "23:5" : "00:0") + std::to_string(minute % 10) + ":00";
      const std::string date =
          is_month_first ? "05/0" + std::to_string(day) : "0" + std::to_string(day) + "/05";
      text += date + "/2024 " + clock + "," + std::to_string(2.0 - 0.01 * minute) + "\n";
    }
    return text;
  };
  for (const bool is_month_first : {false, true}) {
    CAPTURE(is_month_first);
    const CsvTable table = csv_from_text(rows(is_month_first), "a.csv");
    REQUIRE(table.columns[0].values.size() == 20);
    CHECK(table.columns[0].values.back() - table.columns[0].values.front() == Approx(19.0 * 60.0));
    const bool is_noted = std::any_of(
        table.notes.begin(), table.notes.end(),
        [](const std::string& note) { return note.find("month first") != std::string::npos; });
    CHECK(is_noted == is_month_first);
  }
  std::string days = "Time,E(t) (MPa)\n";
  for (int i = 1; i <= 20; ++i) {
    char cell[40];
    std::snprintf(cell, sizeof cell, "%.8f", 45413.5 + 0.1 * i / 86400.0);
    days += std::string(cell) + ",2\n";
  }
  const CsvTable table = csv_from_text(days, "a.csv");
  CHECK(table.columns[0].unit == "s");
  CHECK(table.columns[0].values.front() == Approx(0.05).margin(1e-3));
  CHECK(table.columns[0].values.back() - table.columns[0].values.front() ==
        Approx(1.9).margin(2e-3));
}

}  // namespace
}  // namespace viscard
