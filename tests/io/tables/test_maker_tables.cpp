#include "io/tables/column_map.h"
#include "io/tables/column_proposal.h"
#include "tests/support/error_text.h"

#include <catch2/catch.hpp>
#include <zip.h>

#include <map>
#include <numbers>

// Small files of the structure that makers write; the sources are listed in io/tables/README.md.

namespace viscard {
namespace {

using test::contains;
using test::error_text;
using Numbers = std::vector<double>;

CsvTable read(const std::string& text, const std::string& name = "t.txt") {
  CsvTable table = csv_from_text(text, name);
  table.judged = Plausible::kOff;  // the numbers are chosen to be told apart
  return table;
}

const std::string kJpk =
    "# TEXT EXPORT\n# data-description.instrument: JPK00806-CellHesion\n#\n# segmentIndex: 0\n"
    "# segment: extend\n# columns: tipSampleSeparation vDeflection seriesTime\n"
    "# fancyNames: \"Tip-Sample Separation\" \"Vertical Deflection\" \"Series Time\"\n"
    "# springConstant: 56.37\n# units: m N s\n#\n2.0E-5 -2.0E-10 1.0E-4\n1.9E-5 3.0E-9 3.0E-4\n"
    "\n# segmentIndex: 1\n# segment: pause\n# columns: tipSampleSeparation vDeflection seriesTime\n"
    "# units: m N s\n#\n1.8E-5 2.0E-9 5.0E-4\n";

const std::string kTrios =
    "[Version]\nTA Instruments LIMS export format version\t0\n[Sample]\nName\tPDMS\n[Step]\n"
    "Step name\tFrequency sweep (150.0 °C)\nNumber of points\t2\n"
    "Variables\tRun time\tTemperature\tAngular frequency\tStatus bits\tStress\tStorage "
    "modulus\tLoss "
    "modulus\nUnits\ts\t°C\trad/s\t\tPa\tkPa\tPa\n"
    "Data point\t552.1\t149.97\t1.0\t0xB6453\t1.5\t10\t3285\n"
    "Data point\t566.6\t149.98\t2.0\t0xB6453\t1.5\t11\t3621\n[Step]\n"
    "Step name\tFrequency sweep (140.0 °C)\nNumber of points\t1\n"
    "Variables\tRun time\tTemperature\tAngular frequency\tStatus bits\tStress\tStorage "
    "modulus\tLoss "
    "modulus\nUnits\ts\t°C\trad/s\t\tPa\tkPa\tPa\n"
    "Data point\t700.1\t139.97\t1.0\t0xB6453\t1.5\t20\t5285\n";

const std::string kAntonPaar =
    "Project:\tRelaxation Test\nTest:\tE3\nResult:\tStress Relaxation 1\n\n"
    "Interval and data points:\t1\t2\n"
    "Interval data:\tPoint No.\tTime\tShear Strain\tShear Stress\tRelaxation Modulus\tStatus\n"
    "\t\t\t\t\t\t\n\t\t[s]\t[%]\t[Pa]\t[kPa]\t\n\t1\t0,01\t1,5\t100\t6,5\tDy_\n"
    "\t2\t0,02\t1,5\t95\t6,1\tDy_\n\nInterval and data points:\t2\t1\n"
    "Interval data:\tPoint No.\tTime\tShear Strain\tShear Stress\tRelaxation Modulus\tStatus\n"
    "\t\t\t\t\t\t\n\t\t[s]\t[%]\t[Pa]\t[kPa]\t\n\t1\t0,03\t1,5\t90\t6,0\t\n";

// A zip archive of these files; ZIP_CM_STORE does not pack them.
std::string zipped(const std::map<std::string, std::string>& files,
                   zip_int32_t packed = ZIP_CM_DEFAULT) {
  zip_error_t error{};
  zip_source_t* memory = zip_source_buffer_create(nullptr, 0, 0, &error);
  zip_source_keep(memory);
  zip_t* archive = zip_open_from_source(memory, ZIP_TRUNCATE, &error);
  for (const auto& [name, text] : files) {
    zip_source_t* file = zip_source_buffer(archive, text.data(), text.size(), 0);
    const zip_int64_t index = zip_file_add(archive, name.c_str(), file, ZIP_FL_OVERWRITE);
    zip_set_file_compression(archive, static_cast<zip_uint64_t>(index), packed, 0);
  }
  REQUIRE(zip_close(archive) == 0);
  zip_source_open(memory);
  zip_source_seek(memory, 0, SEEK_END);
  std::string bytes(static_cast<std::size_t>(zip_source_tell(memory)), '\0');
  zip_source_seek(memory, 0, SEEK_SET);
  zip_source_read(memory, bytes.data(), bytes.size());
  zip_source_close(memory);
  zip_source_free(memory);
  return bytes;
}

// Two sheets: notes, and data with a merged title, a header, a row of units and an empty row.
std::string workbook(zip_int32_t packed = ZIP_CM_DEFAULT) {
  const std::string package = "http://schemas.openxmlformats.org/package/2006/relationships";
  const std::string sheet =
      "<worksheet xmlns=\"http://schemas.openxmlformats.org/spreadsheetml/"
      "2006/main\"><sheetData>";
  return zipped(
      {{"[Content_Types].xml", "<Types/>"},
       {"xl/workbook.xml",
        "<workbook xmlns:r=\"r\"><sheets><sheet name=\"Notes\" sheetId=\"1\" "
        "r:id=\"a\"/><sheet name=\"Data\" sheetId=\"2\" r:id=\"b\"/></sheets>"
        "</workbook>"},
       {"xl/_rels/workbook.xml.rels",
        "<Relationships xmlns=\"" + package +
            "\"><Relationship Id=\"a\" Target=\"worksheets/sheet1.xml\"/>"
            "<Relationship Id=\"b\" Target=\"/xl/worksheets/sheet2.xml\"/></Relationships>"},
       {"xl/sharedStrings.xml",
        "<sst><si><t>Step time</t></si><si><r><t>For</t></r><r><t>ce</t></r>"
        "</si><si><t>time</t></si></sst>"},
       {"xl/worksheets/sheet1.xml",
        sheet + "<row r=\"1\"><c r=\"A1\" t=\"s\"><v>0</v></c></row></sheetData></worksheet>"},
       {"xl/worksheets/sheet2.xml",
        sheet +
            "<row r=\"1\"><c r=\"B1\" t=\"inlineStr\"><is><t>Specimen \"1\"</t></is></c></row>"
            "<row r=\"3\"><c r=\"B3\" t=\"s\"><v>2</v></c><c r=\"C3\" t=\"s\"><v>1</v></c></row>"
            "<row r=\"4\"><c r=\"B4\" t=\"str\"><v>s</v></c><c r=\"C4\" t=\"str\"><v>mN</v></c>"
            "</row><row r=\"6\"><c r=\"B6\"><v>0.5</v></c><c r=\"C6\"><v>2.5E-1</v></c></row>"
            "<row r=\"7\"><c r=\"B7\"><v>1</v></c><c r=\"C7\"><v>3</v></c></row>"
            "</sheetData><mergeCells><mergeCell ref=\"B1:C1\"/></mergeCells></worksheet>"}},
      packed);
}

TEST_CASE("a sheet whose bytes do not have its checksum is refused as damaged", "[io][csv]") {
  std::string bytes = workbook(ZIP_CM_STORE);
  CHECK(csv_from_text(bytes, "t.xlsx").columns.size() == 2);
  const std::size_t at = bytes.find("<v>0.5</v>");
  REQUIRE(at != std::string::npos);
  bytes[at + 3] = '7';
  CHECK(contains(error_text([&] { csv_from_text(bytes, "t.xlsx"); }), "is damaged"));
}

TEST_CASE("a workbook gives the sheet with most numbers, or the one that is named", "[io][csv]") {
  const std::string bytes = workbook();
  const CsvTable table = csv_from_text(bytes, "t.xlsx");
  CHECK(table.maker == "Excel workbook, sheet 'Data' of 2");
  CHECK(column_SI(table, "time_s") == Numbers{0.5, 1.0});
  CHECK(column_SI(table, "force_N")[0] == Approx(0.25e-3).epsilon(1e-15));
  CHECK(table.lines.all() == std::vector<std::uint32_t>{6, 7});
  CHECK(contains(error_text([&] { csv_from_text(bytes, "t.xlsx", {"Raw"}); }),
                 "t.xlsx: has no sheet 'Raw'; there are Notes, Data"));
  CHECK(contains(error_text([&] { csv_from_text(bytes, "t.xlsx", {"Notes"}); }),
                 "no line with a number"));
  CHECK(contains(error_text([&] { csv_from_text("a,b\n1,2\n", "t.csv", {"Data"}); }), "--sheet"));
  CHECK(contains(error_text([&] { csv_from_text(bytes.substr(0, bytes.size() - 60), "t.xlsx"); }),
                 "t.xlsx: is no readable Excel workbook"));
}

TEST_CASE("a JPK force curve gives time, force and depth of all segments", "[io][csv]") {
  const CsvTable table = read(kJpk);
  CHECK(table.maker == "JPK force curve");
  CHECK(column_SI(table, "time_s") == Numbers{1e-4, 3e-4, 5e-4});
  CHECK(column_SI(table, "force_N") == Numbers{-2e-10, 3e-9, 2e-9});
  CHECK(column_SI(table, "depth_m") == Numbers{-2e-5, -1.9e-5, -1.8e-5});
  CHECK(column_text(table, "segment") == std::vector<std::string>{"extend", "extend", "pause"});
  CHECK(table.lines.all() == std::vector<std::uint32_t>{11, 12, 19});
  const std::string cut = kJpk.substr(0, kJpk.size() - 9);
  CHECK(contains(error_text([&] { read(cut); }), "t.txt: line 19: 2 cells"));
}

TEST_CASE("a TRIOS export gives the steps with their temperatures", "[io][csv]") {
  const CsvTable table = read(kTrios);
  CHECK(table.maker == "TA Instruments TRIOS");
  CHECK(column_SI(table, "frequency_Hz")[1] == Approx(1.0 / std::numbers::pi).epsilon(1e-15));
  CHECK(column_SI(table, "storage_modulus_Pa") == Numbers{10e3, 11e3, 20e3});
  CHECK(column_SI(table, "loss_modulus_Pa") == Numbers{3285.0, 3621.0, 5285.0});
  CHECK(column_SI(table, "temperature_C")[2] == Approx(139.97).epsilon(1e-12));
  CHECK(column_text(table, "segment")[2] == "Frequency sweep (140.0 °C)");
  CHECK(
      contains(error_text([&] { read(kTrios.substr(0, kTrios.size() - 6)); }), "t.txt: line 17:"));
}

TEST_CASE("a RheoCompass export gives its intervals", "[io][csv]") {
  const CsvTable table = read(kAntonPaar);
  CHECK(table.maker == "Anton Paar RheoCompass");
  CHECK(column_SI(table, "time_s") == Numbers{0.01, 0.02, 0.03});
  CHECK(column_SI(table, "modulus_Pa") == Numbers{6500.0, 6100.0, 6000.0});
  CHECK(column_SI(table, "strain")[0] == Approx(0.015).epsilon(1e-15));
  CHECK(column_text(table, "segment")[2] == "Stress Relaxation 1, interval 2");
  std::string comma = kAntonPaar;  // separated by commas, numbers with points
  for (char& c : comma) c = c == ',' ? '.' : c == '\t' ? ',' : c;
  CHECK(column_SI(read(comma), "modulus_Pa") == Numbers{6500.0, 6100.0, 6000.0});
}

TEST_CASE("RepTate files are read by their ending and first line", "[io][csv]") {
  const std::string gt = "gamma=0.5; \nt sxy\n 1.0E-2 4\n0.02\t3\n";
  CHECK(read(gt, "a.gt").maker == "RepTate");
  CHECK(column_SI(read(gt, "a.gt"), "modulus_Pa") == Numbers{8.0, 6.0});
  CHECK(column_SI(read(gt, "a.gt"), "time_s") == Numbers{0.01, 0.02});
  const std::string creep =
      "chem=PE;label=CM3;T=150;stress=10;\nt\tstrain\tstress\tT\n"
      "s\t-\tPa\tC\n0.01\t5E-4\t10\t149.9\n0.1\t6E-4\n";
  const Numbers compliance = column_SI(read(creep, "a.creep"), "compliance_1_Pa");
  REQUIRE(compliance.size() == 2);
  CHECK(compliance[1] == Approx(6e-5).epsilon(1e-15));
  const std::string osc =
      "T=-10;chem=PI;\nFreq\tG'\tG\"\tTemp\nrad/s\tPa\tPa\t\xb0"
      "C\n"
      "  21.544  4.202E5   22189  -9.9\n";
  CHECK(column_SI(read(osc, "a.osc"), "loss_modulus_Pa") == Numbers{22189.0});
  const CsvTable tts = read("T=140;Mw=116000;Mn=37000\n1\t0.03\t9.1\n2\t0.1\t13.8\n", "a.tts");
  CHECK(column_SI(tts, "storage_modulus_Pa") == Numbers{0.03, 0.1});
  CHECK(column_SI(tts, "frequency_Hz")[0] == Approx(0.5 / std::numbers::pi).epsilon(1e-15));
  CHECK(contains(error_text([] { read("stress=1;rec=1;\nt strain\n0 1\n", "a.creep"); }),
                 "recovery"));
  CHECK(contains(error_text([] { read("T=1;\nt strain\n0 1\n", "a.creep"); }), "no stress"));
  CHECK(read("gamma=0.5;\nt sxy\n1 4\n2 3\n", "a.txt").maker.empty());
}

TEST_CASE("title rows, unit rows with blank cells and separators at the end are read",
          "[io][csv]") {
  // testXpert: quoted notes of any width, German names, a row of units.
  const CsvTable zwick = read(
      "\"Prüfinstitut\"\t\"A\"\n\"Datum/Uhrzeit\"\t44335.4\t\"\"\n\"h\"\t2.5\t\"mm\"\n"
      "\"Prüfzeit\"\t\"Standardkraft\"\t\"Traversenweg absolut\"\t\"Standardweg\"\n"
      "\"s\"\t\"N\"\t\"mm\"\t\"mm\"\n0.1\t0.5\t0.2\t0.7\n0.2\t0.6\t0.3\t0.8\n");
  CHECK(zwick.maker == "ZwickRoell testXpert");
  CHECK(column_SI(zwick, "force_N") == Numbers{0.5, 0.6});
  CHECK(column_SI(zwick, "depth_m")[1] == Approx(0.8e-3).epsilon(1e-15));
  // Optics11: notes with numbers, an empty last column.
  const CsvTable piuma = read(
      "Date\t13/11/2023\tTime\t15:30:01\nTip radius (um)\t24.5\nk (N/m)\t0.49\n\n"
      "Time (s)\tLoad (uN)\tIndentation (nm)\tCantilever (nm)\tPiezo (nm)\tAuxiliary\n"
      "0.000\t-0.001\t-10.0\t1.0\t0.0\t\n0.001\t0.5\t20.0\t2.0\t5.0\t\n0.002\t0.7\t30.0\t2.0\t5."
      "0\t\n");
  CHECK(piuma.maker == "Optics11");
  CHECK(column_SI(piuma, "depth_m")[1] == Approx(20e-9).epsilon(1e-15));
  CHECK(column_SI(piuma, "force_N")[1] == Approx(0.5e-6).epsilon(1e-15));
  // Quoted results of another width before the raw data, bracketed units, separators at the end.
  const CsvTable results = read(
      "\"Results Table 1\"\n,\"Maximum Load\",\n,\"(N)\",\n1,12.5,\n2,13.5,\n\n"
      "\"Time\",\"Extension\",\"Load\",\n\"(s)\",\"(mm)\",\"(N)\",\n"
      "\"0.000\",\"0.5\",\"1.0\",\n\"0.100\",\"0.6\",\"2.0\",\n\"0.200\",\"0.7\",\"3.0\",\n");
  CHECK(column_SI(results, "force_N") == Numbers{1.0, 2.0, 3.0});
  CHECK(column_SI(results, "depth_m")[0] == Approx(0.5e-3).epsilon(1e-15));
  // Units with a blank first and last cell; numbers of points in the first column.
  const CsvTable blanks = read("No\tTime\tF\tnote\n\ts\tmN\t\n1\t0.5\t3\ta\n2\t0.6\t4\tb\n");
  CHECK(column_SI(blanks, "force_N")[1] == Approx(4e-3).epsilon(1e-15));
  const CsvTable led = read("\tt\tF\n\ts\tmN\n\t0.5\t3\n\t0.6\t4\n");
  REQUIRE(led.columns.size() == 2);
  CHECK(column_SI(led, "force_N")[1] == Approx(4e-3).epsilon(1e-15));
}

TEST_CASE("Chinese tables are read as instruments write them, in GB18030", "[io][csv]") {
  // Time (s), load (mN), displacement (um); the bytes are those of glibc's iconv and of Python.
  const CsvTable table =
      read("\xca\xb1\xbc\xe4(s),\xd4\xd8\xba\xc9(mN),\xce\xbb\xd2\xc6(\xa6\xccm)\n0,1,2\n1,2,3\n");
  CHECK(table.columns[1].name == "\u8f7d\u8377");
  CHECK(column_SI(table, "time_s") == Numbers{0.0, 1.0});
  CHECK(column_SI(table, "force_N")[1] == Approx(2e-3).epsilon(1e-15));
  CHECK(column_SI(table, "depth_m")[0] == Approx(2e-6).epsilon(1e-15));
  // Latin-1 stays what it was: its letters above 0x7f stand alone.
  const CsvTable german = read("Zeit (s),Kraft (\xb5N),L\xe4nge (mm)\n0,1,2\n1,2,3\n");
  CHECK(german.columns[2].name == "L\u00e4nge");
  CHECK(column_SI(german, "force_N")[1] == Approx(2e-6).epsilon(1e-15));
}

TEST_CASE("any name of a quantity may be followed by its unit", "[io][csv]") {
  const CsvTable sweep = read("omega_rad_s,storage_kPa,loss_kPa\n6.283185307179586,2,1\n10,3,1\n");
  CHECK(column_SI(sweep, "frequency_Hz")[0] == Approx(1.0).epsilon(1e-15));
  CHECK(column_SI(sweep, "storage_modulus_Pa")[1] == Approx(3e3).epsilon(1e-15));
  CHECK(column_SI(sweep, "loss_modulus_Pa")[0] == Approx(1e3).epsilon(1e-15));
  // A number or another quantity's unit behind the name is no unit of it.
  const CsvTable other = read("t_s,F_1,load_mm\n0,2,1\n1,3,1\n");
  CHECK_FALSE(find_column(other, "force_N", {}));
}

TEST_CASE("columns are shown with first values, and words that read them are proposed",
          "[io][csv]") {
  const CsvTable table = read("a,b\n0,5\n1,4\n2,3\n3,2\n");
  CHECK(columns_with_values(table) == "1 'a' (0, 1, 2, ...), 2 'b' (5, 4, 3, ...)");
  CHECK(proposed_words(table).empty());
  const CsvTable units = read("x (mm),y (N),z (s)\n0,5,1\n1,6,2\n");
  CHECK(proposed_words(units) == "--column time_s=3 --column force_N=2 --column depth_m=1");
  CHECK(proposed_words(read("time_s,separation_m,force_N\n0,5,1\n1,4,2\n")) ==
        "--column time_s=1 --column force_N=3 --column depth_m=-2");
  CHECK(proposed_words(read("w (rad/s),a (Pa),b (Pa)\n1,5,1\n2,6,2\n")).empty());
  CHECK(proposed_words(read("x\n0\n1\n")).empty());
  CHECK(proposed_words(read("my time,creep compliance of A\n0,5\n1,6\n")) ==
        "--column time_s=1 --column compliance_1_Pa=2");
}

TEST_CASE("proposed words follow the names within headers, not the order of the columns",
          "[io][csv]") {
  CHECK(proposed_words(read("Time,CalculatedValue,AdjustedForce\n0,1,5\n1,2,6\n")).empty());
  CHECK(proposed_words(read(
            "Elapsed time,CalculatedValue,AdjustedForce,Raw_Displacement\n0,1,5,1\n1,2,6,2\n")) ==
        "--column time_s=1 --column force_N=3 --column depth_m=4");
  // A value in Pa is no modulus beside a force and a depth with their names.
  CHECK(proposed_words(read("Time (s),CalculatedValue (kPa),AdjustedForce (N),Extension (mm)\n"
                            "0,1,5,1\n1,2,6,2\n")) ==
        "--column time_s=1 --column force_N=3 --column depth_m=4");
  // A number of the row is no time, and a force alone is a force.
  CHECK(proposed_words(read("Point No.,TestTime,AdjustedForce\n1,0,5\n2,1,6\n3,2,7\n")) ==
        "--column time_s=2 --column force_N=3");
  CHECK(proposed_words(read("CalculatedValue,AdjustedForce,Seconds\n1,5,0\n2,6,1\n")).empty());
  CHECK(proposed_words(read("Point,AdjustedForce\n1,5\n2,6\n3,7\n")).empty());
  CHECK(proposed_words(read("AngularFrequency,MyLossModulus,MyStorageModulus\n1,5,1\n2,6,2\n")) ==
        "--column frequency_Hz=1 --column storage_modulus_Pa=3 --column loss_modulus_Pa=2");
}

TEST_CASE("a file of another kind is refused by what it is", "[io][csv]") {
  const auto refusal = [](const std::string& bytes) {
    return error_text([&] { csv_from_text(bytes, "f"); });
  };
  CHECK(refusal("\x89PNG\r\n\x1a\n") == "f: is a PNG picture, not a table");
  CHECK(refusal("\xff\xd8\xff\xe0") == "f: is a JPEG picture, not a table");
  CHECK(contains(refusal("%PDF-1.4\n1 0 obj\n"), "PDF document"));
  CHECK(contains(refusal("PK\x03\x04 xl/worksheets/sheet1.xml"), "Excel workbook"));
  CHECK(contains(refusal("{\n \"schema\": \"viscard-material/1\"}"), "is a material, not a table"));
  CHECK(contains(refusal("# test\nspeed = \"10 um/s\"\n[hold]\ntime = 5\n"), "not a table"));
  CHECK(contains(refusal("Calc_Ramp_Ex_nm\tDefl_V_Ex\n0\t0.1\n1\t0.2\n"), "which has no times"));
  CHECK(read("[s],[N]\n1,2\n").columns.size() == 2);
}

TEST_CASE("a workbook without end is refused with the limit", "[io][csv]") {
  const auto with_text = [](const std::string& text) {
    return zipped(
        {{"[Content_Types].xml", "<Types/>"},
         {"xl/workbook.xml",
          "<workbook xmlns:r=\"r\"><sheets><sheet name=\"Data\" r:id=\"a\"/></sheets></workbook>"},
         {"xl/_rels/workbook.xml.rels",
          "<Relationships><Relationship Id=\"a\" Target=\"worksheets/sheet1.xml\"/>"
          "</Relationships>"},
         {"xl/sharedStrings.xml", "<sst><si><t>" + text + "</t></si></sst>"},
         {"xl/worksheets/sheet1.xml",
          "<worksheet><sheetData><row r=\"1\"><c r=\"A1\" t=\"s\"><v>0</v></c></row><row "
          "r=\"2\"><c r=\"A2\"><v>1</v></c></row></sheetData></worksheet>"}});
  };
  CHECK(contains(error_text([&] { csv_from_text(with_text(std::string(1 << 20, 'x')), "t.xlsx"); }),
                 "t.xlsx: a cell has a text of 1048576 bytes; a sheet can have 32767"));
  CHECK(csv_from_text(with_text("time_s"), "t.xlsx").columns.size() == 1);
}

TEST_CASE("a workbook with more elements than a sheet can have is refused before they are parsed",
          "[io][csv]") {
  const auto times = [](int n, const std::string& one) {
    std::string all;
    for (int i = 0; i < n; ++i) all += one;
    return all;
  };
  const auto refusal_with = [](const std::string& texts, const std::string& rows) {
    const std::string bytes = zipped(
        {{"xl/workbook.xml",
          "<workbook xmlns:r=\"r\"><sheets><sheet name=\"A\" r:id=\"a\"/><sheet name=\"B\" "
          "r:id=\"a\"/></sheets></workbook>"},
         {"xl/_rels/workbook.xml.rels",
          "<Relationships><Relationship Id=\"a\" Target=\"worksheets/sheet1.xml\"/>"
          "</Relationships>"},
         {"xl/sharedStrings.xml", "<sst>" + texts + "</sst>"},
         {"xl/worksheets/sheet1.xml",
          "<worksheet><sheetData><row><c t=\"s\"><v>0</v></c></row><row><c><v>1</v></c></row>" +
              rows + "</sheetData><rowBreaks/></worksheet>"}});
    return error_text([&] { csv_from_text(bytes, "t.xlsx"); });
  };
  const std::string one_text = "<si><t>time_s</t></si>";
  CHECK(refusal_with(one_text, "") == "");
  CHECK(refusal_with(one_text, times(1048574, "<row/>")) == "");
  CHECK(contains(refusal_with(one_text, times(1048575, "<row/>")),
                 "t.xlsx: xl/worksheets/sheet1.xml has more than 1048576 rows, the limit; save the "
                 "sheet as CSV"));
  CHECK(contains(refusal_with(one_text + times(2097152, "<si/>"), ""),
                 "t.xlsx: xl/sharedStrings.xml has more than 2097152 shared texts, the limit"));
}

}  // namespace
}  // namespace viscard
