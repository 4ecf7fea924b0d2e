#pragma once

#include <optional>
#include <string>

namespace viscard {

// A port that is reached over the network: "tcp://192.168.1.20:5025", "tcp://[::1]:5025".
struct TcpAddress {
  std::string host, number;
};
bool is_tcp_port(const std::string& port);
// Nothing: no host, or no number from 1 to 65535 behind the last colon.
std::optional<TcpAddress> tcp_address(const std::string& port);
// Why such a name cannot be used; empty if it can. Nothing is connected.
std::string trouble_of_tcp_port(const std::string& port);

}  // namespace viscard
