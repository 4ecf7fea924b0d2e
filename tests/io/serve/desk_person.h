#pragma once

#include "tests/io/serve/browser.h"

#include <catch2/catch.hpp>

#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <string>
#include <thread>

namespace viscard::test {

// What a person does at the desk in a browser.

inline bool has_no_browser() {
  const std::string missing = Browser::missing();
  if (!missing.empty()) std::cout << "skipped: " << missing << "\n";
  return !missing.empty();
}

// The page, light and dark, wide and narrow, has no fault of accessibility. With VISCARD_SCREENSHOTS=FOLDER the
// test leaves pictures of it there.
inline void look_at_desk(Browser& browser, const std::string& name) {
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

// Clicks as a person does: on a wide screen only what is seen without scrolling.
class Person {
 public:
  explicit Person(Browser& browser, bool may_scroll = false)
      : browser_(browser), may_scroll_(may_scroll) {}
  void click(const std::string& selector) {
    CAPTURE(selector);
    CHECK(
        (may_scroll_ ||
         browser_.wait_until("const r = document.querySelector('" + selector +
                                 "').getBoundingClientRect(); return r.height > 0 && r.top >= 0 && "
                                 "r.bottom <= innerHeight && r.left >= 0 && r.right <= innerWidth",
                             10)));
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
  bool may_scroll_;
};

// Drops a file with these contents onto the page, as a file manager does.
inline void drop_on_page(Browser& browser, const std::string& name, const std::string& text) {
  browser.run("const d = new DataTransfer(); d.items.add(new File([" + nlohmann::json(text).dump() +
              "], '" + name +
              "')); document.body.dispatchEvent(new DragEvent('drop', {dataTransfer: d, bubbles: "
              "true, cancelable: true}))");
}

// Keeps what the page offers for download.
inline constexpr const char* kKeepDownloads =
    "window.saved = []; const make = URL.createObjectURL; let text = null; URL.createObjectURL = "
    "(blob) => { "
    "text = blob.text(); return make(blob); }; HTMLAnchorElement.prototype.click = function () { "
    "const name = "
    "this.download; text.then(t => window.saved.push([name, t])); }";

// True once a chart shows a line in this colour of the page.
inline std::string has_line(const std::string& chart, const std::string& color) {
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

// The place in the window, [x, y], where a chart shows the first point in this colour of the page; null: nowhere.
inline std::string place_of_color(const std::string& chart, const std::string& color) {
  return "const c = document.querySelector('" + chart +
         " canvas'), probe = document.createElement('canvas').getContext('2d'); probe.fillStyle = "
         "getComputedStyle(document.documentElement).getPropertyValue('--" +
         color +
         "').trim(); probe.fillRect(0, 0, 1, 1); const want = probe.getImageData(0, 0, 1, 1).data, "
         "d = c.getContext('2d').getImageData(0, 0, c.width, c.height).data, box = "
         "c.getBoundingClientRect(); for (let i = 0; i < d.length; i += 4) if (d[i] === want[0] && "
         "d[i + 1] === want[1] && d[i + 2] === want[2] && d[i + 3] > 200) return [box.left + (i / "
         "4) "
         "% c.width * box.width / c.width, box.top + Math.floor(i / 4 / c.width) * box.height / "
         "c.height]; return null";
}

// Sets a field as a person does, who then leaves it.
inline void set_field(Browser& browser, const std::string& selector, const std::string& value) {
  browser.run("const s = document.querySelector('" + selector +
              "'); s.value = " + nlohmann::json(value).dump() +
              "; s.dispatchEvent(new Event('input', {bubbles: true})); s.dispatchEvent(new "
              "Event('change', {bubbles: true}))");
}

inline bool shows(Browser& browser, const std::string& selector, const std::string& text) {
  return browser.wait_until(
      "const e = document.querySelector('" + selector +
          "'); return !!e && e.getClientRects().length > 0 && e.textContent.includes(" +
          nlohmann::json(text).dump() + ")",
      30);
}

}  // namespace viscard::test
