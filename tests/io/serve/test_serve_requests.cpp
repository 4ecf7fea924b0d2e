// Who is answered, and what a bad request gets.
#include "io/config/config_file.h"
#include "io/serve/page_files.h"
#include "io/serve/request_guard.h"
#include "tests/io/serve/served_rig.h"
#include "tests/support/error_text.h"

#include <catch2/catch.hpp>

#include <set>

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
    const auto result = client.Get(file.path);  // without a token
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
  CHECK(code_of(refused) == "refused");
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

TEST_CASE("a port that another program has is refused", "[serve]") {
  ServedRig rig;
  test::ScratchFolder scratch;
  const int port = rig.server().port();
  CHECK(contains(test::error_text([&] {
                   RigServer({.folder = scratch.path(), .is_emulated = true, .port = port});
                 }),
                 "Leave --port out"));
}

}  // namespace
}  // namespace viscard
