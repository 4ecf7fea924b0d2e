#include "io/serve/rig_server.h"

#include "io/basics/json_string.h"
#include "io/flow/command_error.h"
#include "io/results/result_json.h"
#include "io/serve/api_error.h"
#include "io/serve/deadline_server.h"
#include "io/serve/page_files.h"
#include "io/serve/request_guard.h"
#include "io/serve/series_json.h"

#include <fmt/format.h>
#include <httplib.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <functional>
#include <thread>

namespace viscard {
namespace {

using nlohmann::ordered_json;

constexpr std::size_t kLargestRequest = 64 * 1024;
// A request to stop never waits for others.
constexpr const char* kStopPath = "/api/run/stop";
bool asks_to_stop(const std::string& first_line) {
  return first_line.starts_with("POST " + std::string(kStopPath) + " ");
}
constexpr std::chrono::milliseconds kPoll{20};

// Nothing but what this program serves: no foreign script, no frame around the page.
const httplib::Headers& headers_of_all() {
  static const httplib::Headers kHeaders{
      {"Content-Security-Policy",
       "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; "
       "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"},
      {"X-Content-Type-Options", "nosniff"},
      {"X-Frame-Options", "DENY"},
      {"Referrer-Policy", "no-referrer"},
      {"Cross-Origin-Opener-Policy", "same-origin"},
      {"Cross-Origin-Resource-Policy", "same-origin"},
      {"Cache-Control", "no-store"}};
  return kHeaders;
}

void answer(httplib::Response& response, int status, const ordered_json& json) {
  response.status = status;
  // Messages may quote bytes of a file that are not UTF-8.
  response.set_content(printable_text_from_json(json), "application/json");
}

void answer_error(httplib::Response& response, int status, const CommandError& error) {
  answer(response, status, {{"error", json_from_result(error)}});
}

// A request that no route has taken.
void answer_unread(const httplib::Request& request, httplib::Response& response) {
  const int status = response.status;
  if (status == 404) {
    answer_error(response, status,
                 {"not-found",
                  fmt::format("viscard serve has nothing at {} {}", request.method, request.path),
                  request.path, ""});
  } else if (status == 413) {
    answer_error(response, status,
                 {"too-large", fmt::format("the request is larger than {} bytes", kLargestRequest),
                  request.path, ""});
  } else {
    answer_error(response, status, {"bad-request", "the request cannot be read", request.path, ""});
  }
}

std::size_t number_of(const httplib::Request& request, const char* name) {
  const std::string text = request.get_param_value(name);
  if (text.empty()) return 0;
  if (text.size() <= 12 && text.find_first_not_of("0123456789") == std::string::npos) {
    return static_cast<std::size_t>(std::stoull(text));
  }
  throw ApiError(400, "bad-value", std::string(name) + "=" + text + " is not a whole number");
}

}  // namespace

class RigServer::Impl {
 public:
  explicit Impl(ServeOptions options)
      : wanted_port_(options.port),
        token_(random_token()),
        api_(std::move(options)),
        server_({.largest_body = kLargestRequest}, asks_to_stop) {
    configure();
    add_page();
    add_questions();
    add_orders();
    bind();
    thread_ = std::thread([this] { server_.listen_after_bind(); });
    while (!server_.is_running()) std::this_thread::sleep_for(kPoll);
  }

