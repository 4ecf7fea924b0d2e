#include "tests/io/serve/browser.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <httplib.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <thread>

namespace viscard::test {
namespace {

using nlohmann::json;

constexpr const char* kDriver = "/usr/bin/chromedriver";
constexpr const char* kBrowser = "/usr/bin/chromium";
constexpr const char* kElement = "element-6066-11e4-a52e-4f735466cecf";  // W3C WebDriver, 12.1
constexpr std::chrono::milliseconds kPoll{50};
constexpr double kLongest_s = 20.0;

int free_port() {
  const int descriptor = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  if (::bind(descriptor, reinterpret_cast<sockaddr*>(&address), size) != 0) {
    throw std::runtime_error("no port of this computer is free");
  }
  ::getsockname(descriptor, reinterpret_cast<sockaddr*>(&address), &size);
  ::close(descriptor);
  return ntohs(address.sin_port);
}

std::string bytes_from_base64(const std::string& text) {
  static const std::string kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0;
  int n_bits = 0;
  for (const char c : text) {
    const std::size_t digit = kDigits.find(c);
    if (digit == std::string::npos) continue;
    bits = bits << 6 | static_cast<unsigned>(digit);
    n_bits += 6;
    if (n_bits < 8) continue;
    n_bits -= 8;
    bytes += static_cast<char>(bits >> n_bits & 0xffu);
  }
  return bytes;
}

// Repeats until true is returned or the time is over.
bool wait(const std::function<bool()>& is_met, double seconds) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (!is_met()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(kPoll);
  }
  return true;
}

}  // namespace

// The process of chromedriver and a connection to it.
class Browser::Driver {
 public:
  Driver() : port_(free_port()), client_("127.0.0.1", port_) {
    client_.set_read_timeout(60);
    const std::string port = "--port=" + std::to_string(port_);
    process_ = ::fork();
    if (process_ == 0) {
      ::setpgid(0, 0);
      const int nowhere = ::open("/dev/null", O_WRONLY);
      ::dup2(nowhere, STDOUT_FILENO);
      ::dup2(nowhere, STDERR_FILENO);
      ::execl(kDriver, kDriver, port.c_str(), static_cast<char*>(nullptr));
      _exit(99);
    }
    const bool is_up = wait(
        [this] {
          const auto result = client_.Get("/status");
          return result && result->status == 200;
        },
        kLongest_s);
    if (!is_up) throw std::runtime_error("chromedriver does not answer");
  }
  ~Driver() {
    ::kill(process_, SIGTERM);
    ::waitpid(process_, nullptr, 0);
  }
  Driver(const Driver&) = delete;
  Driver& operator=(const Driver&) = delete;

  httplib::Client& client() { return client_; }

 private:
  int port_;
  httplib::Client client_;
  pid_t process_ = -1;
};

std::string Browser::missing() {
  for (const char* program : {kBrowser, kDriver}) {
    if (::access(program, X_OK) != 0) {
      return std::string(program) +
             " is not installed; ./run test --slow installs chromium and chromium-driver";
    }
  }
  return "";
}

Browser::Browser(const std::filesystem::path& profile) : driver_(std::make_unique<Driver>()) {
  json arguments = {"--headless=new", "--disable-gpu", "--no-first-run", "--disable-dev-shm-usage",
                    "--user-data-dir=" + profile.string()};
  if (::geteuid() == 0) arguments.push_back("--no-sandbox");  // Chromium refuses it for root
  const json options = {{"binary", kBrowser}, {"args", arguments}};
  const json wanted = {{"browserName", "chrome"},
                       {"goog:chromeOptions", options},
                       {"goog:loggingPrefs", {{"browser", "ALL"}}}};
  session_ = "/session";
  const json begun = ask("POST", "", {{"capabilities", {{"alwaysMatch", wanted}}}});
  session_ += "/" + begun.at("sessionId").get<std::string>();
}

Browser::~Browser() {
  driver_->client().Delete(session_);
}

json Browser::ask(const char* method, const std::string& path, const json& body) {
  httplib::Client& client = driver_->client();
  const auto result = std::string(method) == "GET"
                          ? client.Get(session_ + path)
                          : client.Post(session_ + path, body.dump(), "application/json");
  if (!result) throw std::runtime_error("chromedriver does not answer to " + path);
  json value = json::parse(result->body).at("value");
  if (result->status == 200) return value;
  throw std::runtime_error(path + ": " + value.value("message", result->body));
}

