#pragma once

#include <nlohmann/json.hpp>
#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

namespace viscard::test {

// Chromium without a window, driven by chromedriver (W3C WebDriver: JSON over HTTP).
class Browser {
 public:
  // Why there is no browser on this machine, or "".
  static std::string missing();

  // profile: an empty folder. Throws std::runtime_error if the driver does not start.
  explicit Browser(const std::filesystem::path& profile);
  ~Browser();
  Browser(const Browser&) = delete;
  Browser& operator=(const Browser&) = delete;

  void open(const std::string& address);
  // Each waits up to 20 s for the element. Throws std::runtime_error naming the selector.
  void click(const std::string& selector);
  void type(const std::string& selector, const std::string& text);  // replaces what is there
  std::string text(const std::string& selector);
  bool is_shown(const std::string& selector);
  void press_key(const std::string& key);
  // With the mouse, or a finger, from a place of the window sideways.
  void drag(double x_px, double y_px, double by_px, bool is_touch);

  // The value of a script "return ...".
  nlohmann::json run(const std::string& script);
  // Repeats the script until it returns true; false after the time.
  bool wait_until(const std::string& script, double seconds);

  void set_window(int width_px, int height_px, bool is_dark, bool is_phone);
  // Faults of the page as it is shown, by WCAG 2.2 (accessibility.js), as sentences.
  nlohmann::json accessibility_faults();
  void save_screenshot(const std::filesystem::path& png);
  // Messages of the page's console that report errors.
  nlohmann::json errors();

 private:
  nlohmann::json ask(const char* method, const std::string& path, const nlohmann::json& body);
  std::string find(const std::string& selector);

  class Driver;
  std::unique_ptr<Driver> driver_;
  std::string session_;
};

}  // namespace viscard::test
