#pragma once

#include <stdexcept>
#include <string>

namespace viscard {

// A request that cannot be carried out: what the page receives with an HTTP status.
class ApiError : public std::runtime_error {
 public:
  // code: one short stable word for programs, such as "busy".
  ApiError(int status, std::string code, const std::string& message)
      : std::runtime_error(message), status_(status), code_(std::move(code)) {}
  int status() const { return status_; }
  const std::string& code() const { return code_; }

 private:
  int status_;
  std::string code_;
};

}  // namespace viscard
