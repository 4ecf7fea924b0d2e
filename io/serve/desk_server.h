#pragma once

#include "io/serve/desk_api.h"

#include <memory>
#include <string>

namespace viscard {

// The desk in the browser, on 127.0.0.1. Threads of its own answer until the destructor ends them.
class DeskServer {
 public:
  // Throws std::runtime_error if the port is taken or the folder cannot be used.
  explicit DeskServer(const DeskOptions& options);
  // Ends the commands that are running.
  ~DeskServer();

  int port() const;
  // The address to open, with the token that gives access.
  std::string address() const;
  std::string token() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace viscard
