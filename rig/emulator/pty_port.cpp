#include "rig/emulator/pty_port.h"

#include <fcntl.h>
#include <poll.h>
#include <pty.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <stdexcept>

namespace viscard {

PtyPort::PtyPort() {
  open();
}

void PtyPort::open() {
  int slave = -1;
  std::array<char, 256> name{};
  termios raw{};
  cfmakeraw(&raw);
  cfsetspeed(&raw, B115200);
  raw.c_cflag |= CLOCAL | CREAD;
  if (openpty(&master_, &slave, name.data(), &raw, nullptr) != 0) {
    throw std::runtime_error(std::string("no pseudo-terminal for the emulated rig: ") +
                             std::strerror(errno) + ". Close other terminals and retry");
  }
  path_ = name.data();
  if (!link_.empty()) {
    std::error_code ignored;
    std::filesystem::remove(link_, ignored);
    std::filesystem::create_symlink(path_, link_);
    path_ = link_;
  }
  fcntl(master_, F_SETFL, O_NONBLOCK);
  fcntl(master_, F_SETFD, FD_CLOEXEC);
  // After the slave was opened and closed, the master reports a hang-up until a host opens it. That
  // is how the opening of the port, and so a reset, is noticed.
  close(slave);
}

PtyPort::~PtyPort() {
  hang_up();
  if (link_.empty()) return;
  std::error_code ignored;
  std::filesystem::remove_all(std::filesystem::path(link_).parent_path(), ignored);
}

void PtyPort::name_stably() {
  std::string folder = (std::filesystem::temp_directory_path() / "viscard-port-XXXXXX").string();
  if (mkdtemp(folder.data()) == nullptr) {
    throw std::runtime_error("no folder for the name of an emulated port: " +
                             std::string(std::strerror(errno)));
  }
  link_ = folder + "/tty";
  std::filesystem::create_symlink(path_, link_);
  path_ = link_;
}

void PtyPort::come_back() {
  hang_up();
  unsent_.clear();
  open();
}

void PtyPort::hang_up() {
  if (master_ >= 0) close(master_);
  master_ = -1;
}

bool PtyPort::is_open_by_host() const {
  if (master_ < 0) return false;
  pollfd entry{master_, 0, 0};
  return poll(&entry, 1, 0) >= 0 && (entry.revents & POLLHUP) == 0;
}

// Linux hands bytes over in a work queue; only a read that finds nothing waits for that.
std::string PtyPort::read_available() {
  std::string bytes;
  std::array<char, 4096> buffer{};
  while (master_ >= 0) {
    const ssize_t n = read(master_, buffer.data(), buffer.size());
    if (n <= 0) break;
    bytes.append(buffer.data(), static_cast<std::size_t>(n));
  }
  return bytes;
}

void PtyPort::write(std::string_view bytes) {
  unsent_ += bytes;
  while (master_ >= 0 && !unsent_.empty()) {
    const ssize_t n = ::write(master_, unsent_.data(), unsent_.size());
    if (n <= 0) return;
    n_sent_ += static_cast<std::size_t>(n);
    unsent_.erase(0, static_cast<std::size_t>(n));
  }
}

void PtyPort::discard() {
  unsent_.clear();
  if (master_ < 0) return;
  tcflush(master_, TCIOFLUSH);
  while (!read_available().empty()) {
  }
}

}  // namespace viscard
