#pragma once

#include "rig/lines/rig_clock.h"
#include "rig/lines/transport.h"

#include <condition_variable>
#include <deque>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>

namespace viscard {

// An instrument with USB-TMC behind the usbtmc driver of Linux ("/dev/usbtmc0"). A write is one message; a message with
// a question mark is answered by one message, which is read only after the status byte of the instrument announces it
// (MAV): a read without an answer blocks for the whole deadline and confuses many instruments. The kernel's poll()
// announces service requests and not data, so a thread of its own writes and reads, and hands the answers on through a
// pipe. Each answer ends with a newline there, also if the instrument sends none.
//
// Sources: drivers/usb/class/usbtmc.c and include/uapi/linux/usb/tmc.h of Linux; pyvisa-py issue 177 and python-usbtmc
// issue 49 for reads without an answer.
class UsbtmcLine final : public Transport {
 public:
  // Throws PortUnavailable with the reason and the fix.
  UsbtmcLine(const std::string& path, const RigClock& clock);
  // On a descriptor that keeps the borders of messages, and which it closes; for tests.
  UsbtmcLine(int device, const std::string& name, const RigClock& clock);
  ~UsbtmcLine() override;

  std::string name() const override { return path_; }
  int baud() const override { return 10'000'000; }  // far below what USB carries
  std::string question() const override {
    return "is it set to USB-TMC (often called USB, not USB-CDC or virtual COM port)?";
  }
  int descriptor() const override { return answers_; }
  Chunk read_available() override;
  // Never waits: the thread passes the message on. A question replaces one that has not gone out yet.
  void write(std::string_view bytes, double timeout_s) override;
  bool reopen() override;

 private:
  void open();
  void begin(int device);
  void end();
  void work();
  bool take_next(std::string& message);
  bool await_answer();
  void read_answer();
  void recover() const;
  void hang_up(const std::string& why);

  std::string path_;
  const RigClock& clock_;
  int device_ = -1;                  // of the thread
  int answers_ = -1, hand_on_ = -1;  // ends of the pipe
  bool has_status_ = false, has_seen_mav_ = false;
  std::thread thread_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<std::string> outbox_;
  bool is_ending_ = false;
  std::string trouble_;  // why the instrument is gone
};

}  // namespace viscard
