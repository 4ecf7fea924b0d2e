// Whole commands on damaged files, and requests of the pages, each answered or refused with a text. The environment
// variable VISCARD_FUZZ_TARGET names the kind, else the first byte picks it:
//   certificate  the input is a certificate: card --verify
//   capture      the input overwrites bytes of a capture (three of position, one of value): fit --unverified
//   desk rig     the input is the JSON of a request, its first byte picks which
//   http         the input is what a client sends to the desk
#include "io/basics/atomic_file.h"
#include "io/cli/command.h"
#include "io/serve/desk_api.h"
#include "io/serve/desk_server.h"
#include "io/serve/rig_api.h"
#include "tests/fuzz/fuzz_folder.h"
#include "tests/io/serve/raw_request.h"

#include <nlohmann/json.hpp>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <sstream>
#include <string>
#include <string_view>

namespace {

using namespace viscard;
using Json = nlohmann::ordered_json;

// A command that fails prints why.
int run(const Words& words) {
  std::ostringstream out, err;
  Streams streams{out, err, false};
  const int status = run_viscard(words, streams);
  if (status != kDone && err.str().empty() && out.str().empty()) __builtin_trap();
  return status;
}

void verify_certificate(const std::string& bytes) {
  const std::string file = (fuzz_folder() / "fuzz.proof.json").string();
  write_file(file, bytes, true);
  (void)run({"card", "--verify", file});
}

// A short indentation on the emulated rig, made once.
const std::string& whole_capture() {
  static const std::string bytes = [] {
    const auto folder = fuzz_folder();
    write_file(folder / "test.toml",
               "[approach]\nspeed = \"0.5 mm/s\"\nbaseline = \"1 s\"\n"
               "[ramp]\ndepth = \"0.1 mm\"\nduration = \"0.2 s\"\nhold = \"3 s\"\n"
               "[retract]\nspeed = \"1 mm/s\"\ndistance = \"0.5 mm\"\n",
               true);
    const std::string demo = VISCARD_FUZZ_DATA "/demo/";
    const std::string out = (folder / "whole.viscap").string();
    const int status = run({"capture", "--emulate", "--speed", "20", "--seed", "3", "--rig",
                            demo + "01_rig.toml", "--test", (folder / "test.toml").string(),
                            "--specimen", demo + "03_pdms_1to10.toml", "--out", out});
    if (status != kDone) std::abort();
    return read_file(out);
  }();
  return bytes;
}

void fit_capture(const std::string& bytes) {
  std::string whole = whole_capture();
  for (std::size_t i = 0; i + 3 < bytes.size(); i += 4) {
    std::size_t place = 0;
    for (std::size_t k = 0; k < 3; ++k)
      place = place << 8U | static_cast<std::uint8_t>(bytes[i + k]);
    whole[place % whole.size()] = bytes[i + 3];
  }
  const std::string file = (fuzz_folder() / "fuzz.viscap").string();
  write_file(file, whole, true);
  (void)run({"fit", file, "--terms", "1", "--unverified"});
}

// The first byte and the rest as JSON; nothing if it is none.
template <class Api, std::size_t n>
void ask(Api& api, const std::array<Json (Api::*)(const Json&), n>& requests,
         const std::string& bytes) {
  if (bytes.empty()) return;
  const Json request = Json::parse(bytes.substr(1), nullptr, false);
  if (!request.is_discarded())
    (void)(api.*requests[static_cast<std::uint8_t>(bytes[0]) % n])(request);
}

// No command runs: what it would print is missing, which the desk reports.
DeskOptions desk_options() {
  return {.folder = fuzz_folder() / "tables", .program = "/bin/true", .limits = {}};
}

void ask_desk(const std::string& bytes) {
  static DeskApi api(desk_options());
  ask<DeskApi, 5>(
      api, {&DeskApi::table, &DeskApi::fit, &DeskApi::card, &DeskApi::predict, &DeskApi::check},
      bytes);
}

void ask_rig(const std::string& bytes) {
  static RigApi& api = []() -> RigApi& {
    ServeOptions options;
    options.folder = fuzz_folder() / "series";
    options.is_emulated = true;
    static RigApi one(options);
    return one;
  }();
  ask<RigApi, 5>(api,
                 {&RigApi::save_test, &RigApi::add_specimen, &RigApi::remove_specimen,
                  &RigApi::stop_run, &RigApi::fit},
                 bytes);
}

void send_bytes(const std::string& bytes) {
  static const DeskServer server(desk_options());
  const int connection = test::connection_with(server.port(), bytes);
  ::shutdown(connection, SHUT_WR);
  std::array<char, 4096> buffer{};
  while (::recv(connection, buffer.data(), buffer.size(), 0) > 0) {
  }
  ::close(connection);
}

struct Kind {
  std::string_view name;
  void (*read)(const std::string&);
};
constexpr std::array<Kind, 5> kKinds{{{"certificate", verify_certificate},
                                      {"capture", fit_capture},
                                      {"desk", ask_desk},
                                      {"rig", ask_rig},
                                      {"http", send_bytes}}};

const Kind& kind_of(std::uint8_t first) {
  static const char* const name = std::getenv("VISCARD_FUZZ_TARGET");
  if (name == nullptr) return kKinds[first % kKinds.size()];
  for (const Kind& kind : kKinds) {
    if (kind.name == name) return kind;
  }
  std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  try {
    kind_of(data[0]).read(std::string(reinterpret_cast<const char*>(data) + 1, size - 1));
  } catch (const std::exception& error) {  // the server makes an answer of any
    if (std::string(error.what()).empty()) __builtin_trap();
  }
  return 0;
}
