#include "io/serve/rig_server.h"

#include "io/serve/hands_api.h"
#include "io/serve/page_server.h"
#include "io/serve/rig_setup.h"

#include <nlohmann/json.hpp>

#include <chrono>
#include <thread>
#include <utility>

namespace viscard {
namespace {

// A request to stop never waits for others.
constexpr const char* kStopPath = "/api/run/stop";
constexpr std::chrono::milliseconds kPoll{20};

}  // namespace

class RigServer::Impl {
 public:
  explicit Impl(const ServeOptions& options)
      : api_(options, job_),
        hands_(options, job_),
        setup_(options, job_),
        server_({.program = "viscard serve",
                 .home = "/rig.html",
                 .urgent_path = kStopPath,
                 .port = options.port}) {
    add_questions();
    add_orders();
    server_.start();
  }

  ~Impl() {
    close();
    server_.stop();
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  const PageServer& server() const { return server_; }
  const RigApi& api() const { return api_; }

  void close() {
    for (bool is_idle = false; !is_idle; std::this_thread::sleep_for(kPoll)) {
      hands_.close();
      is_idle = api_.close();
    }
  }

 private:
  using Json = PageServer::Json;

  void add_questions() {
    server_.add_question("/api/state", [this](const auto&) { return api_.state(); });
    server_.add_question("/api/ports", [this](const auto&) { return api_.ports(); });
    server_.add_question("/api/rig", [this](const auto&) { return setup_.text(); });
    server_.add_question("/api/test", [this](const auto&) { return api_.test_texts(); });
    server_.add_question("/api/move", [this](const auto&) { return hands_.moving(); });
    server_.add_question("/api/run", [this](const PageServer::Value& value) {
      return api_.run(number_of(value, "from"), number_of(value, "keep_every"));
    });
  }

  void add_orders() {
    const auto add = [&](const char* path, PageServer::Order order) {
      server_.add_order(path, std::move(order));
    };
    add("/api/check", [this](const Json&) { return api_.check_rig(); });
    add("/api/rig", [this](const Json& r) { return setup_.take(r); });
    add("/api/preflight", [this](const Json& r) { return api_.preflight_of(r); });
    add("/api/test", [this](const Json& r) { return api_.save_test(r); });
    add("/api/specimens", [this](const Json& r) { return api_.add_specimen(r); });
    add("/api/specimens/remove", [this](const Json& r) { return api_.remove_specimen(r); });
    add("/api/run", [this](const Json& r) { return api_.start_run(r); });
    add("/api/specimens/rename", [this](const Json& r) { return api_.rename_specimen(r); });
    add("/api/captures/remove", [this](const Json& r) { return api_.remove_capture(r); });
    add("/api/captures/note", [this](const Json& r) { return api_.note_capture(r); });
    add("/api/captures/export", [this](const Json& r) { return api_.export_capture(r); });
    add("/api/captures/curve", [this](const Json& r) { return api_.capture_curve(r); });
    add("/api/move", [this](const Json& r) { return hands_.move(r); });
    add("/api/zero", [this](const Json& r) { return hands_.zero(r); });
    add("/api/weigh", [this](const Json& r) { return hands_.weigh(r); });
    add("/api/calibrate", [this](const Json& r) { return hands_.calibrate(r); });
    add(kStopPath, [this](const Json& r) {
      hands_.stop_move(r.contains("how") && r.at("how") == "at once");
      return hands_.is_moving() ? hands_.moving() : api_.stop_run(r);
    });
    add("/api/fit", [this](const Json& r) { return api_.fit(r); });
  }

  OneJob job_;
  RigApi api_;
  HandsApi hands_;
  RigSetup setup_;
  PageServer server_;
};

RigServer::RigServer(ServeOptions options) : impl_(std::make_unique<Impl>(options)) {}
RigServer::~RigServer() = default;

int RigServer::port() const {
  return impl_->server().port();
}
std::string RigServer::token() const {
  return impl_->server().token();
}
std::string RigServer::address() const {
  return impl_->server().address();
}
void RigServer::close() {
  impl_->close();
}
LiveState RigServer::last_run() const {
  return impl_->api().last_run();
}

}  // namespace viscard
