#pragma once

#include <string>
#include <vector>

namespace viscard {

// Serial ports present now, by their stable names where there are any (/dev/serial/by-id), found by
// looking at names only: opening a port resets many boards.
std::vector<std::string> present_ports();

// What can be said of a port without opening it. trouble is empty if it should open; otherwise the
// reason and the fix. Other users' programs cannot be seen by an ordinary user.
struct PortStatus {
  std::string path;
  std::string device;  // what a stable name stands for: "/dev/ttyUSB0"
  std::string trouble;
};
PortStatus port_status(const std::string& path);

// Opens the port just enough to tell why it cannot be used, and returns a descriptor that holds it
// exclusively (flock); the caller closes it. Throws RigError with the true reason and the fix:
// missing, not a terminal, no permission, busy. libserial reports all of these as "Bad file
// descriptor".
int open_exclusively(const std::string& path);

}  // namespace viscard
