#include "io/serve/request_guard.h"

#include <fmt/format.h>
#include <sys/random.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <stdexcept>

namespace viscard {

std::string refusal_of(const RequestOrigin& request, int port, const std::string& program) {
  const std::string by_number = fmt::format("127.0.0.1:{}", port);
  const std::string by_name = fmt::format("localhost:{}", port);
  if (request.host != by_number && request.host != by_name) {
    return program + " answers only under http://" + by_number +
           ". Open the address that it has printed";
  }
  const std::string refusal =
      " may not use this program. Open the address that " + program + " has printed";
  if (!request.origin.empty() && request.origin != "http://" + request.host) {
    return "a page of " + request.origin + refusal;
  }
  const std::string& site = request.fetch_site;
  if (!site.empty() && site != "same-origin" && site != "none") return "another page" + refusal;
  return "";
}

bool is_same_token(const std::string& given, const std::string& token) {
  unsigned difference = given.size() == token.size() && !token.empty() ? 0u : 1u;
  for (std::size_t i = 0; i < given.size() && i < token.size(); ++i) {
    difference |= static_cast<unsigned char>(given[i]) ^ static_cast<unsigned char>(token[i]);
  }
  return difference == 0u;
}

std::string random_token() {
  std::array<unsigned char, 16> bytes{};
  std::size_t n = 0;
  while (n < bytes.size()) {
    const ssize_t got = ::getrandom(bytes.data() + n, bytes.size() - n, 0);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) throw std::runtime_error("the system gives no random numbers for the address");
    n += static_cast<std::size_t>(got);
  }
  std::string token;
  for (const unsigned char byte : bytes) token += fmt::format("{:02x}", byte);
  return token;
}

}  // namespace viscard