std::string Browser::find(const std::string& selector) {
  std::string id;
  const auto is_found = [&] {
    const json found = ask("POST", "/elements", {{"using", "css selector"}, {"value", selector}});
    if (found.empty()) return false;
    id = found.at(0).at(kElement);
    return true;
  };
  if (!wait(is_found, kLongest_s)) throw std::runtime_error("no element " + selector);
  return id;
}

void Browser::open(const std::string& address) {
  ask("POST", "/url", {{"url", address}});
}

void Browser::click(const std::string& selector) {
  if (!wait_until("const e = document.querySelector('" + selector +
                      "'); return !!e && !e.disabled && e.getClientRects().length > 0",
                  kLongest_s)) {
    throw std::runtime_error(selector + " cannot be pressed");
  }
  ask("POST", "/element/" + find(selector) + "/click", json::object());
}

void Browser::type(const std::string& selector, const std::string& text) {
  const std::string element = "/element/" + find(selector);
  ask("POST", element + "/clear", json::object());
  ask("POST", element + "/value", {{"text", text}});
}

std::string Browser::text(const std::string& selector) {
  return ask("GET", "/element/" + find(selector) + "/text", {});
}

bool Browser::is_shown(const std::string& selector) {
  return ask("GET", "/element/" + find(selector) + "/displayed", {});
}

void Browser::press_key(const std::string& key) {
  const json keys = {{{"type", "keyDown"}, {"value", key}}, {{"type", "keyUp"}, {"value", key}}};
  ask("POST", "/actions", {{"actions", {{{"type", "key"}, {"id", "keys"}, {"actions", keys}}}}});
}

void Browser::drag(double x_px, double y_px, double by_px, bool is_touch) {
  json steps = json::array();
  const auto move = [&](double share) {
    const auto x = static_cast<int>(std::lround(x_px + share * by_px));
    const auto y = static_cast<int>(std::lround(y_px));
    steps.push_back({{"type", "pointerMove"}, {"duration", 30}, {"x", x}, {"y", y}});
  };
  move(0.0);
  steps.push_back({{"type", "pointerDown"}, {"button", 0}});
  for (const double share : {0.2, 0.4, 0.6, 0.8, 1.0}) move(share);
  steps.push_back({{"type", "pointerUp"}, {"button", 0}});
  json pointer{{"type", "pointer"}, {"id", is_touch ? "finger" : "mouse"}};
  pointer["parameters"] = {{"pointerType", is_touch ? "touch" : "mouse"}};
  pointer["actions"] = steps;
  json all;
  all["actions"] = json::array();
  all["actions"].push_back(pointer);
  ask("POST", "/actions", all);
}

json Browser::run(const std::string& script) {
  return ask("POST", "/execute/sync", {{"script", script}, {"args", json::array()}});
}

bool Browser::wait_until(const std::string& script, double seconds) {
  return wait([&] { return run(script) == json(true); }, seconds);
}

void Browser::set_window(int width_px, int height_px, bool is_dark, bool is_phone) {
  const auto tell = [&](const char* command, const json& parameters) {
    ask("POST", "/goog/cdp/execute", {{"cmd", command}, {"params", parameters}});
  };
  tell(
      "Emulation.setDeviceMetricsOverride",
      {{"width", width_px}, {"height", height_px}, {"deviceScaleFactor", 1}, {"mobile", is_phone}});
  tell("Emulation.setTouchEmulationEnabled", {{"enabled", is_phone}});
  tell("Emulation.setEmulatedMedia",
       {{"features", {{{"name", "prefers-color-scheme"}, {"value", is_dark ? "dark" : "light"}}}}});
}

nlohmann::json Browser::accessibility_faults() {
  std::ifstream file(VISCARD_SOURCE_DIR "/tests/io/serve/accessibility.js");
  return run({std::istreambuf_iterator<char>(file), {}});
}

void Browser::save_screenshot(const std::filesystem::path& png) {
  std::ofstream(png, std::ios::binary)
      << bytes_from_base64(ask("GET", "/screenshot", {}).get<std::string>());
}

json Browser::errors() {
  json severe = json::array();
  for (const json& entry : ask("POST", "/se/log", {{"type", "browser"}})) {
    if (entry.value("level", "") == "SEVERE") severe.push_back(entry.value("message", ""));
  }
  return severe;
}

}  // namespace viscard::test
