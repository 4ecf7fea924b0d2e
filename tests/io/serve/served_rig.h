#pragma once

#include "io/serve/rig_server.h"
#include "tests/support/scratch_folder.h"

#include <httplib.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <functional>
#include <string>
#include <thread>

namespace viscard::test {

using Json = nlohmann::ordered_json;

struct ApiAnswer {
  int status = 0;
  Json json;
};

// viscard serve, by default on an emulated rig whose clock runs fast, and a client that has its token.
class ServedRig {
 public:
  explicit ServedRig(double speed = 60.0)
      : ServedRig(ServeOptions{.is_emulated = true, .seed = 3, .speed = speed}) {}
  // The folder is one of its own.
  explicit ServedRig(ServeOptions options)
      : server_(with_folder(std::move(options), scratch_ / "series")),
        client_("127.0.0.1", server_.port()) {
    client_.set_read_timeout(60);
    client_.set_default_headers({{"X-Viscard-Token", server_.token()}});
  }

  RigServer& server() { return server_; }
  httplib::Client& client() { return client_; }
  std::filesystem::path folder() const { return scratch_ / "series"; }

  ApiAnswer ask(const std::string& path) { return answer_of(client_.Get(path)); }
  ApiAnswer order(const std::string& path, const Json& body) {
    return answer_of(client_.Post(path, body.dump(), "application/json"));
  }

  // A specimen of PDMS and a test of a few seconds; returns the name of the specimen.
  std::string prepare() {
    const Json test = {{"hold_s", 4.0}, {"recovery_s", 2.0}, {"baseline_s", 2.0}};
    if (order("/api/test", {{"test", test}}).status != 200) throw std::runtime_error("test");
    return order("/api/specimens", {{"specimen", specimen()}}).json.at("name");
  }
  static Json specimen() {
    return {{"id", "PDMS 1:10"},       {"material", "PDMS"},         {"mixing_ratio", 10.0},
            {"modulus_guess_Pa", 2e6}, {"punch_diameter_m", 4.4e-3}, {"layer_thickness_m", 11e-3},
            {"poisson_ratio", 0.495}};
  }

  // The first state of the run that satisfies the condition; the last one after a minute.
  Json wait_for_run(const std::function<bool(const Json&)>& is_met) {
    Json run;
    for (int i = 0; i < 1200; ++i) {
      run = ask("/api/run").json;
      if (is_met(run)) break;
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return run;
  }
  Json wait_for_end() {
    return wait_for_run([](const Json& run) { return !run.at("is_running").get<bool>(); });
  }
  Json wait_for_force(double force_N) {
    return wait_for_run([&](const Json& run) {
      return !run.at("is_running").get<bool>() || run.at("force_N").get<double>() > force_N;
    });
  }

 private:
  static ServeOptions with_folder(ServeOptions options, const std::filesystem::path& folder) {
    options.folder = folder;
    return options;
  }
  static ApiAnswer answer_of(const httplib::Result& result) {
    if (!result) return {};
    return {result->status, Json::parse(result->body, nullptr, false)};
  }

  ScratchFolder scratch_;
  RigServer server_;
  httplib::Client client_;
};

// Message and hint of a refusal.
inline std::string message_of(const ApiAnswer& answer) {
  const Json& error = answer.json.at("error");
  return error.at("message").get<std::string>() + " " + error.at("hint").get<std::string>();
}

}  // namespace viscard::test
