#pragma once

#include "rig/lines/rig_clock.h"
#include "rig/lines/transport.h"

#include <memory>
#include <string>
#include <string_view>

namespace LibSerial {
class SerialPort;
}

namespace viscard {

// A raw serial port without flow control, held exclusively.
//
// libserial only opens and configures the port. Version 1.0.0 (Debian 12) hangs in ReadLine after
// the cable was pulled, spins in Write when the device stops reading, and aborts the process in
// ~SerialPort when Close() fails (crayzeewulf/libserial issues 135 and 160; fixed after 1.0.0).
// Therefore this class reads and writes by poll(), read() and write() on the descriptor, and never
// destroys a SerialPort that is still open.
class SerialLine final : public Transport {
 public:
  // framing: data bits 7 or 8, parity N, E or O, stop bits 1 or 2. Throws RigError with the reason
  // and the fix: missing, busy, no permission, not a serial port, or an unknown baud rate or
  // framing.
  SerialLine(const std::string& path, int baud, const RigClock& clock,
             const std::string& framing = "8N1");
  ~SerialLine() override;

  std::string name() const override { return path_; }
  int baud() const override { return baud_; }
  int descriptor() const override { return descriptor_; }
  Chunk read_available() override;
  void write(std::string_view bytes, double timeout_s) override;
  bool reopen() override;

 private:
  void open();
  void close();
  Chunk read_once();
  struct SafeClose {
    void operator()(LibSerial::SerialPort* port) const noexcept;
  };

  std::string path_;
  int baud_;
  std::string framing_;
  const RigClock& clock_;
  int lock_descriptor_ = -1;
  std::unique_ptr<LibSerial::SerialPort, SafeClose> port_;
  int descriptor_ = -1;
  int n_empty_reads_ = 0;
};

}  // namespace viscard
