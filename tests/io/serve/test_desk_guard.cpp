// What no request of viscard desk may do: leave its folder, write over a file, or end the program.
#include "io/materials/material_file.h"
#include "io/serve/child_command.h"
#include "io/serve/desk_folder.h"
#include "tests/io/serve/raw_request.h"
#include "tests/io/serve/served_desk.h"
#include "tests/support/error_text.h"
#include "tests/support/run_command.h"

#include <catch2/catch.hpp>

#include <set>

namespace viscard {
namespace {

namespace fs = std::filesystem;
using test::ApiAnswer;
using test::contains;
using test::Json;
using test::message_of;
using test::names_in;
using test::run_command;
using test::ScratchFolder;
using test::ServedDesk;

TEST_CASE("a dropped file is written into the folder only, and replaces nothing", "[serve][desk]") {
  ServedDesk desk;
  const std::string table = ServedDesk::example();
  const auto name_of = [&](const std::string& name) {
    const ApiAnswer answer = desk.drop(name, table);
    CAPTURE(name, answer.json.dump());
    REQUIRE(answer.status == 200);
    return answer.json.at("name").get<std::string>();
  };
  CHECK(name_of("a.csv") == "a.csv");
  CHECK(name_of("a.csv") == "a.2.csv");
  CHECK(name_of("../../a.csv") == "a.3.csv");
  CHECK(name_of("/etc/passwd.csv") == "passwd.csv");
  CHECK(name_of("C:\\data\\b.csv") == "b.csv");
  CHECK(name_of("--out=x.csv") == "out_x.csv");
  CHECK(name_of("uniaxial=c.csv") == "uniaxial_c.csv");
  CHECK(name_of(".hidden.csv") == "hidden.csv");
  CHECK(name_of("a.csv.options") == "a.csv_options");
  CHECK(name_of("two\nlines\x01.csv") == "two_lines_.csv");
  CHECK(name_of("\xc3\xa4 b.csv") == "\xc3\xa4 b.csv");
  CHECK(name_of(std::string(300, 'x') + ".csv").size() <= 100);
  for (const char* none : {"", "..", "/", "a/", "...", "-"}) {
    CAPTURE(none);
    CHECK(desk.drop(none, table).status == 400);
  }
  CHECK(desk.drop("empty.csv", "").status == 400);
  const ApiAnswer scene = desk.drop("scene.toml", "[pillar]\nradius = \"1 um\"\n");
  CHECK(scene.status == 422);
  CHECK(contains(message_of(scene), "the desk takes tables, captures and scenes"));
  CHECK(names_in(desk.folder().parent_path()) == std::set<std::string>{"tables"});
  CHECK(desk.ask("/api/desk").json.at("tables").size() == 12);
}

TEST_CASE("a link that lies in the place of a dropped file is not written through",
          "[serve][desk]") {
  ServedDesk desk;
  const fs::path outside = desk.folder().parent_path() / "outside.csv";
  fs::create_symlink(outside, desk.folder() / "a.csv");
  CHECK(desk.drop("a.csv", ServedDesk::example()).json.at("name") == "a.2.csv");
  CHECK_FALSE(fs::exists(outside));
}

TEST_CASE("no name of a table leads out of the folder of the desk", "[serve][desk]") {
  ServedDesk desk;
  desk.drop("a.csv", ServedDesk::example());
  write_file(desk.folder().parent_path() / "b.csv", ServedDesk::example(), false);
  write_file(desk.folder() / ".b.csv", ServedDesk::example(), false);
  for (const char* foreign : {"../b.csv", "../tables/a.csv", "./a.csv", "/etc/passwd", "..", "",
                              ".", ".b.csv", "none.csv", "a.csv/", "--help"}) {
    CAPTURE(foreign);
    CHECK(desk.order("table", {{"table", foreign}}).status == 404);
    CHECK(desk.order("fit", {{"table", foreign}}).status == 404);
    CHECK(desk.order("card", {{"table", foreign}, {"card", Json::object()}}).status == 404);
  }
}

TEST_CASE("the name of a table is never read as words of a command", "[serve][desk]") {
  ServedDesk desk;
  const fs::path outside = desk.folder().parent_path() / "outside.json";
  write_file(desk.folder() / "words.csv", "--out=" + outside.string() + "\n--force\n", false);
  for (const char* name : {"@words.csv", "--out=b.csv", "relaxation=c.csv"}) {
    CAPTURE(name);
    write_file(desk.folder() / name, ServedDesk::example(), false);
    const ApiAnswer answer = desk.order("fit", {{"table", name}});
    INFO(answer.json.dump());
    CHECK(answer.status == 200);
  }
  CHECK_FALSE(fs::exists(outside));
}

TEST_CASE("a request that is no JSON, or of other values, is refused without words of a library",
          "[serve][desk]") {
  ServedDesk desk;
  desk.drop("a.csv", ServedDesk::example());
  for (const Json& odd : {Json(1), Json::array({1}), Json(nullptr), Json{{"x", 1}}}) {
    for (const char* key : {"table", "tests", "options", "card", "files"}) {
      for (const char* path : {"table", "fit", "card", "predict", "check", "scene", "report"}) {
        Json request = {{"table", "a.csv"}};
        request[key] = odd;
        const ApiAnswer answer = desk.order(path, request);
        CAPTURE(path, request.dump(), answer.json.dump());
        CHECK_FALSE(contains(answer.json.dump(), "json.exception"));
        if (answer.status != 200) CHECK(answer.status / 100 == 4);
      }
    }
  }
}

TEST_CASE("a table that kills or exhausts its fit leaves the desk alive", "[serve][desk]") {
#ifdef __SANITIZE_ADDRESS__  // whose shadow takes more memory than there is
  const ChildLimits limits = GENERATE(ChildLimits{.clock = std::chrono::seconds(0)});
#else
  const ChildLimits limits =
      GENERATE(ChildLimits{.memory_B = 2u << 20}, ChildLimits{.clock = std::chrono::seconds(0)});
#endif
  ServedDesk desk(limits);
  desk.drop("a.csv", ServedDesk::example());
  const ApiAnswer answer = desk.order("fit", {{"table", "a.csv"}});
  INFO(answer.json.dump());
  CHECK(answer.status == 422);
  CHECK(desk.ask("/api/desk").json.at("tables").size() == 1);
}

TEST_CASE("a command in a process of its own is ended by its limits and by the end of the program",
          "[serve][desk]") {
  const std::atomic<bool> no{false}, yes{true};
  const auto run = [](const std::string& script, const ChildLimits& limits,
                      const std::atomic<bool>& is_closing) {
    return run_child("/bin/sh", {"-c", script}, "/", limits, is_closing);
  };
  const ChildEnd plain = run("echo out; echo err >&2; exit 3", {}, no);
  CHECK(plain.status == 3);
  CHECK(plain.out == "out\n");
  CHECK(plain.err == "err\n");
  CHECK(plain.trouble.empty());
  CHECK(contains(run("kill -SEGV $$", {}, no).trouble, "signal 11"));
  CHECK(contains(run("while :; do :; done", {.processor_s = 1}, no).trouble, "processor time"));
  CHECK(contains(run("sleep 100", {.clock = std::chrono::seconds(1)}, no).trouble, "1 s"));
  CHECK(contains(run("sleep 100", {}, yes).trouble, "this program ends"));
  CHECK(run("cat", {}, no).out.empty());
  CHECK(run_child("/bin/cat", {"/dev/stdin", "/dev/stdin"}, "/", {}, no, "text").out == "texttext");
  CHECK(run_child("/nowhere/viscard", {}, "/", {}, no).status == 127);
  CHECK(contains(run("exec yes", {.file_B = 1u << 20}, no).trouble, "wrote more than 1 MiB"));
}

TEST_CASE("the desk has the guard of viscard serve, and takes large files from its page alone",
          "[serve][desk]") {
  ServedDesk desk;
  const std::string right = desk.server().token(), wrong(32, '0');
  const auto status_with = [&](const httplib::Headers& headers, const std::string& body) {
    httplib::Client client("127.0.0.1", desk.server().port());
    const auto result =
        client.Post("/api/desk/drop?name=a.csv", headers, body, "application/octet-stream");
    return result ? result->status : 0;
  };
  std::string large = "time_s,modulus_Pa\n";
  while (large.size() < 1'000'000) large += "1.25,1000000\n";
  CHECK(status_with({{"X-Viscard-Token", right}}, large) == 200);
  CHECK(status_with({{"X-Viscard-Token", wrong}}, "a,b\n1,2\n") == 403);
  CHECK(status_with({}, "a,b\n1,2\n") == 403);
  CHECK(status_with({{"X-Viscard-Token", wrong}}, large) != 200);
  CHECK(status_with({{"X-Viscard-Token", right}, {"Origin", "http://example.org"}}, large) == 403);
  CHECK(status_with({{"X-Viscard-Token", right}, {"Sec-Fetch-Site", "cross-site"}}, large) == 403);
  CHECK(names_in(desk.folder()) == std::set<std::string>{"a.csv"});
  const std::string too_large = test::answer_to_bytes(
      desk.server().port(), "POST /api/desk/drop?name=b.csv HTTP/1.1\r\nHost: 127.0.0.1:" +
                                std::to_string(desk.server().port()) +
                                "\r\nX-Viscard-Token: " + right +
                                "\r\nContent-Type: application/octet-stream\r\nContent-Length: " +
                                std::to_string(kLargestDrop_B + 1) + "\r\n\r\n");
  CHECK(contains(too_large, "413"));
  CHECK(contains(too_large, std::to_string(kLargestDrop_B)));
  // Other requests keep their small limit.
  CHECK(desk.order("fit", {{"table", std::string(100'000, 'x')}}).status != 200);
  CHECK(desk.ask("/rig.html").status == 404);
  CHECK(contains(desk.client().Get("/")->body, "viscard desk"));
}

TEST_CASE("desk refuses words that make no sense", "[serve][cli][desk]") {
  CHECK(run_command({"desk"}).status == kBadWords);
  CHECK(run_command({"desk", "/tmp/x", "--port", "70000"}).status == kBadWords);
  ScratchFolder scratch;
  write_file(scratch / "file", "x", false);
  const auto outcome = run_command({"desk", (scratch / "file").string()});
  CHECK(outcome.status == kFailed);
  CHECK(contains(outcome.err, "name the folder that holds the tables"));
}

TEST_CASE("no dropped file takes a name of what the desk keeps, however the name is written",
          "[serve]") {
  for (const std::string stem : {"report", "r.csv"}) {
    for (const std::string ending : {".options", ".OPTIONS", ".Options"}) {
      for (const std::string tail :
           {"", ".", " ", "..", ". .", "  .  ", "\\", "/", ". /", "\t", "\n", " \x01."}) {
        const std::string name = stem + ending + tail;
        CAPTURE(name);
        std::string plain = plain_file_name(name);
        CHECK(plain == plain_file_name(plain));  // nothing is left to reduce
        for (char& c : plain) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        CHECK_FALSE(plain.ends_with(".options"));
      }
    }
  }
  // Cut to the longest name that is allowed.
  const std::string cut = plain_file_name(std::string(200, 'a') + ".options  x");
  CHECK(cut.size() <= 100);
  CHECK_FALSE(cut.ends_with(".options"));
  CHECK(plain_file_name("curve.csv. ") == "curve.csv");
  CHECK(plain_file_name("my options.csv") == "my options.csv");
}

}  // namespace
}  // namespace viscard
