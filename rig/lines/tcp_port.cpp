#include "rig/lines/tcp_port.h"

#include <string_view>

namespace viscard {
namespace {

constexpr std::string_view kTcpPort = "tcp://";

}  // namespace

bool is_tcp_port(const std::string& port) {
  return port.starts_with(kTcpPort);
}

std::optional<TcpAddress> tcp_address(const std::string& port) {
  if (!is_tcp_port(port)) return std::nullopt;
  const std::string rest = port.substr(kTcpPort.size());
  const std::size_t colon = rest.rfind(':');
  if (colon == std::string::npos || colon == 0) return std::nullopt;
  TcpAddress found{rest.substr(0, colon), rest.substr(colon + 1)};
  if (found.host.front() == '[' && found.host.back() == ']')
    found.host = found.host.substr(1, found.host.size() - 2);
  const bool is_number = !found.number.empty() && found.number.size() <= 5 &&
                         found.number.find_first_not_of("0123456789") == std::string::npos;
  if (found.host.empty() || !is_number) return std::nullopt;
  const int number = std::stoi(found.number);
  if (number < 1 || number > 65535) return std::nullopt;
  return found;
}

std::string trouble_of_tcp_port(const std::string& port) {
  if (tcp_address(port)) return "";
  return "needs a host and a number, such as tcp://192.168.1.20:5025";
}

}  // namespace viscard
