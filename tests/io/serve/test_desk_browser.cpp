// The desk in Chromium: from a table to a card, with the clicks counted.
#include "tests/io/serve/desk_person.h"
#include "tests/io/serve/served_desk.h"
#include "tests/support/error_text.h"

#include <catch2/catch.hpp>

#include <chrono>
#include <cmath>
#include <string>
#include <thread>

namespace viscard {
namespace {

using namespace test;  // of the browser

TEST_CASE("a newcomer comes from a dropped table to the card in at most six clicks",
          "[desk][slow]") {
  if (has_no_browser()) return;
  ServedDesk desk;
  ScratchFolder scratch;
  Browser browser(scratch / "profile");
  browser.set_window(1280, 800, false, false);
  browser.open(desk.server().address());
  REQUIRE(
      browser.wait_until("return document.getElementById('link').textContent === 'connected'", 20));
  look_at_desk(browser, "desk_empty");
  drop_on_page(browser, "pdms.csv", ServedDesk::example());
  Person person(browser);
  REQUIRE(browser.wait_until("return document.querySelectorAll('#rows tbody tr').length > 10", 20));
  CHECK(contains(browser.text("#rows thead"), "modulus_Pa"));
  look_at_desk(browser, "desk_table");
  person.click("#tab-fit");
  REQUIRE(
      browser.wait_until("return document.querySelectorAll('#moduli tbody tr').length > 2", 30));
  CHECK(contains(browser.text("#moduli"), "MPa"));
  CHECK(browser.wait_until(has_line("#fit-chart", "fit"), 10));
  CHECK(browser.wait_until(has_line("#residual-chart", "depth"), 10));
  // Cursors at the desk are those of the rig.
  browser.click("#fit-chart ~ .chart-bar button:first-child");
  REQUIRE(shows(browser, "#fit-chart ~ .cursor-values", "data (MPa)"));
  browser.run("document.querySelector('#fit-chart ~ .cursor').focus()");
  const std::string at = "return Number(document.activeElement.getAttribute('aria-valuenow'))";
  const double at_s = browser.run(at).get<double>();
  browser.press_key("\uE014");
  CHECK(browser.run(at).get<double>() > 1.001 * at_s);
  browser.run("document.activeElement.blur()");
  look_at_desk(browser, "desk_fit");
  browser.click("#fit-chart ~ .chart-bar button:first-child");
  CHECK_FALSE(browser.is_shown("#fit-chart ~ .cursor-values"));
  browser.run("scrollTo(0, 0)");
  person.click("#tab-card");
  person.choose("#target", "abaqus");
  person.click("#units input[value=mm-t-s]");
  REQUIRE(browser.wait_until(
      "return document.getElementById('card-text').textContent.includes('mm-t-s')", 30));
  browser.run("const s = getSelection(); s.removeAllRanges();");
  look_at_desk(browser, "desk_card");
  browser.run(kKeepDownloads);
  person.click("#download");
  REQUIRE(browser.wait_until("return window.saved.length === 1", 10));
  CHECK(person.n_clicks <= 6);
  const nlohmann::json saved = browser.run("return window.saved[0]");
  CHECK(saved.at(0) == "pdms.inp");
  CHECK(contains(saved.at(1), "*VISCOELASTIC"));
  CHECK(std::filesystem::exists(desk.folder() / "pdms.json"));
  CHECK(browser.errors().empty());
}

TEST_CASE("guesses are changed in place, undone, predicted, compared, and a card is checked",
          "[desk][slow]") {
  if (has_no_browser()) return;
  ServedDesk desk;
  ScratchFolder scratch;
  const std::string example = ServedDesk::example();
  desk.drop("a.csv", "time,E" + example.substr(example.find("\n0.01,")));  // without units
  desk.drop("b.csv", example);
  desk.drop("c.csv", example.substr(0, example.rfind('\n', example.size() - 2) + 1));
  desk.drop("d.csv", ServedDesk::example(0.5));
  desk.drop("e.csv", ServedDesk::example(0.53));
  Browser browser(scratch / "profile");
  browser.set_window(1280, 800, false, false);
  browser.open(desk.server().address());
  browser.click("#tables li:first-child button");
  REQUIRE(shows(browser, "#rows thead", "No unit is stated"));
  look_at_desk(browser, "desk_guess");
  set_field(browser, "#rows thead th:nth-child(3) input", "MPa");
  REQUIRE(shows(browser, "#rows thead", "modulus_Pa × 1000000"));
  CHECK(std::filesystem::exists(desk.folder() / "a.csv.options"));
  browser.click("#tab-fit");
  REQUIRE(shows(browser, "#moduli", "1.88 MPa"));
  browser.click("#orders button:nth-of-type(3)");  // one term
  REQUIRE(
      browser.wait_until("return document.querySelectorAll('#moduli tbody tr').length === 4", 20));
  CHECK(shows(browser, "#fit-same", "--terms=1"));
  browser.press_key("z");  // alone it does nothing
  browser.click("#tab-table");
  browser.click("#undo");
  browser.click("#tab-fit");
  REQUIRE(
      browser.wait_until("return document.querySelectorAll('#moduli tbody tr').length === 6", 20));
  browser.click("#tab-predict");
  REQUIRE(browser.wait_until(has_line("#predict-chart", "fit"), 30));
  set_field(browser, "#predict-test", "relaxation");
  set_field(browser, "#predict-against", "b.csv");
  REQUIRE(shows(browser, "#predict-status", "of b.csv"));
  CHECK(browser.wait_until(has_line("#predict-chart", "series-1"), 20));  // the rows of the table
  const auto class_of = [&](const char* id) {
    return browser.run(std::string("return document.getElementById('") + id + "').className")
        .get<std::string>();
  };
  CHECK(class_of("predict-status") == "good");
  look_at_desk(browser, "desk_predict");
  set_field(browser, "#predict-against", "d.csv");
  REQUIRE(shows(browser, "#predict-status", "they disagree"));
  CHECK(class_of("predict-status") == "alert");
  browser.click("#tab-compare");
  browser.click("#compare-tables .specimen:nth-child(2) label input");
  REQUIRE(browser.wait_until(has_line("#compare-chart", "series-2"), 30));
  CHECK(shows(browser, "#compare-moduli", "b.csv"));
  browser.click("#compare-chart ~ .chart-bar button:first-child");
  CHECK(shows(browser, "#compare-chart ~ .cursor-values", "b.csv fit (MPa)"));
  look_at_desk(browser, "desk_compare");
  browser.click("#compare-tables .specimen:nth-child(1) label input");
  browser.click("#compare-tables .specimen:nth-child(3) label input");
  REQUIRE(shows(browser, "#compare-moduli", "c.csv"));
  browser.set_window(1280, 800, true, false);
  browser.set_window(1280, 800, false, false);
  browser.click("#compare-together");
  REQUIRE(shows(browser, "#fit-tests", "c.csv"));
  CHECK(shows(browser, "#fit-same", "viscard fit relaxation=b.csv relaxation=c.csv"));
  REQUIRE(browser.wait_until(has_line("#fit-chart", "fit"), 30));
  // Charts that were hidden when the colours changed fit their place.
  CHECK(browser.run("return document.querySelector('#residual-chart').clientHeight") == 120);
  look_at_desk(browser, "desk_together");
  browser.click("#tab-compare");
  browser.click("#compare-tables .specimen:nth-child(4) label input");
  browser.click("#compare-tables .specimen:nth-child(5) label input");
  for (const auto& [place, ratio] :
       {std::pair("2", "10"), std::pair("3", "10"), std::pair("4", "20"), std::pair("5", "20")}) {
    set_field(browser,
              "#compare-tables .specimen:nth-child(" + std::string(place) +
                  ") input:not([type=checkbox])",
              ratio);
  }
  REQUIRE(browser.wait_until("return !document.getElementById('compare-ratios').disabled", 20));
  browser.click("#compare-ratios");
  REQUIRE(shows(browser, "#ratio-specimens", "20:1"));
  look_at_desk(browser, "desk_ratios");
  CHECK(browser.wait_until(has_line("#ratio-chart", "fit"), 20));
  browser.click("#tab-card");
  set_field(browser, "#card-ratio", "30");
  set_field(browser, "#target", "abaqus");
  REQUIRE(shows(browser, "#card-status", R"("Extrapolate")"));  // its field, not its option
  browser.click("#card-extrapolate");
  REQUIRE(shows(browser, "#card-same", "may_extrapolate=True"));
  browser.click("#card-extrapolate");
  set_field(browser, "#card-ratio", "15");
  REQUIRE(shows(browser, "#card-text", "*VISCOELASTIC"));
  CHECK(shows(browser, "#card-same", "--ratio=15"));
  const auto card = desk.order("card", {{"table", "b.csv"}, {"card", {{"for", "abaqus"}}}});
  browser.click("#tab-check");
  set_field(browser, "#check-text", card.json.at("result").at("card"));
  REQUIRE(shows(browser, "#check-status", "No mistake"));
  const std::string series =
      "*MATERIAL, NAME=x\n*ELASTIC, MODULI=INSTANTANEOUS\n1.88, 0.495\n*VISCOELASTIC, "
      "TIME=PRONY\n0.2, 0.2, 1.0\n";
  set_field(browser, "#check-target", "abaqus");
  set_field(browser, "#check-text", series);
  REQUIRE(shows(browser, "#check-meaning", R"(("Units" mm-t-s))"));
  CHECK(class_of("check-status") == "alert");
  set_field(browser, "#check-units", "mm-t-s");
  REQUIRE(shows(browser, "#check-status", "No mistake"));
  CHECK(shows(browser, "#check-meaning", "no density"));
  set_field(browser, "#check-text", series + "0.9, 0.9, 2.0\n");
  REQUIRE(shows(browser, "#check-status", "No values were read"));
  CHECK_FALSE(contains(browser.text("#check-meaning"), "E0"));
  set_field(browser, "#check-text",
            "*MATERIAL, NAME=x\n*ELASTIC, MODULI=INSTANTANEOUS\n1.88e6, abc\n");
  REQUIRE(browser.wait_until("return document.querySelectorAll('#check-lines .wrong').length === 1",
                             30));
  look_at_desk(browser, "desk_check");
  // The look at the page finds what is wrong.
  browser.run(
      "document.body.append(Object.assign(document.createElement('button'), {style: 'color: #999; "
      "background: #aaa', textContent: 'grey'}), Object.assign(document.createElement('input'), "
      "{id: 'link'}))");
  CHECK(browser.accessibility_faults().size() >= 3);
  const nlohmann::json errors = browser.errors();
  INFO(errors.dump());
  for (const auto& error : errors) CHECK(contains(error.get<std::string>(), "422"));
}

TEST_CASE("a rubber is fitted by the kind that is chosen, alone and with others", "[desk][slow]") {
  if (has_no_browser()) return;
  ServedDesk desk;
  ScratchFolder scratch;
  Browser browser(scratch / "profile");
  browser.set_window(1280, 800, false, false);
  browser.open(desk.server().address());
  REQUIRE(
      browser.wait_until("return document.getElementById('link').textContent === 'connected'", 20));
  drop_on_page(browser, "rubber.csv", ServedDesk::rubber());
  REQUIRE(shows(browser, "#table-error", R"(Name the kind of test in the field "Kind")"));
  CHECK(browser.text("#table-error").starts_with("rubber.csv: holds"));  // as the file is named
  set_field(browser, "#field-kind", "uniaxial");
  REQUIRE(shows(browser, "#table-summary", "Read as uniaxial"));
  browser.click("#tab-fit");
  REQUIRE(shows(browser, "#rubber-law", "neo-hooke"));
  REQUIRE(shows(browser, "#fit-same", "viscard fit uniaxial=rubber.csv"));
  CHECK(shows(browser, "#fit-same", R"(viscard.fit({"uniaxial":"rubber.csv"}))"));
  look_at_desk(browser, "desk_rubber");
  browser.click("#tab-card");
  set_field(browser, "#target", "abaqus");
  REQUIRE(shows(browser, "#card-text", "*HYPERELASTIC"));
  browser.click("#card-approximate");
  CHECK(shows(browser, "#card-same", R"(result.card("abaqus", "SI", approximate=True))"));
  set_field(browser, "#target", "lsdyna");
  REQUIRE(shows(browser, "#card-status", R"(needs a density: "Density")"));
  set_field(browser, "#card-density", "1.1 g/cm3");
  CHECK(shows(browser, "#card-same", "density_kg_m3=1100"));
  browser.click("#tab-predict");
  REQUIRE(shows(browser, "#predict-status", "A law of rubber gives cards"));
  CHECK_FALSE(browser.is_shown("#predict-form"));
  drop_on_page(browser, "sheet.csv", ServedDesk::rubber(true));
  REQUIRE(shows(browser, "#table-error", "sheet.csv"));
  browser.click("#tab-compare");
  REQUIRE(shows(browser, "#compare-same", "viscard fit uniaxial=rubber.csv"));
  REQUIRE(shows(browser, "#compare-status", "sheet.csv: holds"));
  const std::string kind = "#compare-tables .specimen:nth-child(2) select";
  set_field(browser, kind, "planar");
  REQUIRE(shows(browser, "#compare-same", "viscard fit planar=sheet.csv"));
  look_at_desk(browser, "desk_rubbers");
  browser.click("#compare-together");
  REQUIRE(shows(browser, "#fit-same", "viscard fit uniaxial=rubber.csv planar=sheet.csv"));
  CHECK(shows(browser, "#rubber-tests", "planar"));
  const nlohmann::json errors = browser.errors();
  INFO(errors.dump());
  for (const auto& error : errors) CHECK(contains(error.get<std::string>(), "422"));
}

TEST_CASE("a prediction is drawn by its unit, and its lines are those of this prediction alone",
          "[desk][slow]") {
  if (has_no_browser()) return;
  ServedDesk desk;
  ScratchFolder scratch;
  desk.drop("a.csv", ServedDesk::example());
  Browser browser(scratch / "profile");
  browser.set_window(1280, 800, false, false);
  browser.open(desk.server().address());
  browser.click("#tables li:first-child button");
  browser.click("#tab-predict");
  set_field(browser, "#predict-test", "cycles");
  set_field(browser, "#predict-fields label:nth-child(3) input", "3");
  REQUIRE(shows(browser, "#predict-same", R"(test="cycles", cycles=3))"));
  CHECK(shows(browser, "#predict-same", "test -e a.json || viscard fit a.csv --out=a.json"));
  CHECK(browser.text("#predict-chart .dygraph-ylabel") == "stress (kPa)");
  CHECK(browser.wait_until(has_line("#predict-chart", "fit"), 20));
  set_field(browser, "#predict-test", "oscillation");
  REQUIRE(shows(browser, "#predict-legend", "loss modulus"));
  CHECK(browser.text("#predict-chart .dygraph-ylabel") == "modulus (MPa)");
  CHECK(browser.wait_until(has_line("#predict-chart", "depth"), 20));
  CHECK(browser.wait_until(has_line("#predict-loss-chart", "fit"), 20));
  CHECK(browser.text("#predict-log-x-name") == "log frequency");
  CHECK(browser
            .run("return document.querySelector('#predict-fields label:nth-child(1) "
                 "input').placeholder")
            .get<std::string>() == "in Hz, or with unit");
  look_at_desk(browser, "desk_oscillation");
  // What is refused leaves no lines of another prediction.
  set_field(browser, "#predict-test", "recovery");
  REQUIRE(shows(browser, "#predict-same", "--test=recovery"));
  set_field(browser, "#predict-fields label:nth-child(2) input", "-5");
  REQUIRE(shows(browser, "#predict-status", R"("Hold")"));
  CHECK(browser.run("return document.getElementById('predict-same').children.length") == 0);
  browser.click("#tab-card");
  REQUIRE(shows(browser, "#card-same", "test -e a.json || viscard fit a.csv --out=a.json"));
  const auto card = desk.order("card", {{"table", "a.csv"}, {"card", {{"for", "abaqus"}}}});
  browser.click("#tab-check");
  set_field(browser, "#check-text", card.json.at("result").at("card"));
  CHECK(shows(browser, "#check-same", "viscard card --check=CARD"));
  // A name at the beginning of a message keeps its letters; a word does not.
  CHECK(browser
            .run("window.said = null; import('/format.js').then(({sentence}) => { window.said = "
                 "['the port', 'omit it', 'a.csv: holds', 'mc: x', 'tau_1 is', "
                 "'time-zero is'].map(sentence); })")
            .is_null());
  REQUIRE(browser.wait_until("return window.said !== null", 10));
  CHECK(browser.run("return window.said") == nlohmann::json{"The port.", "Omit it.",
                                                            "a.csv: holds.", "mc: x.", "tau_1 is.",
                                                            "time-zero is."});
}

TEST_CASE("a long name widens no view of a phone, and a table of frequencies offers no times",
          "[desk][slow]") {
  if (has_no_browser()) return;
  ServedDesk desk;
  ScratchFolder scratch;
  desk.drop(std::string(90, 'x') + ".csv", ServedDesk::example());
  std::string sweep = "frequency_Hz,storage_modulus_Pa,loss_modulus_Pa\n";
  for (int i = 0; i < 30; ++i) {
    const double f_Hz = std::pow(10.0, 0.1 * i - 1.5), x = f_Hz * f_Hz;
    sweep += std::to_string(f_Hz) + "," + std::to_string(1e6 + 2e5 * x / (1 + x)) + "," +
             std::to_string(2e5 * f_Hz / (1 + x) + 1e3) + "\n";
  }
  desk.drop("dma.csv", sweep);
  Browser browser(scratch / "profile");
  browser.set_window(390, 844, false, true);
  browser.open(desk.server().address());
  browser.click("#tables li:last-child button");
  REQUIRE(shows(browser, "#table-summary", "Read as relaxation"));
  CHECK(browser.run("return document.getElementById('field-from') !== null").get<bool>());
  for (const char* view : {"table", "fit", "card", "predict", "compare", "report"}) {
    CAPTURE(view);
    browser.click(std::string("#tab-") + view);
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    CHECK(browser.run("return document.documentElement.scrollWidth <= innerWidth").get<bool>());
  }
  browser.click("#tab-table");
  browser.click("#tables li:first-child button");
  REQUIRE(shows(browser, "#table-summary", "Read as dma"));
  CHECK(browser
            .run("return document.getElementById('field-from') === null && "
                 "document.getElementById('more-hold') === null && "
                 "document.getElementById('more-terms') !== null")
            .get<bool>());
  CHECK(browser.errors() == nlohmann::json::array());
}

TEST_CASE(
    "isotherms are dragged by mouse and finger, moved by keys, fitted from there and taken back",
    "[desk][slow]") {
  if (has_no_browser()) return;
  ServedDesk desk;
  ScratchFolder scratch;
  desk.drop("warm.csv", ServedDesk::isotherms());
  Browser browser(scratch / "profile");
  browser.set_window(1280, 800, false, false);
  browser.open(desk.server().address());
  browser.click("#tables li:first-child button");
  browser.click("#tab-fit");
  const std::string cold = "#isotherm-list .isotherm:nth-child(1)";
  const std::string warm = "#isotherm-list .isotherm:nth-child(3)";
  REQUIRE(shows(browser, cold, "1.00"));  // as fitted
  REQUIRE(shows(browser, warm, "−1.00"));
  CHECK(browser
            .run("const table = document.getElementById('moduli'); return table.offsetWidth <= "
                 "table.parentElement.clientWidth")
            .get<bool>());
  CHECK(shows(browser, "#isotherm-list .isotherm:nth-child(2)", "reference"));
  look_at_desk(browser, "desk_isotherms");
  const auto shift_of = [&](const std::string& slider) {
    return browser
        .run("return Number(document.querySelector('" + slider +
             "').getAttribute('aria-valuenow'))")
        .get<double>();
  };
  const auto drag_warm = [&](double by_px, bool is_touch) {
    // From below: at the long times the warm isotherm lies alone.
    std::string find = place_of_color("#isotherm-chart", "series-3");
    const std::string from_above = "for (let i = 0; i < d.length; i += 4)";
    find.replace(find.find(from_above), from_above.size(),
                 "for (let i = d.length - 4; i >= 0; i -= 4)");
    REQUIRE(browser.wait_until(  // as wide as the window lets it be, and drawn, with no fit to come
        "if (document.getElementById('fit-status').textContent.startsWith('Fitting')) return "
        "false; "
        "const box = document.querySelector('#isotherm-chart canvas').getBoundingClientRect(); "
        "return box.right <= innerWidth && (() => { " +
            find + " })() !== null",
        20));
    browser.run(
        "document.querySelector('#isotherm-chart canvas').scrollIntoView({block: 'center'})");
    const nlohmann::json place = browser.run(find);
    REQUIRE(place.is_array());
    browser.drag(place.at(0), place.at(1), by_px, is_touch);
  };
  drag_warm(30.0, false);
  const double dragged = shift_of(warm);
  CHECK(dragged < -1.1);  // t/aT grows
  CHECK(shift_of(cold) == Approx(1.0).margin(0.01));
  CHECK(shows(browser, "#isotherm-readout", "30 °C: log10 aT"));
  browser.press_key("\uE014");  // right
  CHECK(shift_of(warm) == Approx(dragged - 0.05).margin(0.002));
  browser.press_key("\uE013");  // up
  CHECK(shift_of(warm) == Approx(dragged).margin(0.002));
  browser.run(
      "document.activeElement.dispatchEvent(new KeyboardEvent('keydown', {key: 'ArrowLeft', "
      "shiftKey: true, bubbles: true}))");
  CHECK(shift_of(warm) == Approx(dragged + 0.5).margin(0.002));
  CHECK(contains(browser
                     .run("return document.activeElement.getAttribute('aria-label') + ' ' + "
                          "document.activeElement.getAttribute('aria-valuetext')")
                     .get<std::string>(),
                 "Isotherm at 30 °C log10 of the shift factor"));
  browser.click("#isotherm-undo");
  CHECK(shift_of(warm) == Approx(dragged).margin(0.002));
  browser.click("#isotherm-fit");
  REQUIRE(shows(browser, "#fit-same", "--start-shift=30=-1."));
  CHECK(shows(browser, "#fit-same", "start_shift=["));
  CHECK(shows(browser, "#isotherm-note", "The fit did not start from the shifts"));
  CHECK(shift_of(warm) == Approx(-1.0).margin(0.01));
  CHECK(contains(read_file(desk.folder() / "warm.csv.options"), "--start-shift=10=1\n"));
  browser.click("#isotherm-zero");
  CHECK(shift_of(cold) == 0.0);
  browser.click("#isotherm-undo");
  CHECK(shift_of(cold) == Approx(1.0).margin(0.01));
  browser.click("#isotherm-undo");
  CHECK(browser.wait_until(
      "return !document.getElementById('fit-same').textContent.includes('--start-shift')", 20));
  REQUIRE(shows(browser, warm, "−1.00"));
  browser.set_window(390, 844, false, true);
  drag_warm(40.0, true);
  CHECK(browser.wait_until(
      "return Number(document.querySelector('" + warm + "').getAttribute('aria-valuenow')) < -1.1",
      10));
  CHECK(browser.errors() == nlohmann::json::array());
}

TEST_CASE("the voltage of a pillar with what its accuracy costs, and a report", "[desk][slow]") {
  if (has_no_browser()) return;
  ServedDesk desk;
  ScratchFolder scratch;
  desk.drop("a.csv", ServedDesk::example());
  Browser browser(scratch / "profile");
  browser.set_window(1280, 800, false, false);
  browser.open(desk.server().address());
  Person person(browser);
  REQUIRE(browser.wait_until("return document.querySelectorAll('#tables li').length === 1", 20));
  person.click("#tab-scene");
  REQUIRE(browser.wait_until("return document.querySelectorAll('#scene-example option').length > 5",
                             20));
  person.choose("#scene-example", "pillar_press.toml");
  REQUIRE(browser.wait_until("return document.querySelectorAll('#scene-pictures img').length === 1",
                             30));
  REQUIRE(shows(browser, "#scene-effects", "film compliance"));
  look_at_desk(browser, "desk_scene");
  person.click("#scene-cost");
  REQUIRE(browser.wait_until("return document.querySelectorAll('#scene-choices button').length > 0",
                             60));
  CHECK(shows(browser, "#scene-same", R"(viscard.cost("pillar_press.toml", budget=10))"));
  look_at_desk(browser, "desk_cost");
  browser.click("#scene-choices button:last-child");
  REQUIRE(shows(browser, "#scene-results", "electrode voltage"));
  CHECK(shows(browser, "#scene-results", "±"));
  CHECK(shows(browser, "#scene-status", "Not within the tolerance: finite_strain is not computed"));
  CHECK(browser.wait_until("return document.querySelectorAll('#scene-pictures img').length >= 3",
                           10));
  CHECK(shows(browser, "#scene-pictures", "stress zz (Pa)"));
  CHECK(person.n_clicks <= 5);
  look_at_desk(browser, "desk_answer");
  set_field(browser, "#scene-text",
            browser.run("return document.getElementById('scene-text').value").get<std::string>() +
                "\n# changed\n");
  browser.click("#scene-keep");
  CHECK(browser.wait_until("return document.getElementById('scene-keep').disabled", 20));
  CHECK(contains(read_file(desk.folder() / "pillar_press.toml"), "# changed"));
  browser.click("#tables li:first-child button");
  browser.click("#tab-report");
  browser.click("#report-make");
  REQUIRE(shows(browser, "#report-status", "Written as report.html"));
  CHECK(shows(browser, "#report-same", "viscard report a.csv --out report.2.html"));
  CHECK(shows(browser, "#report-same", R"(viscard.report(["a.csv"], "report.2.html"))"));
  look_at_desk(browser, "desk_report");
  CHECK(std::filesystem::exists(desk.folder() / "report.html"));
  const nlohmann::json errors = browser.errors();
  INFO(errors.dump());
  CHECK(errors.empty());
}

}  // namespace
}  // namespace viscard
