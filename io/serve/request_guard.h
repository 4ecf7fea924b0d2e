#pragma once

#include <string>

namespace viscard {

// Who may talk to the program. It listens on 127.0.0.1 only, but any page that a browser on this
// machine shows can send requests there.

struct RequestOrigin {
  std::string host;        // header Host
  std::string origin;      // header Origin; empty if there is none
  std::string fetch_site;  // header Sec-Fetch-Site; empty if there is none
};

// Why a request to this program ("viscard serve") is refused, or "". Another name in Host means that a foreign name was made to point
// to this machine (DNS rebinding); another Origin, that a foreign page sends the request.
std::string refusal_of(const RequestOrigin& request, int port, const std::string& program);

// Compares all characters, so that the time does not depend on the first that differs.
bool is_same_token(const std::string& given, const std::string& token);

// 128 random bits of the system as hexadecimal digits.
std::string random_token();

}  // namespace viscard
