#include "io/basics/timestamp.h"

#include <ctime>

namespace viscard {

std::string now_iso8601() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  char text[32];
  return {text, std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc)};
}

std::string today() {
  return now_iso8601().substr(0, 10);
}

}  // namespace viscard
