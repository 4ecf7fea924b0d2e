// Who is answered, and what a bad request gets.
#include "io/basics/atomic_file.h"
#include "io/config/config_file.h"
#include "io/serve/deadline_server.h"
#include "io/serve/page_files.h"
#include "io/serve/request_guard.h"
#include "tests/io/serve/raw_request.h"
#include "tests/io/serve/served_rig.h"
#include "tests/support/error_text.h"

#include <catch2/catch.hpp>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <regex>
#include <set>
#include <string>
#include <thread>
#include <vector>

namespace viscard {
namespace {

using test::contains;
using test::Json;
using test::ServedRig;

int status_with(ServedRig& rig, const httplib::Headers& headers) {
  httplib::Client client("127.0.0.1", rig.server().port());
  const auto result = client.Get("/api/state", headers);
  return result ? result->status : 0;
}

std::string code_of(const test::ApiAnswer& answer) {
  return answer.json.at("error").at("code");
}

TEST_CASE("every module that the pages import is served", "[serve]") {
  ServedRig rig;
  std::set<std::string> seen;
  std::vector<std::string> open = {"/app.js", "/desk.js"};
  while (!open.empty()) {
    const std::string name = open.back();
    open.pop_back();
    if (!seen.insert(name).second) continue;
    CAPTURE(name);
    const auto module = rig.client().Get(name);
    REQUIRE(module);
    CHECK(module->status == 200);
    static const std::regex kImport(R"(from "\./([a-z_]+\.js)\")");
    for (std::sregex_iterator at(module->body.begin(), module->body.end(), kImport), end; at != end;
         ++at)
      open.push_back("/" + (*at)[1].str());
  }
  CHECK(seen.size() > 20);
}

TEST_CASE("only the own page with the token is answered", "[serve]") {
  ServedRig rig;
  const std::string token = rig.server().token();
  const std::string host = "127.0.0.1:" + std::to_string(rig.server().port());
  const std::pair<std::string, std::string> right{"X-Viscard-Token", token};
  CHECK(token.size() == 32);
  CHECK(rig.server().address() == "http://" + host + "/#" + token);
  CHECK(status_with(rig, {right}) == 200);
  CHECK(status_with(rig, {right, {"Origin", "http://" + host}}) == 200);
  CHECK(status_with(rig, {right, {"Sec-Fetch-Site", "same-origin"}}) == 200);
  CHECK(status_with(rig, {}) == 403);
  CHECK(status_with(rig, {{"X-Viscard-Token", ""}}) == 403);
  CHECK(status_with(rig, {{"X-Viscard-Token", token.substr(1)}}) == 403);
  CHECK(status_with(rig, {right, {"Origin", "http://example.org"}}) == 403);
  CHECK(status_with(rig, {right, {"Origin", "null"}}) == 403);
  CHECK(status_with(rig, {right, {"Origin", "https://" + host}}) == 403);
  CHECK(status_with(rig, {right, {"Sec-Fetch-Site", "cross-site"}}) == 403);
  CHECK(status_with(rig, {right, {"Host", "rig.example.org"}}) == 403);
  CHECK(status_with(rig, {right, {"Host", "127.0.0.1:1"}}) == 403);
}

TEST_CASE("what follows a refused request on its connection is not read", "[serve]") {
  ServedRig rig;
  const std::string port = std::to_string(rig.server().port());
  const std::string second = "GET /api/state HTTP/1.1\r\nHost: 127.0.0.1:" + port +
                             "\r\nX-Viscard-Token: " + rig.server().token() + "\r\n\r\n";
  const std::string answer =
      test::answer_to_bytes(rig.server().port(),
                            "POST /api/run HTTP/1.1\r\nHost: example.org\r\nContent-Type: "
                            "text/plain\r\nContent-Length: " +
                                std::to_string(second.size()) + "\r\n\r\n" + second);
  CHECK(contains(answer, "HTTP/1.1 403"));
  CHECK_FALSE(contains(answer, "HTTP/1.1 200"));
  CHECK(contains(answer, "Connection: close"));
}

TEST_CASE("connections that send nothing more do not keep a request to stop waiting", "[serve]") {
  ServedRig rig;
  const std::string begun = GENERATE(
      "", "POST /api/run HTTP/1.1\r\nHost: 127", "GET /api/state HTTP/1.1\r\nHost: x\r\n",
      "POST /api/run HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Length: 100\r\n\r\n{",
      "POST /api/run HTTP/1.1\r\nHost: 127.0.0.1\r\nTransfer-Encoding: chunked\r\n\r\n5\r\n{");
  std::vector<int> slow;
  for (int i = 0; i < 40; ++i) slow.push_back(test::connection_with(rig.server().port(), begun));
  const test::ApiAnswer answer = rig.order("/api/run/stop", {{"how", "gently"}});
  CHECK(answer.status >= 400);  // in words: no run is going on
  CHECK(code_of(answer) == "no-run");
  CHECK(rig.ask("/api/state").status == 200);
  for (const int one : slow) ::close(one);
}

TEST_CASE("of too many connections that send nothing the oldest are ended", "[serve]") {
  ServedRig rig;
  std::vector<int> slow;
  for (int i = 0; i < 200; ++i) slow.push_back(test::connection_with(rig.server().port(), "G"));
  CHECK(rig.ask("/api/state").status == 200);
  char byte = 0;
  CHECK(::recv(slow.front(), &byte, 1, 0) == 1);  // "HTTP/1.1 503"
  for (const int one : slow) ::close(one);
}

TEST_CASE("a chunked body has the limit of the others", "[serve]") {
  ServedRig rig;
  std::string body;
  for (int i = 0; i < 20; ++i) body += "1000\r\n" + std::string(0x1000, ' ') + "\r\n";
  const std::string answer =
      test::answer_to_bytes(rig.server().port(),
                            "POST /api/run HTTP/1.1\r\nHost: 127.0.0.1\r\nTransfer-Encoding: "
                            "chunked\r\n\r\n" +
                                body + "0\r\n\r\n");
  CHECK(contains(answer, "413"));
}

TEST_CASE("each start of the program has another token", "[serve]") {
  std::set<std::string> tokens;
  for (int i = 0; i < 100; ++i) tokens.insert(random_token());
  CHECK(tokens.size() == 100);
  CHECK(is_same_token("ab", "ab"));
  CHECK_FALSE(is_same_token("", ""));
  CHECK_FALSE(is_same_token("ab", "abc"));
  CHECK_FALSE(is_same_token("abc", "abd"));
}

TEST_CASE("the page comes with the program and loads nothing from elsewhere", "[serve]") {
  ServedRig rig;
  REQUIRE(page_files().size() >= 4);
  for (const PageFile& file : page_files()) {
    CAPTURE(file.path);
    httplib::Client client("127.0.0.1", rig.server().port());
    const std::string path = file.path;
    if (path == "/desk.html") continue;                                        // of another door
    const auto result = client.Get(path == "/rig.html" ? "/" : path.c_str());  // without a token
    REQUIRE(result);
    CHECK(result->status == 200);
    CHECK(result->body == file.text);
    CHECK(result->get_header_value("Content-Type") == file.type);
    CHECK(contains(result->get_header_value("Content-Security-Policy"),
                   "default-src 'none'; script-src 'self'"));
    if (std::string(file.path).rfind("/dygraph", 0) == 0) continue;
    CHECK_FALSE(contains(std::string(file.text), "https://"));
    CHECK_FALSE(contains(std::string(file.text), "innerHTML"));
  }
}

TEST_CASE("a bad request is refused in words", "[serve]") {
  ServedRig rig;
  const std::string name = rig.prepare();
  const auto post = [&](const char* path, const std::string& body, const char* type) {
    return rig.client().Post(path, body, type);
  };
  CHECK(post("/api/run", "{", "application/json")->status == 400);
  CHECK(contains(post("/api/run", "{", "application/json")->body, "the request is not JSON"));
  CHECK(post("/api/run", "[]", "application/json")->status == 400);
  CHECK(post("/api/test", R"({"test": {"hold_s": 1e999}})", "application/json")->status == 400);
  const std::string deep =
      R"({"test": {"hold_s": )" + std::string(20'000, '[') + std::string(20'000, ']') + "}}";
  CHECK(post("/api/test", deep, "application/json")->status == 400);
  CHECK(post("/api/run", "{}", "text/plain")->status == 415);
  CHECK(post("/api/run", std::string(100'000, 'x'), "application/json")->status == 413);
  CHECK(code_of(rig.order("/api/run", Json::object())) == "bad-value");
  CHECK(rig.order("/api/run", {{"specimen", 3}}).status == 400);
  CHECK(rig.order("/api/run", {{"specimen", name}, {"repeat", "yes"}}).status == 400);
  CHECK(code_of(rig.order("/api/test", {{"test", {{"depth_m", "deep"}}}})) == "bad-value");
  CHECK(code_of(rig.order("/api/test", {{"test", {{"deepness", 1.0}}}})) == "bad-value");
  CHECK(code_of(rig.order("/api/run/stop", {{"how", "softly"}})) == "bad-value");
  CHECK(code_of(rig.order("/api/run/stop", {{"how", "gently"}})) == "no-run");
  CHECK(rig.ask("/api/run?from=-1").status == 400);
  CHECK(rig.ask("/api/nothing").status == 404);
  const Json error = rig.order("/api/run", {{"specimen", "none"}}).json.at("error");
  CHECK(error.size() == 4);
  CHECK(error.at("message") == "there is no specimen 'none' in " + rig.folder().string());
  CHECK(error.at("hint") == "Choose one of the list, or add it");
}

TEST_CASE("no name leads out of the folder of the series", "[serve]") {
  ServedRig rig;
  const std::string name = rig.prepare();
  for (const char* path : {"/../CMakeLists.txt", "/%2e%2e/%2e%2e/etc/passwd", "/page/index.html",
                           "//etc/passwd", "/series/test.toml"}) {
    CAPTURE(path);
    CHECK(rig.ask(path).status == 404);
  }
  for (const char* foreign : {"../../etc/passwd", "/etc/passwd", "..", "", "test", "rig"}) {
    CAPTURE(foreign);
    CHECK(rig.order("/api/fit", {{"capture", foreign}}).status == 404);
    CHECK(rig.order("/api/run", {{"specimen", foreign}}).status == 404);
    CHECK(rig.order("/api/specimens/remove", {{"name", foreign}}).status == 404);
  }
  Json strange = ServedRig::specimen();
  strange["id"] = "../../../tmp/ä: \"x\"";
  const auto added = rig.order("/api/specimens", {{"specimen", strange}});
  REQUIRE(added.status == 200);
  CHECK(added.json.at("name") == "02_tmp-x");
  CHECK(read_specimen(rig.folder() / "02_tmp-x.toml").id == strange["id"].get<std::string>());
}

TEST_CASE("the pre-flight check reaches the page in numbers and words", "[serve]") {
  ServedRig rig;
  const std::string name = rig.prepare();
  const Json good = rig.order("/api/preflight", {{"specimen", name}}).json;
  INFO(good.dump());
  CHECK(good.at("problems").empty());
  CHECK(good.at("peak_force_N").get<double>() < good.at("limit_N").get<double>());
  const Json& course = good.at("course");
  CHECK(course.at("time_s").size() == course.at("force_N").size());
  CHECK(good.at("duration_s") == course.at("time_s").back());

  const Json deep = {{"depth_m", 0.25e-3}};
  const Json bad = rig.order("/api/preflight", {{"specimen", name}, {"test", deep}}).json;
  REQUIRE(bad.at("problems").size() == 1);
  CHECK(contains(bad.at("problems").at(0), "Lower depth under [ramp] of the test file to"));
  CHECK(read_test(rig.folder() / "test.toml").depth_m == Approx(0.13e-3));  // nothing was saved

  REQUIRE(rig.order("/api/test", {{"test", deep}}).status == 200);
  CHECK(read_test(rig.folder() / "test.toml").depth_m == Approx(0.25e-3));
  const auto refused = rig.order("/api/run", {{"specimen", name}});
  CHECK(refused.status == 422);
  CHECK(code_of(refused) == "preflight");
  const auto senseless = rig.order("/api/test", {{"test", {{"hold_s", 1e30}}}});
  CHECK(senseless.status == 422);
  CHECK(contains(senseless.json.at("error").at("message"), "hold"));
}

TEST_CASE("a specimen without a capture can be removed, a mistake in a file is shown", "[serve]") {
  ServedRig rig;
  const std::string name = rig.prepare();
  CHECK(rig.order("/api/specimens/remove", {{"name", name}}).status == 200);
  CHECK(rig.ask("/api/state").json.at("specimens").empty());
  Json thick = ServedRig::specimen();
  thick["modulus_guess_Pa"] = 2.0;  // MPa forgotten
  CHECK(rig.order("/api/specimens", {{"specimen", thick}}).status == 422);
  std::ofstream(rig.folder() / "07_by_hand.toml") << "id = \"x\"\nmodulus = 3\n";
  const Json shown = rig.ask("/api/state").json.at("specimens").at(0);
  CHECK(shown.at("name") == "07_by_hand");
  CHECK(contains(shown.at("trouble"), "07_by_hand.toml:"));
  CHECK(rig.order("/api/specimens", {{"specimen", ServedRig::specimen()}}).json.at("name") ==
        "08_pdms-1-10");
}

TEST_CASE("specimens are ordered by the numbers of their names, and never share captures",
          "[serve]") {
  ServedRig rig;
  const std::string file = read_file(rig.folder() / (rig.prepare() + ".toml"));
  for (const char* name : {"100_c", "9_b", "9_b.2", "20251122204500123_x"}) {
    write_file(rig.folder() / (std::string(name) + ".toml"), file, false);
  }
  const Json specimens = rig.ask("/api/state").json.at("specimens");
  std::string names;
  for (const Json& one : specimens) names += one.at("name").get<std::string>() + " ";
  CHECK(names == "20251122204500123_x 01_pdms-1-10 9_b 9_b.2 100_c ");
  CHECK(contains(specimens.at(3).at("trouble"), "would have the names of those of '9_b'"));
  CHECK(rig.order("/api/run", {{"specimen", "9_b.2"}}).status == 422);
  CHECK(rig.order("/api/preflight", {{"specimen", "9_b.2"}}).status == 422);
  CHECK(rig.order("/api/specimens", {{"specimen", ServedRig::specimen()}}).json.at("name") ==
        "101_pdms-1-10");
}

TEST_CASE("a test that has changed since the page showed it is not started", "[serve]") {
  ServedRig rig;
  const std::string name = rig.prepare();
  const Json shown = rig.ask("/api/state").json.at("test");
  REQUIRE(rig.order("/api/test", {{"test", {{"hold_s", 5.0}}}}).status == 200);
  const auto refused = rig.order("/api/run", {{"specimen", name}, {"test", shown}});
  CHECK(refused.status == 409);
  CHECK(code_of(refused) == "changed");
  CHECK(rig.ask("/api/state").json.at("job") == "");
}

TEST_CASE("a folder that is gone or cannot be written to is reported, and nothing is lost",
          "[serve]") {
  ServedRig rig;
  const std::string name = rig.prepare();
  const Json wanted = {{"specimen", ServedRig::specimen()}};
  CHECK(rig.ask("/api/state").json.at("folder_trouble") == "");
  namespace fs = std::filesystem;
  fs::permissions(rig.folder().parent_path(), fs::perms(0755));
  fs::permissions(rig.folder(), fs::perms(0555));
  const bool is_root = ::geteuid() == 0;
  if (is_root) REQUIRE(::seteuid(65534) == 0);
  const Json state = rig.ask("/api/state").json;
  const auto refused = rig.order("/api/specimens", wanted);
  const auto test = rig.order("/api/test", {{"test", {{"hold_s", 5.0}}}});
  if (is_root) REQUIRE(::seteuid(0) == 0);
  fs::permissions(rig.folder(), fs::perms(0755));
  CHECK(contains(state.at("folder_trouble"), "cannot be written to: Permission denied"));
  CHECK(state.at("specimens").size() == 1);
  CHECK(refused.status == 422);
  CHECK(contains(refused.json.at("error").at("where"), rig.folder().string()));
  CHECK(test.status == 422);
  CHECK(read_test(rig.folder() / "test.toml").hold_s == 4.0);

  fs::remove_all(rig.folder());
  CHECK(contains(rig.ask("/api/state").json.at("folder_trouble"), "is gone"));
  CHECK(rig.order("/api/specimens", wanted).status == 422);
  CHECK(rig.order("/api/run", {{"specimen", name}}).status == 404);
}

TEST_CASE("a folder that cannot be made is refused in words", "[serve]") {
  const std::string text =
      test::error_text([] { RigServer({.folder = "/proc/viscard/series", .is_emulated = true}); });
  CHECK(contains(text, "/proc/viscard/series: cannot create this folder"));
  CHECK(contains(text, "Name one that you may write to"));
}

TEST_CASE("a port that another program has is refused", "[serve]") {
  ServedRig rig;
  test::ScratchFolder scratch;
  const int port = rig.server().port();
  CHECK(contains(test::error_text([&] {
                   RigServer({.folder = scratch.path(), .is_emulated = true, .port = port});
                 }),
                 "Leave --port out"));
}

TEST_CASE("an answer that takes longer to work out than it may take to send is sent", "[serve]") {
  ConnectionLimits limits;
  limits.answer = std::chrono::milliseconds(200);
  DeadlineServer server(limits, [](const std::string&) { return false; });
  server.Get("/slow", [](const httplib::Request&, httplib::Response& response) {
    std::this_thread::sleep_for(std::chrono::milliseconds(700));
    response.set_content("worked out", "text/plain");
  });
  const int port = server.bind_to_any_port("127.0.0.1");
  std::thread listening([&] { server.listen_after_bind(); });
  const std::string answer =
      test::answer_to_bytes(port, "GET /slow HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n");
  server.stop();
  listening.join();
  CHECK(answer.find("200 OK") != std::string::npos);
  CHECK(answer.find("worked out") != std::string::npos);
}

}  // namespace
}  // namespace viscard
