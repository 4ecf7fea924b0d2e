// The page itself, in Chromium.
#include "io/basics/atomic_file.h"
#include "io/capture/capture_file.h"
#include "tests/io/serve/browser.h"
#include "tests/io/serve/desk_person.h"
#include "tests/io/serve/served_rig.h"
#include "tests/support/error_text.h"

#include <catch2/catch.hpp>

#include <cstdlib>
#include <iostream>
#include <optional>

namespace viscard {
namespace {

using test::Browser;
using test::contains;
using test::ScratchFolder;

constexpr const char* kForce =
    "return parseFloat(document.getElementById('run-force').textContent) > ";

// The page has no fault of accessibility. With VISCARD_SCREENSHOTS=FOLDER the test leaves pictures of it there.
// place: what they show, if not the begin of the page.
void look_at(Browser& browser, const std::string& name, const std::string& place = "") {
  const char* folder = std::getenv("VISCARD_SCREENSHOTS");
  const struct {
    const char* ending;
    int width, height;
    bool is_dark, is_phone;
  } views[] = {{"light", 1280, 1500, false, false},
               {"dark", 1280, 1500, true, false},
               {"phone", 390, 2600, false, true},
               {"phone_dark", 390, 844, true, true}};
  for (const auto& view : views) {
    browser.set_window(view.width, view.height, view.is_dark, view.is_phone);
    std::this_thread::sleep_for(std::chrono::milliseconds(700));
    if (!place.empty()) {
      browser.run("document.querySelector('" + place + "').scrollIntoView()");
    }
    CAPTURE(name, view.ending);
    CHECK(browser.accessibility_faults() == nlohmann::json::array());
    if (folder == nullptr) continue;
    browser.save_screenshot(std::filesystem::path(folder) / (name + "_" + view.ending + ".png"));
  }
  browser.set_window(1280, 1000, false, false);
}

bool is_without_browser() {
  const std::string missing = Browser::missing();
  if (missing.empty()) return false;
  std::cout << "skipped: " << missing << "\n";
  return true;
}

TEST_CASE("a person starts a run on the page, sees the force rise, and stops it", "[serve][slow]") {
  if (is_without_browser()) return;
  ScratchFolder scratch;
  RigServer server({.folder = scratch / "series", .is_emulated = true, .speed = 10.0});
  Browser browser(scratch / "profile");
  browser.set_window(1280, 1000, false, false);
  browser.open(server.address());
  REQUIRE(
      browser.wait_until("return document.getElementById('link').textContent === 'connected'", 20));
  CHECK(browser.run("return location.hash") == "");  // the token does not stay in the address line
  browser.run("document.querySelector('a.skip').click()");  // a hash that is no token
  CHECK(browser.run("return location.hash") == "#content");
  look_at(browser, "1_empty");

  browser.click("#add-submit");
  browser.type("#plan-hold_s", "300");
  look_at(browser, "2_ready");
  browser.click("#start");
  REQUIRE(browser.wait_until(std::string(kForce) + "0.1", 60));
  REQUIRE(browser.wait_until(std::string(kForce) + "1.0", 60));
  CHECK(browser.is_shown("#stop-gently"));
  CHECK(browser.run("return document.querySelectorAll('#run-chart canvas').length > 0") == true);
  look_at(browser, "3_running");

  browser.open("about:blank");  // closing the page stops nothing
  CHECK(server.last_run().is_running);
  browser.open(server.address());
  browser.click("#stop-gently");
  REQUIRE(browser.wait_until("return !!document.getElementById('outcome-text')", 60));
  CHECK(contains(browser.text("#outcome-text"), "above the contact"));
  CHECK_FALSE(browser.is_shown("#stop-bar"));
  look_at(browser, "4_stopped");
  CHECK_FALSE(server.last_run().is_running);
  const CapturedRun run = read_capture(scratch / "series/01_pdms-1to10.viscap");
  CHECK(run.status == "interrupted");
  REQUIRE_FALSE(run.stage_reports.empty());
  double deepest_m = 0.0;
  for (const StageReport& report : run.stage_reports) {
    deepest_m = std::max(deepest_m, report.position_m);
  }
  CHECK(run.stage_reports.back().position_m < deepest_m - 0.4e-3);
  CHECK(browser.errors() == nlohmann::json::array());
}

TEST_CASE("names and messages that contain markup are shown as text", "[serve][slow]") {
  if (is_without_browser()) return;
  ScratchFolder scratch;
  RigServer server({.folder = scratch / "series", .is_emulated = true, .speed = 40.0});
  const std::string mark = "<img src=x onerror=document.title='taken'>";
  write_file(scratch / ("series/01_" + mark + ".toml"), "id = '" + mark + "'\n[" + mark + "\n",
             false);
  write_file(
      scratch / "series/test.toml",
      "name = \"" + mark + "\"\n[ramp]\ndepth = \"0.13 mm\"\nduration = \"1 s\"\nhold = \"60 s\"\n",
      false);
  Browser browser(scratch / "profile");
  browser.open(server.address());
  REQUIRE(browser.wait_until(
      "return document.getElementById('specimens').textContent.includes('onerror')", 20));
  REQUIRE(browser.wait_until(
      "return document.getElementById('plan-name').textContent.includes('onerror')", 20));
  CHECK(browser.run("return document.querySelectorAll('img').length") == 0);
  CHECK(browser.run("return document.title") == "viscard");
}

TEST_CASE("the rig is checked with lights, and its file is set up on the page", "[serve][slow]") {
  if (is_without_browser()) return;
  ScratchFolder scratch;
  const std::string before = read_file(VISCARD_SOURCE_DIR "/data/demo/01_rig.toml");
  write_file(scratch / "rig.toml", before, false);
  RigServer server({.folder = scratch / "series",
                    .rig_file = (scratch / "rig.toml").string(),
                    .is_emulated = true,
                    .speed = 40.0});
  Browser browser(scratch / "profile");
  browser.set_window(1280, 1000, false, false);
  browser.open(server.address());
  REQUIRE(
      browser.wait_until("return document.getElementById('link').textContent === 'connected'", 20));
  browser.click("#check");
  REQUIRE(browser.wait_until(
      "return document.querySelectorAll('#check-result .light').length === 4", 30));
  CHECK(browser.run("return document.querySelectorAll('#check-result .light.halt').length") == 0);
  browser.click("#setup summary");
  REQUIRE(browser.wait_until(
      "return document.getElementById('setup-text').value.includes('[stage]')", 20));
  CHECK(browser.run("return document.getElementById('setup-keep').disabled") == true);
  look_at(browser, "9_setup");
  const auto choose = [&](const std::string& id, const std::string& value) {
    browser.run("const s = document.getElementById('" + id + "'); s.value = '" + value +
                "'; s.dispatchEvent(new Event('change'));");
  };
  choose("setup-stage-driver", "zaber");
  REQUIRE(browser.wait_until("return !document.getElementById('setup-keep').disabled", 20));
  browser.click("#setup-keep");
  REQUIRE(browser.wait_until(
      "return document.getElementById('setup-kept').textContent.includes('rig.toml.1')", 20));
  CHECK(contains(read_file(scratch / "rig.toml"), "driver = \"zaber\""));
  CHECK(read_file(scratch / "rig.toml.1") == before);
  CHECK(browser.errors() == nlohmann::json::array());
  browser.type("#setup-text", "[stage");
  REQUIRE(browser.wait_until("return !document.getElementById('setup-trouble').hidden", 20));
  CHECK(browser.run("return document.getElementById('setup-keep').disabled") == true);
}

TEST_CASE("three specimens go through the page one after another, with the fit of each",
          "[serve][slow]") {
  if (is_without_browser()) return;
  ScratchFolder scratch;
  RigServer server({.folder = scratch / "series", .is_emulated = true, .speed = 40.0});
  Browser browser(scratch / "profile");
  browser.set_window(1280, 1000, false, false);
  browser.open(server.address());
  int number = 0;
  for (const char* ratio : {"10", "13", "20"}) {
    ++number;
    CAPTURE(ratio);
    const std::string name = "0" + std::to_string(number) + "_pdms-1to" + ratio;
    if (number > 1) browser.click("#add summary");
    browser.type("#add-id", std::string("pdms-1to") + ratio);
    browser.type("#add-mixing_ratio", ratio);
    browser.click("#add-submit");
    REQUIRE(browser.wait_until(
        "return document.getElementById('start').textContent === 'Start " + name + "'", 20));
    browser.click("#start");
    REQUIRE(browser.wait_until(
        "const s = document.getElementById('result-name').textContent; const t = "
        "document.getElementById('result-status').className; return s === '" +
            name + ".viscap' && t !== ''",
        90));
    CHECK(browser.text("#result-status") == "The fit describes the data.");
    CHECK(read_capture(scratch / ("series/" + name + ".viscap")).status == "finished");
    CHECK(std::filesystem::exists(scratch / ("series/" + name + ".json")));
  }
  look_at(browser, "5_result");
  // Escape stops a run.
  browser.type("#plan-hold_s", "600");
  browser.click("#start");
  REQUIRE(browser.wait_until("return document.body.classList.contains('running')", 20));
  browser.press_key("\uE00C");
  REQUIRE(
      browser.wait_until("const t = document.getElementById('outcome-text'); return !!t && "
                         "t.textContent.startsWith('Interrupted')",
                         30));
  CHECK(browser.errors() == nlohmann::json::array());
}

// Sets a field as a person does, who then leaves it.
void fill(Browser& browser, const std::string& selector, const std::string& value) {
  browser.run("const s = document.querySelector('" + selector +
              "'); s.value = " + nlohmann::json(value).dump() +
              "; s.dispatchEvent(new Event('input', {bubbles: true})); s.dispatchEvent(new "
              "Event('change', {bubbles: true}))");
}

bool has_text(Browser& browser, const std::string& selector, const std::string& text) {
  return browser.wait_until("const e = document.querySelector('" + selector +
                                "'); return !!e && e.textContent.includes(" +
                                nlohmann::json(text).dump() + ")",
                            30);
}

TEST_CASE("a jog, a calibration, another protocol and a note are done on the page alone",
          "[serve][slow]") {
  if (is_without_browser()) return;
  ScratchFolder scratch;
  RigServer server({.folder = scratch / "series", .is_emulated = true, .speed = 30.0});
  Browser browser(scratch / "profile");
  browser.set_window(1280, 1000, false, false);
  browser.open(server.address());
  REQUIRE(
      browser.wait_until("return document.getElementById('link').textContent === 'connected'", 20));

  browser.click("#hands summary");
  browser.click("#jog-steps label:nth-of-type(3) input");  // 200 um
  browser.click("#jog-away");
  REQUIRE(has_text(browser, "#jog-status", "Moved by 200"));
  browser.click("#jog-zero");
  browser.click("#jog-steps label:nth-of-type(4) input");
  for (int i = 0; i < 3; ++i) {  // the specimen lies 0.5 mm below
    browser.click("#jog-toward");
    REQUIRE(browser.wait_until("return !document.getElementById('jog-toward').disabled", 30));
    if (contains(browser.text("#jog-status"), "The force stopped")) break;
  }
  CHECK(contains(browser.text("#jog-status"), "The force stopped"));
  CHECK(contains(browser.text("#jog-position"), "from your zero"));
  browser.click("#calibrate summary");
  fill(browser, "#weigh-masses", "50, 100, 200");
  fill(browser, "#weigh-series", "2");
  for (int i = 0; i < 13; ++i) {
    REQUIRE(has_text(browser, "#weigh", "Weigh (" + std::to_string(i) + " of 13)"));
    REQUIRE(browser.wait_until("return !document.getElementById('weigh').disabled", 30));
    browser.click("#weigh");
    if (i != 6) continue;
    REQUIRE(has_text(browser, "#weigh", "Weigh (7 of 13)"));
    browser.click("#weigh-back");
    REQUIRE(has_text(browser, "#weigh", "Weigh (6 of 13)"));
    browser.click("#weigh");
  }
  REQUIRE(has_text(browser, "#weigh-next", "All weights are done"));
  look_at(browser, "6_hands");
  browser.click("#weigh-make");
  REQUIRE(has_text(browser, "#weigh-status", "V/N"));

  browser.click("#add-submit");
  REQUIRE(browser.wait_until("return !document.getElementById('start').disabled", 20));
  browser.click("#protocol summary");
  REQUIRE(browser.wait_until(
      "return document.querySelectorAll('#protocol-example option').length > 5", 20));
  fill(browser, "#protocol-example", "cycles");
  REQUIRE(browser.wait_until("return !document.getElementById('protocol-keep').disabled", 20));
  look_at(browser, "7_protocol");
  browser.click("#protocol-keep");
  REQUIRE(has_text(browser, "#plan-fixed", "cycles"));
  REQUIRE(browser.wait_until("return !document.getElementById('start').disabled", 20));
  browser.click("#start");
  REQUIRE(has_text(browser, "#result-name", ".viscap"));
  REQUIRE(browser.wait_until("return !document.body.classList.contains('running')", 60));
  browser.click("td.state button[aria-label^=Note]");
  browser.run(
      "const i = document.querySelector('td.state input'); i.value = 'wet surface'; i.blur()");
  REQUIRE(has_text(browser, "td.state", "wet surface"));
  look_at(browser, "8_note");
  CHECK(browser.errors() == nlohmann::json::array());
}

// Where a cursor is, as its slider states it.
double cursor_of(Browser& browser, const std::string& chart, int place) {
  return browser
      .run("return Number(document.querySelectorAll('" + chart + " ~ .cursor')[" +
           std::to_string(place) + "].getAttribute('aria-valuenow'))")
      .get<double>();
}

TEST_CASE(
    "captures lie over one another with cursors, switched on and off, with fits, and as a table",
    "[serve][slow]") {
  if (is_without_browser()) return;
  test::ServedRig rig;
  const std::string first = rig.prepare();
  test::Json other = test::ServedRig::specimen();
  other["id"] = "PDMS 1:20";
  other["mixing_ratio"] = 20.0;
  const std::string second = rig.order("/api/specimens", {{"specimen", other}}).json.at("name");
  for (const std::string& name : {first, second, first}) {
    REQUIRE(rig.order("/api/run", {{"specimen", name}, {"repeat", true}}).status == 200);
    REQUIRE(rig.wait_for_end().at("outcome").at("status") == "finished");
  }
  ScratchFolder scratch;
  Browser browser(scratch / "profile");
  browser.set_window(1280, 1000, false, false);
  browser.open(rig.server().address());
  browser.click("#captures-open summary");
  for (const char* color : {"series-2", "series-3"}) {  // the repeat lies upon the first
    CAPTURE(color);
    REQUIRE(browser.wait_until(test::has_line("#captures-chart", color), 30));
  }
  CHECK(browser.errors() == nlohmann::json::array());

  const std::string chart = "#captures-chart", a = chart + " ~ .cursor:nth-of-type(2)";
  browser.click(chart + " ~ .chart-bar button:first-child");
  REQUIRE(test::shows(browser, chart + " ~ .cursor-values", "B / A"));
  CHECK(browser.run("return document.querySelectorAll('" + chart +
                    " ~ .cursor-values tbody tr').length") == 4);  // time and three captures
  const double begin_s = cursor_of(browser, chart, 0), width_s = cursor_of(browser, chart, 1);
  CHECK(begin_s < width_s);
  // The keyboard.
  browser.run("document.querySelector('" + a + "').focus()");
  browser.press_key("\uE014");
  const double moved_s = cursor_of(browser, chart, 0);
  CHECK(moved_s > begin_s);
  CHECK(contains(browser.run("return document.activeElement.getAttribute('aria-valuetext')")
                     .get<std::string>(),
                 first + " data"));
  browser.press_key("\uE012");
  CHECK(cursor_of(browser, chart, 0) == Approx(begin_s).margin(1e-4));
  // The mouse, then a finger.
  const auto drag_a = [&](double by_px, bool is_touch) {
    browser.run("document.querySelector('" + chart + "').scrollIntoView({block: 'center'})");
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    const nlohmann::json place =
        browser.run("const r = document.querySelector('" + a +
                    " b').getBoundingClientRect(); return [r.left + r.width / 2, r.top + 12]");
    browser.drag(place.at(0), place.at(1), by_px, is_touch);
  };
  drag_a(-100.0, false);
  CHECK(cursor_of(browser, chart, 0) < begin_s);
  CHECK(browser.run("return document.querySelector('" + chart + " canvas') !== null") == true);
  const double dragged_s = cursor_of(browser, chart, 0);
  look_at(browser, "10_overlay", "#captures");
  browser.set_window(390, 844, false, true);
  drag_a(60.0, true);
  CHECK(browser.wait_until("return Number(document.querySelector('" + a +
                               "').getAttribute('aria-valuenow')) > " + std::to_string(dragged_s),
                           10));
  browser.set_window(1280, 1000, false, false);

  browser.click("#captures-list label:nth-child(2) input");  // of the repeat
  REQUIRE(browser.wait_until(
      "return document.querySelectorAll('" + chart + " ~ .cursor-values tbody tr').length === 3",
      20));
  CHECK_FALSE(browser.wait_until(test::has_line(chart, "series-2"), 1));
  CHECK(browser.wait_until(test::has_line(chart, "series-1"), 10));
  CHECK(browser.wait_until(test::has_line(chart, "series-3"), 10));  // it keeps its colour
  browser.click("#captures-fit");
  REQUIRE(test::shows(browser, "#captures-moduli", "MPa"));
  CHECK(browser.run("return document.querySelectorAll('#captures-moduli thead th').length") == 3);
  CHECK_FALSE(std::filesystem::exists(rig.folder() / (first + ".json")));  // only to look at
  browser.click("#captures-log-x");
  browser.click("#captures-relative");
  REQUIRE(test::shows(browser, "#captures-chart .dygraph-ylabel", "relative value"));
  look_at(browser, "11_overlay_fits", "#captures");

  browser.run(test::kKeepDownloads);
  browser.click(chart + " ~ .chart-bar button:nth-child(2)");
  REQUIRE(browser.wait_until("return window.saved.length === 1", 10));
  const nlohmann::json saved = browser.run("return window.saved[0]");
  CHECK(saved.at(0) == "captures.csv");
  CHECK(contains(saved.at(1), "time (s)," + first + " data," + first + " fit," + second));
  browser.click("td.state button[aria-label^=Write]");
  REQUIRE(test::shows(browser, "#series-done", first + ".csv"));
  CHECK(contains(read_file(rig.folder() / (first + ".csv")), "force_N"));
  // The chart of one capture has the same cursors.
  browser.click("td.state button[aria-label^=Fit]");
  REQUIRE(browser.wait_until(test::has_line("#fit-chart", "fit"), 30));
  browser.click("#fit-chart ~ .chart-bar button:first-child");
  REQUIRE(test::shows(browser, "#fit-chart ~ .cursor-values", "measured (N)"));
  look_at(browser, "12_cursors", "#result");
  CHECK(browser.errors() == nlohmann::json::array());
}

}  // namespace
}  // namespace viscard
