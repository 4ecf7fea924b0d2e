// The desk in Chromium: from a table to a card, with the clicks counted.
#include "tests/io/serve/browser.h"
#include "tests/io/serve/served_desk.h"
#include "tests/support/error_text.h"

#include <catch2/catch.hpp>

#include <cstdlib>
#include <iostream>

namespace viscard {
namespace {

using test::Browser;
using test::contains;
using test::ScratchFolder;
using test::ServedDesk;

bool has_no_browser() {
  const std::string missing = Browser::missing();
  if (!missing.empty()) std::cout << "skipped: " << missing << "\n";
  return !missing.empty();
}

// The page, light and dark, wide and narrow, has no fault of accessibility. With VISCARD_SCREENSHOTS=FOLDER the
// test leaves pictures of it there.
void look_at_desk(Browser& browser, const std::string& name) {
  const char* folder = std::getenv("VISCARD_SCREENSHOTS");
  for (const auto& [ending, width, height, is_dark, is_phone] :
       {std::tuple("light", 1280, 800, false, false), std::tuple("dark", 1280, 800, true, false),
        std::tuple("phone", 390, 1600, false, true)}) {
    browser.set_window(width, height, is_dark, is_phone);
    std::this_thread::sleep_for(std::chrono::milliseconds(700));
    CAPTURE(name, ending);
    CHECK(browser.accessibility_faults() == nlohmann::json::array());
    if (folder == nullptr) continue;
    browser.save_screenshot(std::filesystem::path(folder) / (name + "_" + ending + ".png"));
  }
  browser.set_window(1280, 800, false, false);
}

// Clicks as a person does: only what is seen without scrolling.
class Person {
 public:
  explicit Person(Browser& browser) : browser_(browser) {}
  void click(const std::string& selector) {
    CAPTURE(selector);
    CHECK(
        browser_.wait_until("const r = document.querySelector('" + selector +
                                "').getBoundingClientRect(); return r.height > 0 && r.top >= 0 && "
                                "r.bottom <= innerHeight && r.left >= 0 && r.right <= innerWidth",
                            10));
    browser_.click(selector);
    ++n_clicks;
  }
  // Of a list: the click that opens it and one on the entry.
  void choose(const std::string& list, const std::string& value) {
    click(list);
    browser_.press_key("\uE00C");  // Escape closes what a browser without a window draws elsewhere
    browser_.run("const s = document.querySelector('" + list + "'); s.value = '" + value +
                 "'; s.dispatchEvent(new Event('change', {bubbles: true}))");
    ++n_clicks;
  }
  int n_clicks = 0;

 private:
  Browser& browser_;
};

// Drops a file with these contents onto the page, as a file manager does.
void drop_on_page(Browser& browser, const std::string& name, const std::string& text) {
  browser.run("const d = new DataTransfer(); d.items.add(new File([" + nlohmann::json(text).dump() +
              "], '" + name +
              "')); document.body.dispatchEvent(new DragEvent('drop', {dataTransfer: d, bubbles: "
              "true, cancelable: true}))");
}

// Keeps what the page offers for download.
constexpr const char* kKeepDownloads =
    "window.saved = []; const make = URL.createObjectURL; let text = null; URL.createObjectURL = "
    "(blob) => { "
    "text = blob.text(); return make(blob); }; HTMLAnchorElement.prototype.click = function () { "
    "const name = "
    "this.download; text.then(t => window.saved.push([name, t])); }";

// True once a chart shows a line in this colour of the page.
std::string has_line(const std::string& chart, const std::string& color) {
  return "const c = document.querySelector('" + chart +
         " canvas'); if (!c) return false; const probe = "
         "document.createElement('canvas').getContext('2d'); "
         "probe.fillStyle = getComputedStyle(document.documentElement).getPropertyValue('--" +
         color +
         "').trim(); probe.fillRect(0, 0, 1, 1); const want = probe.getImageData(0, 0, 1, 1).data; "
         "const d = "
         "c.getContext('2d').getImageData(0, 0, c.width, c.height).data; let n = 0; for (let i = "
         "0; i < d.length; "
         "i += 4) if (d[i] === want[0] && d[i + 1] === want[1] && d[i + 2] === want[2] && d[i + 3] "
         "> 200) ++n; "
         "return n > 100";
}

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
  look_at_desk(browser, "desk_fit");
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

// Sets a field as a person does, who then leaves it.
void set_field(Browser& browser, const std::string& selector, const std::string& value) {
  browser.run("const s = document.querySelector('" + selector +
              "'); s.value = " + nlohmann::json(value).dump() +
              "; s.dispatchEvent(new Event('input', {bubbles: true})); s.dispatchEvent(new "
              "Event('change', {bubbles: true}))");
}

bool shows(Browser& browser, const std::string& selector, const std::string& text) {
  return browser.wait_until(
      "const e = document.querySelector('" + selector +
          "'); return !!e && e.getClientRects().length > 0 && e.textContent.includes(" +
          nlohmann::json(text).dump() + ")",
      30);
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
  look_at_desk(browser, "desk_predict");
  browser.click("#tab-compare");
  browser.click("#compare-tables label:nth-child(2) input");
  REQUIRE(browser.wait_until(has_line("#compare-chart", "series-2"), 30));
  CHECK(shows(browser, "#compare-moduli", "b.csv"));
  look_at_desk(browser, "desk_compare");
  browser.click("#compare-tables label:nth-child(1) input");
  browser.click("#compare-tables label:nth-child(3) input");
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
  const auto card = desk.order("card", {{"table", "b.csv"}, {"card", {{"for", "abaqus"}}}});
  browser.click("#tab-check");
  set_field(browser, "#check-text", card.json.at("result").at("card"));
  REQUIRE(shows(browser, "#check-status", "No mistake"));
  set_field(browser, "#check-text",
            "*MATERIAL, NAME=x\n*ELASTIC, MODULI=INSTANTANEOUS\n1.88e6, abc\n");
  set_field(browser, "#check-target", "abaqus");
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
  REQUIRE(browser.wait_until("return document.querySelectorAll('#scene-choices button').length > 2",
                             60));
  look_at_desk(browser, "desk_cost");
  browser.click("#scene-choices button:last-child");
  REQUIRE(shows(browser, "#scene-results", "electrode voltage"));
  CHECK(shows(browser, "#scene-results", "±"));
  CHECK(browser.wait_until("return document.querySelectorAll('#scene-pictures img').length >= 3",
                           10));
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
  look_at_desk(browser, "desk_report");
  CHECK(std::filesystem::exists(desk.folder() / "report.html"));
  const nlohmann::json errors = browser.errors();
  INFO(errors.dump());
  CHECK(errors.empty());
}

}  // namespace
}  // namespace viscard
