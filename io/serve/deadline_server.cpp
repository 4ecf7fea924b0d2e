#include "io/serve/deadline_server.h"

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

namespace viscard {

using SteadyClock = std::chrono::steady_clock;

// A request as far as it has arrived.
struct Arriving {
  socket_t socket = -1;
  SteadyClock::time_point deadline;
  std::string bytes;
  bool has_continued = false;    // the client was told to send the body
  std::size_t largest_body = 0;  // bytes; known with the head
};

namespace {

// Answers at once, in the thread that accepts connections: there a connection is only noted down.
class NoQueue : public httplib::TaskQueue {
 public:
  void enqueue(std::function<void()> task) override { task(); }
  void shutdown() override {}
};

std::string lower_case(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(), [](unsigned char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : static_cast<char>(c);
  });
  return out;
}

// The value of a field of the head (lower case); empty: it has none.
std::string field_of(const std::string& head, const std::string& name) {
  const std::size_t at = head.find("\r\n" + name + ":");
  if (at == std::string::npos) return {};
  const std::size_t begin = head.find_first_not_of(" \t", at + name.size() + 3);
  return head.substr(begin, head.find("\r\n", begin) - begin);
}

enum class State { kIncomplete, kComplete, kTooLarge };

State state_of(Arriving& request, const ConnectionLimits& limits) {
  const std::size_t end = request.bytes.find("\r\n\r\n");
  if (end == std::string::npos) {
    return request.bytes.size() > limits.largest_head ? State::kTooLarge : State::kIncomplete;
  }
  if (end > limits.largest_head) return State::kTooLarge;
  const std::string head = lower_case(std::string_view(request.bytes).substr(0, end + 2));
  if (request.largest_body == 0) {
    request.largest_body = limits.largest_body;
    const std::size_t large = limits.large_body ? limits.large_body(head) : 0;
    if (large > 0) {
      request.largest_body = large;
      request.deadline += limits.large_arrival - limits.arrival;
    }
  }
  const std::size_t body = request.bytes.size() - (end + 4);
  if (!field_of(head, "transfer-encoding").empty()) {
    if (body > request.largest_body) return State::kTooLarge;
    return request.bytes.ends_with("0\r\n\r\n") ? State::kComplete : State::kIncomplete;
  }
  const std::string length = field_of(head, "content-length");
  if (length.empty()) return State::kComplete;
  if (length.size() > 12 || length.find_first_not_of("0123456789") != std::string::npos) {
    return State::kTooLarge;
  }
  const std::size_t wanted = std::stoull(length);
  if (wanted > request.largest_body) return State::kTooLarge;
  return body >= wanted ? State::kComplete : State::kIncomplete;
}

void send_at_once(socket_t socket, std::string_view text) {
  ::send(socket, text.data(), text.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
}

// Ends a connection so that the client gets the answer even if it has sent more than was read.
void close_gently(socket_t socket) {
  ::shutdown(socket, SHUT_WR);
  char rest[4096];
  for (int i = 0; i < 64 && ::recv(socket, rest, sizeof rest, MSG_DONTWAIT) > 0; ++i) continue;
  ::close(socket);
}

// A request in memory, and the socket for its answer.
class ArrivedStream : public httplib::Stream {
 public:
  ArrivedStream(socket_t socket, std::string request, std::chrono::milliseconds answer)
      : socket_(socket), request_(std::move(request)), answer_(answer) {}

  bool is_readable() const override { return read_ < request_.size(); }
  bool is_writable() const override { return wait_for_room(); }
  ssize_t read(char* bytes, std::size_t size) override {
    const std::size_t count = std::min(size, request_.size() - read_);
    std::copy_n(request_.data() + read_, count, bytes);
    read_ += count;
    return static_cast<ssize_t>(count);
  }
  ssize_t write(const char* bytes, std::size_t size) override {
    if (!wait_for_room()) return -1;
    return ::send(socket_, bytes, size, MSG_NOSIGNAL | MSG_DONTWAIT);
  }
  void get_remote_ip_and_port(std::string& ip, int& port) const override {
    ip = "127.0.0.1";
    port = 0;
  }
  void get_local_ip_and_port(std::string& ip, int& port) const override {
    ip = "127.0.0.1";
    port = 0;
  }
  socket_t socket() const override { return socket_; }

 private:
  // The time counts from the first byte of the answer on: what is asked may take minutes.
  bool wait_for_room() const {
    if (!deadline_) deadline_ = SteadyClock::now() + answer_;
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(*deadline_ - SteadyClock::now());
    if (left.count() <= 0) return false;
    pollfd one{socket_, POLLOUT, 0};
    return ::poll(&one, 1, static_cast<int>(left.count())) == 1 && (one.revents & POLLOUT) != 0;
  }

  socket_t socket_;
  std::string request_;
  std::size_t read_ = 0;
  std::chrono::milliseconds answer_;
  mutable std::optional<SteadyClock::time_point> deadline_;
};

}  // namespace

// Reads requests in a thread of its own and hands those that have arrived to the threads that answer.
class DeadlineServer::Arrivals {
 public:
  using Answer = std::function<void(socket_t, std::string)>;

  Arrivals(const ConnectionLimits& limits, std::function<bool(const std::string&)> is_urgent,
           Answer answer)
      : limits_(limits),
        is_urgent_(std::move(is_urgent)),
        answer_(std::move(answer)),
        wake_(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)),
        others_(limits.n_threads),
        urgent_(1),
        thread_([this] { read_all(); }) {}