  ~Impl() {
    close();
    server_.stop();
    thread_.join();
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  int port() const { return port_; }
  const std::string& token() const { return token_; }
  const RigApi& api() const { return api_; }

  void close() {
    while (!api_.close()) std::this_thread::sleep_for(kPoll);
  }

 private:
  using Question = std::function<ordered_json(const httplib::Request&)>;
  using Order = std::function<ordered_json(const ordered_json&)>;

  void configure() {
    server_.set_default_headers(headers_of_all());
    server_.set_payload_max_length(kLargestRequest);
    server_.set_tcp_nodelay(true);
    // The library would let a second program listen on the same port.
    server_.set_socket_options([](socket_t socket) {
      const int yes = 1;
      ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    });
    server_.set_pre_routing_handler(
        [this](const httplib::Request& request, httplib::Response& response) {
          return is_admitted(request, response) ? httplib::Server::HandlerResponse::Unhandled
                                                : httplib::Server::HandlerResponse::Handled;
        });
    server_.set_error_handler([](const httplib::Request& request, httplib::Response& response) {
      if (response.body.empty()) answer_unread(request, response);
    });
  }

  bool is_admitted(const httplib::Request& request, httplib::Response& response) const {
    const auto header = [&](const char* name) { return request.get_header_value(name); };
    const bool is_api = request.path.rfind("/api/", 0) == 0;
    // The page itself may be opened by a link on another page; its requests may not be sent from
    // there.
    const std::string site = is_api ? header("Sec-Fetch-Site") : std::string();
    const std::string refusal = refusal_of({header("Host"), header("Origin"), site}, port_);
    if (!refusal.empty()) {
      answer_error(response, 403, command_error("forbidden", refusal));
      return false;
    }
    if (!is_api) return true;
    if (!is_same_token(header("X-Viscard-Token"), token_)) {
      answer_error(response, 403,
                   {"wrong-token", "this page belongs to an earlier start of viscard serve", "",
                    "Open the address that it has printed now"});
      return false;
    }
    return true;
  }

  void add_page() {
    for (const PageFile& file : page_files()) {
      server_.Get(file.path, [&file](const httplib::Request&, httplib::Response& response) {
        response.set_content(file.text.data(), file.text.size(), file.type);
      });
    }
  }

  void add_question(const char* path, Question question) {
    server_.Get(path, [question](const httplib::Request& request, httplib::Response& response) {
      carry_out(response, [&] { return question(request); });
    });
  }

  void add_order(const char* path, Order order) {
    server_.Post(path, [order](const httplib::Request& request, httplib::Response& response) {
      carry_out(response, [&] {
        if (request.get_header_value("Content-Type").rfind("application/json", 0) != 0) {
          throw ApiError(415, "bad-request", "the request must be application/json");
        }
        return order(object_from_text(request.body));
      });
    });
  }

  static void carry_out(httplib::Response& response, const std::function<ordered_json()>& work) {
    try {
      answer(response, 200, work());
    } catch (const ApiError& error) {
      answer_error(response, error.status(), command_error(error.code(), error.what()));
    } catch (const std::exception& error) {
      answer_error(response, 422, command_error(error));
    }
  }

  void add_questions() {
    add_question("/api/state", [this](const httplib::Request&) { return api_.state(); });
    add_question("/api/ports", [this](const httplib::Request&) { return api_.ports(); });
    add_question("/api/run", [this](const httplib::Request& request) {
      return api_.run(number_of(request, "from"), number_of(request, "keep_every"));
    });
  }

  void add_orders() {
    add_order("/api/check", [this](const ordered_json&) { return api_.check_rig(); });
    add_order("/api/preflight", [this](const ordered_json& r) { return api_.preflight_of(r); });
    add_order("/api/test", [this](const ordered_json& r) { return api_.save_test(r); });
    add_order("/api/specimens", [this](const ordered_json& r) { return api_.add_specimen(r); });
    add_order("/api/specimens/remove",
              [this](const ordered_json& r) { return api_.remove_specimen(r); });
    add_order("/api/run", [this](const ordered_json& r) { return api_.start_run(r); });
    add_order(kStopPath, [this](const ordered_json& r) { return api_.stop_run(r); });
    add_order("/api/fit", [this](const ordered_json& r) { return api_.fit(r); });
  }

  void bind() {
    constexpr const char* kHost = "127.0.0.1";
    if (wanted_port_ == 0) {
      port_ = server_.bind_to_any_port(kHost);
    } else if (server_.bind_to_port(kHost, wanted_port_)) {
      port_ = wanted_port_;
    }
    if (port_ > 0) return;
    throw std::runtime_error(
        fmt::format("port {} of 127.0.0.1 cannot be used: another program has it, or it is below "
                    "1024. Leave --port out to take any free one",
                    wanted_port_));
  }

  int wanted_port_;
  int port_ = -1;
  std::string token_;
  RigApi api_;
  DeadlineServer server_;
  std::thread thread_;
};

RigServer::RigServer(ServeOptions options) : impl_(std::make_unique<Impl>(std::move(options))) {}
RigServer::~RigServer() = default;

int RigServer::port() const {
  return impl_->port();
}
std::string RigServer::token() const {
  return impl_->token();
}
// The token stands behind "#", so that it is neither sent in a request nor in a referrer.
std::string RigServer::address() const {
  return fmt::format("http://127.0.0.1:{}/#{}", impl_->port(), impl_->token());
}
void RigServer::close() {
  impl_->close();
}
LiveState RigServer::last_run() const {
  return impl_->api().last_run();
}

}  // namespace viscard
