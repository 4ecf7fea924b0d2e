#include "tests/io/serve/raw_request.h"

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdint>
#include <stdexcept>

namespace viscard::test {

std::string answer_to_bytes(int port, const std::string& bytes) {
  const int descriptor = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  const auto* any = reinterpret_cast<const sockaddr*>(&address);
  const auto size = static_cast<ssize_t>(bytes.size());
  std::string answer;
  const bool is_sent = ::connect(descriptor, any, sizeof address) == 0 &&
                       ::send(descriptor, bytes.data(), bytes.size(), MSG_NOSIGNAL) == size;
  char buffer[4096];
  for (ssize_t n = 0; is_sent && (n = ::recv(descriptor, buffer, sizeof buffer, 0)) > 0;) {
    answer.append(buffer, static_cast<std::size_t>(n));
  }
  ::close(descriptor);
  if (!is_sent) throw std::runtime_error("the bytes were not taken");
  return answer;
}

}  // namespace viscard::test
