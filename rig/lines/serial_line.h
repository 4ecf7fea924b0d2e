#pragma once

#include "rig/lines/line_splitter.h"
#include "rig/lines/rig_clock.h"
#include "rig/lines/transport.h"

#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace LibSerial {
class SerialPort;
}

namespace viscard {

// A serial port: no flow control, raw, held exclusively.
//
// libserial opens and configures it. It does not read, write or get destroyed on its own, because
// version 1.0.0 (Debian 12) hangs in ReadLine after the cable was pulled, spins in Write when the
// peer stops reading, and aborts the process in ~SerialPort when Close() fails
// (crayzeewulf/libserial issues 135, 160; fixed after 1.0.0). So bytes go by poll()/read()/write()
// on its descriptor, and the closing path never lets an open SerialPort be destroyed.
class SerialLine final : public Transport {
 public:
  // Throws RigError with the reason and the fix: missing, busy, no permission, not a serial port,
  // baud rate that termios does not know. framing: data bits 7 or 8, parity N E O, stop bits 1
  // or 2.
  SerialLine(const std::string& path, int baud, const RigClock& clock,
             const std::string& framing = "8N1");
  ~SerialLine() override;

  std::string name() const override { return path_; }
  int baud() const override { return baud_; }
  int descriptor() const override { return descriptor_; }
  Chunk read_available() override;
  void write(std::string_view bytes, double timeout_s) override;

 private:
  struct SafeClose {
    void operator()(LibSerial::SerialPort* port) const noexcept;
  };

  std::string path_;
  int baud_;
  const RigClock& clock_;
  int lock_descriptor_ = -1;
  std::unique_ptr<LibSerial::SerialPort, SafeClose> port_;
  int descriptor_ = -1;
  int n_empty_reads_ = 0;
};

// Waits up to timeout_s (wall) for one whole line; what is left over stays in the splitter for the
// next call. Nothing on time-out, which is kept to the millisecond. Throws PortHungUp.
std::optional<ReceivedLine> read_line(Transport& transport, LineSplitter& splitter,
                                      double timeout_s);

}  // namespace viscard
