#pragma once

#include "io/basics/atomic_file.h"
#include "io/serve/desk_server.h"
#include "tests/io/serve/served_rig.h"
#include "tests/support/scratch_folder.h"

#include <httplib.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <sstream>
#include <string>

namespace viscard::test {

// viscard desk on a folder of its own, and a client that has its token. Its commands are those of the built program.
class ServedDesk {
 public:
  explicit ServedDesk(const ChildLimits& limits = {})
      : server_({.folder = scratch_ / "tables", .program = VISCARD_PROGRAM, .limits = limits}),
        client_("127.0.0.1", server_.port()) {
    client_.set_read_timeout(120);
    client_.set_default_headers({{"X-Viscard-Token", server_.token()}});
  }

  DeskServer& server() { return server_; }
  httplib::Client& client() { return client_; }
  std::filesystem::path folder() const { return scratch_ / "tables"; }

  ApiAnswer ask(const std::string& path) { return answer_of(client_.Get(path)); }
  ApiAnswer order(const std::string& what, const Json& body) {
    return answer_of(client_.Post("/api/desk/" + what, body.dump(), "application/json"));
  }
  ApiAnswer drop(const std::string& name, const std::string& bytes) {
    const std::string path = "/api/desk/drop?name=" + httplib::detail::encode_query_param(name);
    return answer_of(client_.Post(path, bytes, "application/octet-stream"));
  }
  // The example that comes with viscard, of a material that is stiffer by the factor.
  static std::string example(double factor = 1.0) {
    const std::string text = read_file(VISCARD_SOURCE_DIR "/data/demo/example_relaxation.csv");
    std::istringstream lines(text);
    std::string scaled;
    for (std::string line; std::getline(lines, line);) {
      const std::size_t comma = line.find(',');
      const bool is_row = comma != std::string::npos && line.front() >= '0' && line.front() <= '9';
      scaled += is_row ? line.substr(0, comma + 1) +
                             std::to_string(factor * std::stod(line.substr(comma + 1)))
                       : line;
      scaled += '\n';
    }
    return factor == 1.0 ? text : scaled;
  }
  // The example without a header, which is read only by --column.
  static std::string without_header() {
    const std::string text = example();
    return text.substr(text.find("\n0.01,") + 1);
  }
  // Stresses of a rubber over stretch, in one deformation.
  static std::string rubber(bool is_planar = false) {
    std::string text = "stretch,nominal stress [MPa]\n";
    for (int i = 1; i <= 30; ++i) {
      const double stretch = 1.0 + 0.05 * i, scatter = 1.0 + 0.01 * std::sin(7.0 * i);
      const double released = is_planar ? std::pow(stretch, -3) : std::pow(stretch, -2);
      text += std::to_string(stretch) + "," + std::to_string(0.4 * scatter * (stretch - released)) +
              "\n";
    }
    return text;
  }
  // True if a shell in the folder carries out these lines, as a person copies them.
  bool runs(const std::string& lines) const {
    const std::filesystem::path programs = std::filesystem::path(VISCARD_PROGRAM).parent_path();
    const std::string script = "exec >/dev/null\nset -e\ncd '" + folder().string() + "'\nPATH='" +
                               programs.string() + "':$PATH\n" + lines + "\n";
    return std::system(script.c_str()) == 0;
  }
  // Relaxation at 10, 20 and 30 degC, each a decade slower than the warmer one.
  static std::string isotherms() {
    std::string text = "time_s,modulus_Pa,temperature_C\n";
    for (int k = 0; k < 3; ++k) {
      for (int i = 0; i <= 40; ++i) {
        const double t_s = std::pow(10.0, i / 20.0), reduced_s = t_s * std::pow(10.0, k);
        const double E_Pa =
            1e6 * (0.4 + 0.3 * std::exp(-reduced_s / 30.0) + 0.3 * std::exp(-reduced_s / 1000.0));
        text += std::to_string(t_s) + "," + std::to_string(E_Pa) + "," +
                std::to_string(10 + 10 * k) + "\n";
      }
    }
    return text;
  }

 private:
  static ApiAnswer answer_of(const httplib::Result& result) {
    if (!result) return {};
    return {result->status, Json::parse(result->body, nullptr, false)};
  }

  ScratchFolder scratch_;
  DeskServer server_;
  httplib::Client client_;
};

inline std::set<std::string> names_in(const std::filesystem::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    names.insert(entry.path().filename());
  return names;
}

}  // namespace viscard::test
