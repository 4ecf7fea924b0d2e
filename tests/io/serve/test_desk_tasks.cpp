// Five tasks of the desk, each by a newcomer, with the clicks counted.
#include "tests/io/serve/desk_person.h"
#include "tests/io/serve/served_desk.h"

#include <catch2/catch.hpp>

namespace viscard {
namespace {

using namespace test;  // of the browser

constexpr int kMostClicks = 6;

void wait_for_rows(Browser& browser, int tables) {
  REQUIRE(browser.wait_until(
      "return document.querySelectorAll('#tables li').length === " + std::to_string(tables) +
          " && document.querySelectorAll('#rows tbody tr').length > 10",
      20));
}

int card_of_own_table(Browser& browser, bool may_scroll) {
  Person person(browser, may_scroll);
  drop_on_page(browser, "stiff.csv", ServedDesk::example());
  wait_for_rows(browser, 1);
  person.click("#tab-card");
  person.choose("#target", "abaqus");
  person.click("#units input[value=mm-t-s]");
  REQUIRE(shows(browser, "#card-text", "mm-t-s"));
  const auto before = browser.run("return window.saved.length").get<int>();
  person.click("#download");
  REQUIRE(browser.wait_until("return window.saved.length === " + std::to_string(before + 1), 10));
  return person.n_clicks;
}

int two_specimens(Browser& browser, bool may_scroll) {
  Person person(browser, may_scroll);
  drop_on_page(browser, "soft.csv", ServedDesk::example(0.5));
  wait_for_rows(browser, 2);
  person.click("#tab-compare");
  REQUIRE(shows(browser, "#compare-moduli", "soft.csv"));
  REQUIRE(shows(browser, "#compare-moduli", "stiff.csv"));
  REQUIRE(shows(browser, "#compare-moduli", "940"));  // kPa
  return person.n_clicks;
}

int master_curve(Browser& browser, bool may_scroll) {
  Person person(browser, may_scroll);
  drop_on_page(browser, "warm.csv", ServedDesk::isotherms());
  wait_for_rows(browser, 3);
  person.click("#tab-fit");
  REQUIRE(shows(browser, "#fit-shift", "(reference)"));
  REQUIRE(shows(browser, "#fit-shift", "30 °C"));
  return person.n_clicks;
}

int card_of_somebody(Browser& browser, bool may_scroll) {
  Person person(browser, may_scroll);
  person.click("#tab-check");
  set_field(browser, "#check-text",
            "*MATERIAL, NAME=PDMS\n*ELASTIC, MODULI=INSTANTANEOUS\n1.88e6, 0.495\n"
            "*VISCOELASTIC, TIME=PRONY\n0.1, 0.1, 0.2\n");
  set_field(browser, "#check-target", "abaqus");
  ++person.n_clicks;  // the target from its list
  REQUIRE(shows(browser, "#check-meaning", "g 0.1 at 0.2 s"));
  return person.n_clicks;
}

int voltage_of_a_pillar(Browser& browser, bool may_scroll) {
  Person person(browser, may_scroll);
  person.click("#tab-scene");
  REQUIRE(browser.wait_until("return document.querySelectorAll('#scene-example option').length > 5",
                             20));
  person.choose("#scene-example", "pillar_press.toml");
  REQUIRE(shows(browser, "#scene-effects", "film compliance"));
  person.click("#scene-cost");
  REQUIRE(browser.wait_until("return document.querySelectorAll('#scene-choices button').length > 0",
                             60));
  browser.click("#scene-choices button:last-child");
  ++person.n_clicks;
  REQUIRE(shows(browser, "#scene-results", "electrode voltage"));
  REQUIRE(shows(browser, "#scene-results", "±"));
  return person.n_clicks;
}

TEST_CASE("five tasks take a newcomer at most six clicks each, wide and narrow, light and dark",
          "[desk][slow]") {
  if (has_no_browser()) return;
  const auto [width_px, is_dark] = GENERATE(std::pair(1280, false), std::pair(1280, true),
                                            std::pair(390, false), std::pair(390, true));
  const bool is_phone = width_px < 600;
  CAPTURE(width_px, is_dark);
  ServedDesk desk;
  ScratchFolder scratch;
  Browser browser(scratch / "profile");
  browser.set_window(width_px, is_phone ? 844 : 800, is_dark, is_phone);
  browser.open(desk.server().address());
  REQUIRE(
      browser.wait_until("return document.getElementById('link').textContent === 'connected'", 20));
  browser.run(kKeepDownloads);
  struct Task {
    const char* what;
    int (*run)(Browser&, bool may_scroll);
  };
  std::cout << width_px << " px, " << (is_dark ? "dark" : "light") << ":";
  for (const Task& task :
       {Task{"own table to an Abaqus card", card_of_own_table},
        Task{"two specimens compared", two_specimens}, Task{"master curve", master_curve},
        Task{"a card that somebody sent", card_of_somebody},
        Task{"voltage of a pillar with its cost", voltage_of_a_pillar}}) {
    CAPTURE(task.what);
    const int n_clicks = task.run(browser, is_phone);
    std::cout << " " << task.what << " " << n_clicks << ";";
    CHECK(n_clicks <= kMostClicks);
    CHECK(browser.run("return document.documentElement.scrollWidth <= innerWidth").get<bool>());
    CHECK(browser.accessibility_faults() == nlohmann::json::array());
  }
  std::cout << " clicks\n";
  CHECK(browser.errors() == nlohmann::json::array());
}

}  // namespace
}  // namespace viscard
