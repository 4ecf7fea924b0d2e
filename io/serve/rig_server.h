#pragma once

#include "io/serve/rig_api.h"

#include <memory>
#include <string>

namespace viscard {

// The page at the rig, on 127.0.0.1. Requests are answered by threads of its own until the
// destructor ends them.
class RigServer {
 public:
  // Throws std::runtime_error if the port is taken or the folder cannot be used.
  explicit RigServer(ServeOptions options);
  // Stops a run gently and waits for the lift.
  ~RigServer();

  int port() const;
  // The address to open, with the token that gives access.
  std::string address() const;
  std::string token() const;

  // Begins no more work and stops a run gently; the page is still answered. Returns once no run is
  // going on.
  void close();
  // How the last run ended.
  LiveState last_run() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace viscard
