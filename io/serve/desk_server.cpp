#include "io/serve/desk_server.h"

#include "io/serve/page_server.h"

#include <nlohmann/json.hpp>

namespace viscard {

class DeskServer::Impl {
 public:
  explicit Impl(const DeskOptions& options)
      : api_(options),
        server_({.program = "viscard desk", .home = "/desk.html", .port = options.port}) {
    using Order = PageServer::Json;
    server_.add_question("/api/desk", [this](const auto&) { return api_.state(); });
    server_.add_question("/api/desk/choices", [this](const auto&) { return api_.choices(); });
    server_.add_order("/api/desk/table", [this](const Order& r) { return api_.table(r); });
    server_.add_order("/api/desk/fit", [this](const Order& r) { return api_.fit(r); });
    server_.add_order("/api/desk/card", [this](const Order& r) { return api_.card(r); });
    server_.add_order("/api/desk/predict", [this](const Order& r) { return api_.predict(r); });
    server_.add_order("/api/desk/check", [this](const Order& r) { return api_.check(r); });
    server_.add_order("/api/desk/scene/open",
                      [this](const Order& r) { return api_.open_scene(r); });
    server_.add_order("/api/desk/scene", [this](const Order& r) { return api_.scene(r); });
    server_.add_order("/api/desk/report", [this](const Order& r) { return api_.report(r); });
    server_.add_drop("/api/desk/drop", kLargestDrop_B,
                     [this](const std::string& name, const std::string& bytes) {
                       return api_.drop(name, bytes);
                     });
    server_.start();
  }
  ~Impl() {
    api_.close();
    server_.stop();
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  const PageServer& server() const { return server_; }

 private:
  DeskApi api_;
  PageServer server_;
};

DeskServer::DeskServer(const DeskOptions& options) : impl_(std::make_unique<Impl>(options)) {}
DeskServer::~DeskServer() = default;

int DeskServer::port() const {
  return impl_->server().port();
}
std::string DeskServer::address() const {
  return impl_->server().address();
}
std::string DeskServer::token() const {
  return impl_->server().token();
}

}  // namespace viscard
