#pragma once

#include <httplib.h>
// <resolv.h> of glibc, which it includes, has a macro of this name, and Eigen a parameter.
#undef _res

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>

namespace viscard {

// What a connection may take.
struct ConnectionLimits {
  std::chrono::milliseconds arrival{5000};  // until the whole request has arrived, head and body
  std::chrono::milliseconds answer{
      10000};  // from its first byte until the whole answer has been taken
  std::size_t largest_head = 16 * 1024;  // bytes
  std::size_t largest_body = 64 * 1024;  // bytes, also of a chunked one
  std::size_t most_open =
      64;  // connections whose request has not arrived; a further one ends the oldest
  std::size_t n_threads = 8;  // that answer
  // Of requests that may be larger: bytes of the body by the head in lower case, 0 for all others; and the time
  // in which they must arrive.
  std::function<std::size_t(const std::string& head)> large_body{};
  std::chrono::milliseconds large_arrival{5000};
};

// httplib::Server gives each connection a thread before it has sent anything, so that a few dozen slow ones
// keep all others waiting. This server reads all requests in one thread, and a request that has arrived is
// answered by others. Urgent ones have a thread of their own. One request per connection.
class DeadlineServer : public httplib::Server {
 public:
  // is_urgent: called with the first line, "POST /api/run/stop HTTP/1.1".
  DeadlineServer(const ConnectionLimits& limits,
                 std::function<bool(const std::string& first_line)> is_urgent);
  // Precondition: stop() was called, and the thread that listens has ended.
  ~DeadlineServer() override;

 private:
  bool process_and_close_socket(socket_t socket) override;
  void answer(socket_t socket, std::string request);

  class Arrivals;
  ConnectionLimits limits_;
  std::unique_ptr<Arrivals> arrivals_;
};

}  // namespace viscard
