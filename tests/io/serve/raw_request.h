#pragma once

#include <string>

namespace viscard::test {

// Sends these bytes to 127.0.0.1 and returns all that comes back until the connection is closed.
std::string answer_to_bytes(int port, const std::string& bytes);

// A connection on which only these bytes were sent. The caller closes it.
int connection_with(int port, const std::string& bytes);

}  // namespace viscard::test