  ~Arrivals() {
    is_ending_ = true;
    wake();
    thread_.join();
    others_.shutdown();
    urgent_.shutdown();
    for (const Arriving& request : open_) ::close(request.socket);
    for (const Arriving& request : fresh_) ::close(request.socket);
    ::close(wake_);
  }
  Arrivals(const Arrivals&) = delete;
  Arrivals& operator=(const Arrivals&) = delete;

  void add(socket_t socket) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      fresh_.push_back({.socket = socket, .deadline = SteadyClock::now() + limits_.arrival});
    }
    wake();
  }

 private:
  void wake() const {
    const std::uint64_t one = 1;
    [[maybe_unused]] const ssize_t count = ::write(wake_, &one, sizeof one);
  }

  void read_all() {
    while (!is_ending_) {
      std::vector<pollfd> watched{{wake_, POLLIN, 0}};
      for (const Arriving& request : open_) watched.push_back({request.socket, POLLIN, 0});
      ::poll(watched.data(), watched.size(), open_.empty() ? -1 : 50);
      std::vector<Arriving> still_open;
      for (std::size_t i = 0; i < open_.size(); ++i) {
        const bool is_kept =
            watched[i + 1].revents != 0 ? read_some(open_[i]) : is_in_time(open_[i]);
        if (is_kept) still_open.push_back(std::move(open_[i]));
      }
      open_ = std::move(still_open);
      take_fresh();
    }
  }

  void take_fresh() {
    std::uint64_t count = 0;
    [[maybe_unused]] const ssize_t size = ::read(wake_, &count, sizeof count);
    const std::lock_guard<std::mutex> lock(mutex_);
    for (Arriving& request : fresh_) {
      if (open_.size() >= limits_.most_open) {  // the first one is the oldest
        refuse(open_.front(), "503 Service Unavailable");
        open_.erase(open_.begin());
      }
      if (read_some(request)) open_.push_back(std::move(request));
    }
    fresh_.clear();
  }

  bool is_in_time(const Arriving& request) {
    if (SteadyClock::now() < request.deadline) return true;
    refuse(request, "408 Request Timeout");
    return false;
  }

  // False if the connection is not to be watched any longer.
  bool read_some(Arriving& request) {
    char bytes[16384];
    const ssize_t count = ::recv(request.socket, bytes, sizeof bytes, MSG_DONTWAIT);
    if (count < 0 && (errno == EAGAIN || errno == EINTR)) return is_in_time(request);
    if (count <= 0) {
      ::close(request.socket);
      return false;
    }
    request.bytes.append(bytes, static_cast<std::size_t>(count));
    const State state = state_of(request, limits_);
    if (state == State::kIncomplete) {
      continue_if_asked(request);
      return is_in_time(request);
    }
    if (state == State::kTooLarge) {
      refuse(request, "413 Payload Too Large");
    } else {
      hand_over(request);
    }
    return false;
  }

  static void continue_if_asked(Arriving& request) {
    const std::size_t end = request.bytes.find("\r\n\r\n");
    if (end == std::string::npos || request.has_continued) return;
    const std::string head = lower_case(std::string_view(request.bytes).substr(0, end + 2));
    if (field_of(head, "expect") != "100-continue") return;
    send_at_once(request.socket, "HTTP/1.1 100 Continue\r\n\r\n");
    request.has_continued = true;
  }

  void refuse(const Arriving& request, const std::string& status) const {
    const std::string code = status.starts_with("413") ? "too-large" : "bad-request";
    const std::string message =
        status.starts_with("413")
            ? "the request is larger than " +
                  std::to_string(std::max(request.largest_body, limits_.largest_body)) + " bytes"
            : "the request did not arrive in time";
    const std::string body = "{\"error\":{\"code\":\"" + code + "\",\"message\":\"" + message +
                             "\",\"where\":\"\",\"hint\":\"\"}}";
    send_at_once(request.socket,
                 "HTTP/1.1 " + status +
                     "\r\nConnection: close\r\nContent-Type: application/json\r\nContent-Length: " +
                     std::to_string(body.size()) + "\r\n\r\n" + body);
    close_gently(request.socket);
  }

  void hand_over(Arriving& request) {
    const std::string first_line = request.bytes.substr(0, request.bytes.find("\r\n"));
    httplib::ThreadPool& threads = is_urgent_(first_line) ? urgent_ : others_;
    threads.enqueue([this, socket = request.socket, bytes = std::move(request.bytes)] {
      answer_(socket, bytes);
    });
  }

  const ConnectionLimits limits_;
  const std::function<bool(const std::string&)> is_urgent_;
  const Answer answer_;
  const int wake_;
  std::atomic<bool> is_ending_{false};
  std::vector<Arriving> open_;  // oldest first; of the reading thread
  std::mutex mutex_;            // of fresh_
  std::vector<Arriving> fresh_;
  httplib::ThreadPool others_, urgent_;
  std::thread thread_;
};

DeadlineServer::DeadlineServer(const ConnectionLimits& limits,
                               std::function<bool(const std::string&)> is_urgent)
    : limits_(limits),
      arrivals_(std::make_unique<Arrivals>(
          limits, std::move(is_urgent),
          [this](socket_t socket, std::string request) { answer(socket, std::move(request)); })) {
  new_task_queue = [] { return new NoQueue; };
}

DeadlineServer::~DeadlineServer() = default;

bool DeadlineServer::process_and_close_socket(socket_t socket) {
  arrivals_->add(socket);
  return true;
}

void DeadlineServer::answer(socket_t socket, std::string request) {
  ArrivedStream stream(socket, std::move(request), limits_.answer);
  bool is_closed = false;
  process_request(stream, /*close_connection=*/true, is_closed, nullptr);
  close_gently(socket);
}

}  // namespace viscard
