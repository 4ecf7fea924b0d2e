#pragma once

#include "rig/lines/rig_clock.h"
#include "rig/lines/transport.h"

#include <memory>
#include <string>
#include <string_view>

namespace viscard {

// An instrument, or the serial port of a device server, that is reached over TCP. Nothing of the connection itself ends
// lines: a reply may arrive in pieces, or several together. The network holds bytes back, so the other end is gone if
// it has taken none of ours for 10 s, or if nothing answers the system's own questions for as long.
class TcpLine final : public Transport {
 public:
  // Throws PortUnavailable: a name without host or number, nobody there, refused, or no answer within 3 s.
  TcpLine(const std::string& port, const RigClock& clock);
  ~TcpLine() override;

  std::string name() const override { return port_; }
  int baud() const override { return 10'000'000; }  // about what the slowest network carries
  std::string question() const override {
    return "is this the port number of the instrument, and has its device server the baud rate of "
           "the instrument?";
  }
  int descriptor() const override { return descriptor_; }
  Chunk read_available() override;
  void write(std::string_view bytes, double timeout_s) override;
  bool reopen() override;

 private:
  void open();
  void close();

  std::string port_;
  const RigClock& clock_;
  int descriptor_ = -1;
};

// The port of a device: a serial line, TCP, or USB-TMC. Throws RigError as they do.
std::unique_ptr<Transport> open_line(const std::string& port, int baud, const RigClock& clock,
                                     const std::string& framing = "8N1");

}  // namespace viscard
