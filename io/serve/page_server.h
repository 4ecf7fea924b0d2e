#pragma once

#include <nlohmann/json.hpp>

#include <cstddef>
#include <functional>
#include <memory>
#include <string>

namespace viscard {

// What a page server is.
struct PageServerOptions {
  std::string program;      // "viscard serve", for messages
  std::string home;         // the page that "/" shows: "/rig.html"
  std::string urgent_path;  // a request for it never waits for others; empty: none
  int port = 0;             // 0: any free one
};

// A page on 127.0.0.1 and the requests behind it: only those that come from the page itself, with the token of this
// start, are carried out (request_guard.h). Threads of its own answer, from start() on until the destructor.
class PageServer {
 public:
  using Json = nlohmann::ordered_json;
  // The values of a question's address, "from" of ?from=3; empty: not given.
  using Value = std::function<std::string(const char* name)>;
  using Question = std::function<Json(const Value& value)>;
  using Order = std::function<Json(const Json& request)>;
  using Drop = std::function<Json(const std::string& name, const std::string& bytes)>;

  // Throws std::runtime_error if the port is taken.
  explicit PageServer(const PageServerOptions& options);
  ~PageServer();

  // GET; POST of JSON; POST of the bytes of a file, ?name=a.csv, of this size at most. These functions may throw
  // ApiError, or std::exception with a message for a person.
  void add_question(const char* path, Question question);
  void add_order(const char* path, Order order);
  void add_drop(const char* path, std::size_t largest, Drop drop);
  void start();
  // Answers what has arrived and nothing more. The functions above are not called again.
  void stop();

  int port() const;
  std::string token() const;
  // The address to open, with the token that gives access.
  std::string address() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

// A whole number of a question's address; 0 if it is not given. Throws ApiError 400.
std::size_t number_of(const PageServer::Value& value, const char* name);

}  // namespace viscard
