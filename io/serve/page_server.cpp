#include "io/serve/page_server.h"

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

#include <atomic>
#include <cerrno>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <utility>

namespace viscard {
namespace {

using nlohmann::ordered_json;

constexpr std::size_t kLargestRequest = 64 * 1024;
constexpr std::chrono::milliseconds kStartPoll{20};
// A large file takes longer than a request, also through a forwarded port.
constexpr std::chrono::milliseconds kLargeArrival{60'000};

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

void carry_out(httplib::Response& response, const std::function<ordered_json()>& work) {
  try {
    answer(response, 200, work());
  } catch (const ApiError& error) {
    answer_error(response, error.status(), command_error(error.code(), error.what()));
  } catch (const ordered_json::exception&) {
    answer_error(
        response, 400,
        command_error("bad-value", "the request has a value of another kind than the page sends"));
  } catch (const std::exception& error) {
    answer_error(response, 422, command_error(error));
  }
}

void require_type(const httplib::Request& request, const std::string& type) {
  if (request.get_header_value("Content-Type").rfind(type, 0) == 0) return;
  throw ApiError(415, "bad-request", "the request must be " + type);
}

}  // namespace

class PageServer::Impl {
 public:
  explicit Impl(const PageServerOptions& options)
      : options_(options),
        token_(random_token()),
        server_({.largest_body = kLargestRequest,
                 .large_body = [this](const std::string& head) { return large_body(head); },
                 .large_arrival = kLargeArrival},
                [this](const std::string& first_line) {
                  return !options_.urgent_path.empty() &&
                         first_line.starts_with("POST " + options_.urgent_path + " ");
                }) {
    configure();
    add_page();
    bind();
  }

  ~Impl() { stop(); }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  void start() {
    thread_ = std::thread([this] { server_.listen_after_bind(); });
    while (!server_.is_running()) std::this_thread::sleep_for(kStartPoll);
  }
  void stop() {
    if (!thread_.joinable()) return;
    server_.stop();
    thread_.join();
  }

  int port() const { return port_; }
  const std::string& token() const { return token_; }
  httplib::Server& server() { return server_; }
  void set_drop(const char* path, std::size_t largest) {
    drop_line_ = std::string("post ") + path + "?";
    largest_drop_ = largest;
    server_.set_payload_max_length(largest);
  }

 private:
  // The larger size is for those who have the token, so that nobody else can fill the memory.
  std::size_t large_body(const std::string& head) const {
    const bool is_drop = largest_drop_ > 0 && head.starts_with(drop_line_);
    return is_drop && head.find("\r\nx-viscard-token: " + token_ + "\r\n") != std::string::npos
               ? largest_drop_
               : 0;
  }

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
    server_.set_error_handler([this](const httplib::Request& request, httplib::Response& response) {
      if (response.body.empty()) answer_unread(request, response);
    });
  }

  // A request that no route has taken.
  void answer_unread(const httplib::Request& request, httplib::Response& response) const {
    const int status = response.status;
    if (status == 404) {
      answer_error(
          response, status,
          {"not-found",
           fmt::format("{} has nothing at {} {}", options_.program, request.method, request.path),
           request.path, ""});
    } else if (status == 413) {
      answer_error(
          response, status,
          {"too-large", fmt::format("the request is larger than {} bytes", kLargestRequest),
           request.path, ""});
    } else {
      answer_error(response, status,
                   {"bad-request", "the request cannot be read", request.path, ""});
    }
  }

  bool is_admitted(const httplib::Request& request, httplib::Response& response) const {
    const auto header = [&](const char* name) { return request.get_header_value(name); };
    const bool is_api = request.path.rfind("/api/", 0) == 0;
    // The page itself may be opened by a link on another page; its requests may not be sent from
    // there.
    const std::string site = is_api ? header("Sec-Fetch-Site") : std::string();
    const std::string refusal =
        refusal_of({header("Host"), header("Origin"), site}, port_, options_.program);
    if (!refusal.empty()) {
      answer_error(response, 403, command_error("forbidden", refusal));
      return false;
    }
    if (!is_api) return true;
    if (!is_same_token(header("X-Viscard-Token"), token_)) {
      answer_error(response, 403,
                   {"wrong-token", "this page belongs to an earlier start of " + options_.program,
                    "", "Open the address that it has printed now"});
      return false;
    }
    return true;
  }

  void add_page() {
    for (const PageFile& file : page_files()) {
      const std::string path = file.path;
      const bool is_home = path == options_.home;
      if (path.ends_with(".html") && !is_home) continue;  // the page of another door
      server_.Get(is_home ? "/" : path,
                  [&file](const httplib::Request&, httplib::Response& response) {
                    response.set_content(file.text.data(), file.text.size(), file.type);
                  });
    }
  }

  void bind() {
    constexpr const char* kHost = "127.0.0.1";
    errno = 0;
    if (options_.port == 0) {
      port_ = server_.bind_to_any_port(kHost);
    } else if (server_.bind_to_port(kHost, options_.port)) {
      port_ = options_.port;
    }
    if (port_ > 0) return;
    if (errno == EMFILE || errno == ENFILE) {
      throw std::runtime_error(
          "no port can be opened: too many files are open; raise the limit (ulimit -n)");
    }
    throw std::runtime_error(
        fmt::format("port {} of 127.0.0.1 cannot be used: another program has it, or it is below "
                    "1024. Leave --port out to take any free one",
                    options_.port));
  }

  const PageServerOptions options_;
  int port_ = -1;
  const std::string token_;
  std::string drop_line_;  // in lower case
  std::size_t largest_drop_ = 0;
  DeadlineServer server_;
  std::thread thread_;
};

PageServer::PageServer(const PageServerOptions& options) : impl_(std::make_unique<Impl>(options)) {}
PageServer::~PageServer() = default;

void PageServer::add_question(const char* path, Question question) {
  impl_->server().Get(path, [question = std::move(question)](const httplib::Request& request,
                                                             httplib::Response& response) {
    carry_out(response, [&] {
      return question([&](const char* name) { return request.get_param_value(name); });
    });
  });
}

void PageServer::add_order(const char* path, Order order) {
  impl_->server().Post(path, [order = std::move(order)](const httplib::Request& request,
                                                        httplib::Response& response) {
    carry_out(response, [&] {
      require_type(request, "application/json");
      return order(object_from_text(request.body));
    });
  });
}

void PageServer::add_drop(const char* path, std::size_t largest, Drop drop) {
  impl_->set_drop(path, largest);
  impl_->server().Post(
      path, [drop = std::move(drop)](const httplib::Request& request, httplib::Response& response) {
        carry_out(response, [&] {
          require_type(request, "application/octet-stream");
          return drop(request.get_param_value("name"), request.body);
        });
      });
}

void PageServer::start() {
  impl_->start();
}
void PageServer::stop() {
  impl_->stop();
}
int PageServer::port() const {
  return impl_->port();
}
std::string PageServer::token() const {
  return impl_->token();
}
// The token stands behind "#", so that it is neither sent in a request nor in a referrer.
std::string PageServer::address() const {
  return fmt::format("http://127.0.0.1:{}/#{}", impl_->port(), impl_->token());
}

std::size_t number_of(const PageServer::Value& value, const char* name) {
  const std::string text = value(name);
  if (text.empty()) return 0;
  if (text.size() <= 12 && text.find_first_not_of("0123456789") == std::string::npos) {
    return static_cast<std::size_t>(std::stoull(text));
  }
  throw ApiError(400, "bad-value", std::string(name) + "=" + text + " is not a whole number");
}

}  // namespace viscard
