#include "rig/lines/port_probe.h"

#include "rig/lines/rig_error.h"
#include "rig/lines/tcp_port.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

namespace viscard {
namespace {

namespace fs = std::filesystem;

std::string present_ports_text() {
  const std::vector<std::string> ports = present_ports();
  if (ports.empty()) return "No serial port is present: is the device plugged in and switched on?";
  std::string text = "Present now:";
  for (const std::string& port : ports) text += " " + port;
  return text;
}

std::string trouble_text(const std::string& path, int error) {
  switch (error) {
    case ENOENT:
    case ENODEV:
    case ENXIO:
      return "there is no port '" + path + "'. " + present_ports_text();
    case EACCES:
    case EPERM:
      if (is_usbtmc_port(path)) {
        return "no permission to open '" + path +
               "'. Write SUBSYSTEM==\"usbmisc\", KERNEL==\"usbtmc*\", GROUP=\"plugdev\", "
               "MODE=\"0660\" into /etc/udev/rules.d/60-usbtmc.rules, join that group, log in "
               "again, and plug it in again";
      }
      return "no permission to open '" + path +
             "'. Join the group that owns it (sudo usermod -aG dialout $USER), log in "
             "again, and retry";
    case EBUSY:
    case EWOULDBLOCK:
      return "'" + path + "' is in use by another program (fuser " + path +
             " names it). Close that program, or wait for its run to end";
    case EMFILE:
    case ENFILE:
      return "'" + path +
             "' cannot be opened: too many files are open. Raise the limit (ulimit -n)";
    default:
      return "'" + path + "' cannot be opened: " + std::strerror(error) +
             ". Unplug the device, plug it in again, and retry";
  }
}

[[noreturn]] void throw_for(const std::string& path, int error) {
  throw PortUnavailable(trouble_text(path, error));
}

// flock() as for serial ports: the kernel lets several programs open one device.
void hold(const std::string& path, int descriptor) {
  if (flock(descriptor, LOCK_EX | LOCK_NB) == 0) return;
  const int error = errno;
  close(descriptor);
  throw_for(path, error);
}

bool holds(const fs::path& process, const fs::path& device) {
  std::error_code error;
  fs::directory_iterator entry(process / "fd", error);
  while (!error && entry != fs::directory_iterator()) {
    std::error_code ignored;  // it was closed meanwhile
    if (fs::read_symlink(entry->path(), ignored) == device) return true;
    entry.increment(error);
  }
  return false;
}

// The process that has the device open, as far as this user may see it, or 0.
long holder_of(const fs::path& device) {
  std::error_code error;
  fs::directory_iterator process("/proc", error);
  while (!error && process != fs::directory_iterator()) {
    const std::string pid = process->path().filename().string();
    const bool is_number = pid.find_first_not_of("0123456789") == std::string::npos;
    if (is_number && holds(process->path(), device)) return std::stol(pid);
    process.increment(error);
  }
  return 0;
}

std::string not_a_port_text(const std::string& path, mode_t mode) {
  const char* kind = S_ISREG(mode)    ? "a regular file"
                     : S_ISDIR(mode)  ? "a folder"
                     : S_ISFIFO(mode) ? "a pipe"
                     : S_ISSOCK(mode) ? "a socket"
                                      : "a device without a serial line";
  return "'" + path + "' is " + kind + ", not a serial port";
}

}  // namespace

bool is_usbtmc_port(const std::string& port) {
  std::error_code ignored;
  return fs::weakly_canonical(port, ignored).filename().string().rfind("usbtmc", 0) == 0;
}

std::string real_port(const std::string& port) {
  std::error_code ignored;
  return is_tcp_port(port) ? port : fs::weakly_canonical(port, ignored).string();
}

std::vector<std::string> present_ports() {
  std::vector<std::string> ports;
  std::vector<std::string> covered;  // devices that a stable name already names
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator("/dev/serial/by-id", ignored)) {
    ports.push_back(entry.path().string());
    covered.push_back(fs::weakly_canonical(entry.path(), ignored).string());
  }
  for (const auto& entry : fs::directory_iterator("/dev", ignored)) {
    const std::string name = entry.path().filename().string();
    const bool is_port = name.rfind("ttyUSB", 0) == 0 || name.rfind("ttyACM", 0) == 0 ||
                         name.rfind("usbtmc", 0) == 0;
    if (!is_port) continue;
    const std::string path = entry.path().string();
    if (std::find(covered.begin(), covered.end(), path) == covered.end()) ports.push_back(path);
  }
  std::sort(ports.begin(), ports.end());
  return ports;
}

PortStatus port_status(const std::string& path) {
  PortStatus result{path, path, ""};
  if (is_tcp_port(path)) {
    result.trouble = trouble_of_tcp_port(path);
    return result;
  }
  struct stat status {};
  if (stat(path.c_str(), &status) != 0) {
    result.trouble = trouble_text(path, errno);
    return result;
  }
  std::error_code ignored;
  const fs::path device = fs::weakly_canonical(path, ignored);
  result.device = device.string();
  if (!S_ISCHR(status.st_mode)) {
    result.trouble = not_a_port_text(path, status.st_mode);
  } else if (access(path.c_str(), R_OK | W_OK) != 0) {
    result.trouble = trouble_text(path, errno);
  } else if (const long pid = holder_of(device); pid != 0 && pid != getpid()) {
    result.trouble = "in use by process " + std::to_string(pid) +
                     ". Close that program, or wait for its run to end";
  }
  return result;
}

int open_message_device(const std::string& path) {
  const int descriptor = open(path.c_str(), O_RDWR | O_CLOEXEC);
  if (descriptor < 0) throw_for(path, errno);
  hold(path, descriptor);
  return descriptor;
}

int open_exclusively(const std::string& path) {
  if (path.empty()) {
    throw PortUnavailable(
        "no port is given: set port = \"/dev/serial/by-id/...\" in the rig file. " +
        present_ports_text());
  }
  struct stat status {};
  if (stat(path.c_str(), &status) != 0) throw_for(path, errno);
  const auto throw_no_port = [&] {
    throw PortUnavailable(not_a_port_text(path, status.st_mode) + ". " + present_ports_text());
  };
  if (!S_ISCHR(status.st_mode)) throw_no_port();
  const int descriptor = open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) throw_for(path, errno);
  if (isatty(descriptor) != 1) {
    close(descriptor);
    throw_no_port();
  }
  hold(path, descriptor);
  return descriptor;
}

}  // namespace viscard
