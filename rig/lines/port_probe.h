#pragma once

#include <string>
#include <vector>

namespace viscard {

// Serial and USB-TMC ports that are present, by their stable names in /dev/serial/by-id if they have one. Only
// names are read, because opening a port resets many boards.
std::vector<std::string> present_ports();

// The state of a port as far as it is known without opening it.
struct PortStatus {
  std::string path;
  std::string device;  // the target of a stable name: "/dev/ttyUSB0"
  // Why it cannot be used and what to do; empty if it should open. An ordinary user cannot see that
  // another user's program has it open.
  std::string trouble;
};
PortStatus port_status(const std::string& path);

// The device behind a name of a port; a TCP port has one name only.
std::string real_port(const std::string& port);

// True for a device file of the kernel's usbtmc driver, also behind a link with another name.
bool is_usbtmc_port(const std::string& port);

// Opens the port to find out whether it can be used, and returns a descriptor that holds it
// exclusively (flock); the caller closes it. Throws RigError with the true reason and the fix:
// missing, not a terminal, no permission, or busy. libserial reports all of these as "Bad file
// descriptor".
int open_exclusively(const std::string& path);
// The same for a device of the usbtmc driver, which is no terminal; reads and writes block.
int open_message_device(const std::string& path);

}  // namespace viscard
