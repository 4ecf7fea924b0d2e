#include "tests/io/serve/raw_request.h"

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdint>
#include <stdexcept>

namespace viscard::test {

int connection_with(int port, const std::string& bytes) {
  const int descriptor = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  const auto* any = reinterpret_cast<const sockaddr*>(&address);
  const auto size = static_cast<ssize_t>(bytes.size());
  const bool is_sent = ::connect(descriptor, any, sizeof address) == 0 &&
                       ::send(descriptor, bytes.data(), bytes.size(), MSG_NOSIGNAL) == size;
  if (is_sent) return descriptor;
  ::close(descriptor);
  throw std::runtime_error("the bytes were not taken");
}

std::string answer_to_bytes(int port, const std::string& bytes) {
  const int descriptor = connection_with(port, bytes);
  std::string answer;
  char buffer[4096];
  for (ssize_t n = 0; (n = ::recv(descriptor, buffer, sizeof buffer, 0)) > 0;) {
    answer.append(buffer, static_cast<std::size_t>(n));
  }
  ::close(descriptor);
  return answer;
}

}  // namespace viscard::test
