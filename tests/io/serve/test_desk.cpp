// What the requests of viscard desk do with tables, cards, scenes and reports.
#include "io/materials/material_file.h"
#include "io/serve/child_command.h"
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

TEST_CASE(
    "a dropped table is shown as it was read, fitted as the command fits it, and becomes a card",
    "[serve][desk]") {
  ServedDesk desk;
  const ApiAnswer dropped = desk.drop("pdms.csv", ServedDesk::example());
  INFO(dropped.json.dump());
  REQUIRE(dropped.status == 200);
  CHECK(dropped.json.at("name") == "pdms.csv");
  CHECK(read_file(desk.folder() / "pdms.csv") == ServedDesk::example());
  CHECK(desk.ask("/api/desk").json.at("tables").at(0).at("name") == "pdms.csv");

  const Json read = desk.order("table", {{"table", "pdms.csv"}}).json;
  INFO(read.dump());
  CHECK(read.at("command") == "viscard fit pdms.csv --show-table");
  CHECK(read.at("result").at("kind") == "relaxation");
  CHECK(read.at("result").at("columns").at(0).at("quantity") == "time_s");

  const Json fitted = desk.order("fit", {{"table", "pdms.csv"}}).json;
  const auto typed = run_command({"fit", (desk.folder() / "pdms.csv").string(), "--json"});
  const Json own = Json::parse(typed.out);
  for (const char* key : {"E0_Pa", "E0_interval_95", "terms", "orders", "flags", "rss"}) {
    CAPTURE(key);
    CHECK(fitted.at("result").at(key) == own.at(key));
  }
  CHECK(fitted.at("command") == "viscard fit pdms.csv");
  const Json& curves = fitted.at("result").at("curves");
  const std::size_t n = curves.at("values").size();
  CHECK(n > 10);
  CHECK(curves.at("columns").at(0).at("measured").size() == n);
  CHECK(curves.at("columns").at(0).at("fitted").size() == n);

  const Json wanted = {{"table", "pdms.csv"}, {"card", {{"for", "abaqus"}, {"units", "mm-t-s"}}}};
  const Json card = desk.order("card", wanted).json;
  INFO(card.dump());
  CHECK(card.at("material") == "pdms.json");
  CHECK(card.at("fit_command") == "test -e pdms.json || viscard fit pdms.csv --out=pdms.json");
  CHECK(card.at("command") == "viscard card pdms.json --for=abaqus --units=mm-t-s");
  CHECK(contains(card.at("result").at("card"), "*VISCOELASTIC"));
  CHECK_FALSE(contains(card.at("result").at("card"), "--json"));
  CHECK(read_material(desk.folder() / "pdms.json").material.E0_Pa == own.at("E0_Pa").get<double>());
}

TEST_CASE("the same fit keeps its material, another one gets a name that is free",
          "[serve][desk]") {
  ServedDesk desk;
  desk.drop("a.csv", ServedDesk::example());
  const auto material = [&](const Json& options) {
    const ApiAnswer answer = desk.order(
        "card",
        {{"table", "a.csv"}, {"options", options}, {"card", {{"for", "abaqus"}, {"units", "SI"}}}});
    INFO(answer.json.dump());
    REQUIRE(answer.status == 200);
    return answer.json.at("material").get<std::string>();
  };
  CHECK(material(Json::object()) == "a.json");
  const std::string first = read_file(desk.folder() / "a.json");
  CHECK(material(Json::object()) == "a.json");
  CHECK(material({{"terms", "1"}}) == "a.2.json");
  CHECK(material({{"terms", "1"}}) == "a.2.json");
  CHECK(material(Json::object()) == "a.json");
  CHECK(read_file(desk.folder() / "a.json") == first);
  CHECK(names_in(desk.folder()) == std::set<std::string>{"a.csv", "a.json", "a.2.json"});
  // A material that another version wrote, or that was edited, is not this fit.
  MaterialFile older = read_material(desk.folder() / "a.json");
  older.material.provenance.created_by = "viscard 0.0.1";
  older.material.E0_Pa *= 1.1;
  write_file(desk.folder() / "a.json", json_from_material(older), true);
  CHECK(material(Json::object()) == "a.3.json");
  CHECK(material(Json::object()) == "a.3.json");
  std::string edited = read_file(desk.folder() / "a.3.json");
  edited.insert(edited.find_first_of("0123456789", edited.find("\"E0_Pa\":") + 8), "1");
  write_file(desk.folder() / "a.3.json", edited, true);
  CHECK(material(Json::object()) == "a.4.json");
}

TEST_CASE("a report of the desk has the options of the folder, and the title of the page first",
          "[serve][desk]") {
  ServedDesk desk;
  desk.drop("a.csv", ServedDesk::example());
  write_file(desk.folder() / "report.options", "--title=House\n\n--logo=logo.svg\n", false);
  write_file(desk.folder() / "logo.svg", "<svg/>", false);
  const Json house = desk.order("report", {{"tables", {"a.csv"}}}).json;
  CHECK(contains(house.at("html"), "<h1>House</h1>"));
  CHECK(contains(house.at("html"), "data:image/svg+xml"));
  const Json own = desk.order("report", {{"tables", {"a.csv"}}, {"title", "Mine"}}).json;
  CHECK(contains(own.at("html"), "<h1>Mine</h1>"));
  CHECK(contains(own.at("html"), "data:image/svg+xml"));
}

TEST_CASE("tests of one material are fitted together, and their material is kept",
          "[serve][desk]") {
  ServedDesk desk;
  desk.drop("a.csv", ServedDesk::example());
  const std::string example = ServedDesk::example();
  desk.drop("b.csv", example.substr(0, example.rfind('\n', example.size() - 2) + 1));
  const Json tests = {{{"table", "a.csv"}, {"kind", "relaxation"}},
                      {{"table", "b.csv"}, {"kind", "relaxation"}}};
  const Json fitted = desk.order("fit", {{"tests", tests}}).json;
  INFO(fitted.dump());
  CHECK(fitted.at("command") == "viscard fit relaxation=a.csv relaxation=b.csv");
  CHECK(fitted.at("result").at("tests").size() == 2);
  CHECK(fitted.at("result").at("tests").at(0).at("residuals").at("fitted").size() > 10);
  const Json wanted = {{"tests", tests}, {"card", {{"for", "abaqus"}}}};
  for (int i = 0; i < 2; ++i) {
    const Json card = desk.order("card", wanted).json;
    CHECK(card.at("material") == "a+b.json");
    CHECK(card.at("fit_command") ==
          "test -e a+b.json || viscard fit relaxation=a.csv relaxation=b.csv --out=a+b.json");
  }
  CHECK(desk.order("predict", {{"tests", tests}, {"predict", {{"test", "creep"}}}}).status == 200);
  // Of the options that are kept beside them those of all hold; they must be read alike.
  const auto keep = [&](const char* table, const Json& options) {
    REQUIRE(desk.order("table", {{"table", table}, {"options", options}}).status == 200);
  };
  keep("a.csv", {{"terms", "1"}, {"density", "965"}});
  keep("b.csv", {{"terms", "2"}, {"density", "965"}});
  CHECK(desk.order("fit", {{"tests", tests}}).json.at("command") ==
        "viscard fit relaxation=a.csv relaxation=b.csv --density=965");
  keep("b.csv", {{"modulus-kind", "shear"}});
  const ApiAnswer differ = desk.order("fit", {{"tests", tests}});
  CHECK(differ.status == 422);
  CHECK(contains(message_of(differ), "a.csv and b.csv are not read alike (--modulus-kind=shear)"));
  CHECK(desk.order("fit", {{"tests", tests}, {"options", Json::object()}}).status == 200);
  for (const Json& wrong : {Json::array(), Json("a.csv"), Json{tests[0], "b.csv"},
                            Json{tests[0], {{"table", "b.csv"}, {"kind", "--out=x"}}},
                            Json{tests[0], {{"table", "b.csv"}}}}) {
    CAPTURE(wrong.dump());
    CHECK(desk.order("fit", {{"tests", wrong}}).status == 400);
  }
  const Json gone = {tests[0], {{"table", "../c.csv"}, {"kind", "creep"}}};
  CHECK(desk.order("fit", {{"tests", gone}}).status == 404);
}

TEST_CASE(
    "specimens of several mixing ratios are fitted by their ratio, and give a card of any between",
    "[serve][desk]") {
  ServedDesk desk;
  desk.drop("a.csv", ServedDesk::example());
  desk.drop("b.csv", ServedDesk::example(0.5));
  desk.drop("c.csv", ServedDesk::example(0.51));
  const Json tests = {{{"table", "a.csv"}, {"ratio", "10"}},
                      {{"table", "b.csv"}, {"ratio", "20"}},
                      {{"table", "c.csv"}, {"ratio", "20"}}};
  const ApiAnswer fitted = desk.order("fit", {{"tests", tests}});
  INFO(fitted.json.dump());
  REQUIRE(fitted.status == 200);
  CHECK(fitted.json.at("command") ==
        "viscard fit --joint a.csv b.csv c.csv --ratio=10 --ratio=20 --ratio=20");
  CHECK(fitted.json.at("result").at("materials").size() == 2);
  for (int i = 0; i < 2; ++i) {
    const Json card =
        desk.order("card", {{"tests", tests}, {"card", {{"for", "abaqus"}, {"ratio", "15"}}}}).json;
    INFO(card.dump());
    CHECK(card.at("material") == "a+b+c.json");
    CHECK(contains(card.at("result").at("card"), "*VISCOELASTIC"));
  }
  desk.order("table", {{"table", "a.csv"}, {"options", {{"column", {"time_s=1"}}}}});
  CHECK(contains(message_of(desk.order("fit", {{"tests", tests}})), "are not read alike"));
  for (const Json& wrong : {Json{tests[0], {{"table", "b.csv"}, {"kind", "relaxation"}}},
                            Json{tests[0], {{"table", "b.csv"}, {"ratio", ""}}},
                            Json{tests[0], {{"table", "b.csv"}, {"ratio", 20}}}}) {
    CAPTURE(wrong.dump());
    CHECK(desk.order("fit", {{"tests", wrong}, {"options", Json::object()}}).status == 400);
  }
}

TEST_CASE("the desk starts a master curve from given shifts as the command does, and keeps them",
          "[serve][desk]") {
  ServedDesk desk;
  desk.drop("warm.csv", ServedDesk::isotherms());
  const Json read = desk.order("table", {{"table", "warm.csv"}}).json;
  INFO(read.dump());
  REQUIRE(read.at("result").at("isotherms").size() == 3);
  CHECK(read.at("result").at("isotherms").at(0).at("modulus_Pa").size() == 41);
  Json options = {{"reference-temperature", "20 degC"}};
  options["start-shift"] = Json::array({"10=0.9", "30=-1.1"});
  const Json fitted = desk.order("fit", {{"table", "warm.csv"}, {"options", options}}).json;
  INFO(fitted.dump());
  const std::string command =
      "viscard fit warm.csv '--reference-temperature=20 degC' --start-shift=10=0.9 "
      "--start-shift=30=-1.1";
  CHECK(fitted.at("command") == command);
  CHECK(fitted.at("options") == options);
  const auto typed =
      run_command({"fit", (desk.folder() / "warm.csv").string(), "--reference-temperature",
                   "20 degC", "--start-shift", "10=0.9", "--start-shift", "30=-1.1", "--json"});
  const Json own = Json::parse(typed.out);
  for (const char* key : {"E0_Pa", "terms", "flags", "shift"}) {
    CAPTURE(key);
    CHECK(fitted.at("result").at(key) == own.at(key));
  }
  CHECK(own.at("shift").at("start_shifts").size() == 2);
  // Kept beside the table, they hold without options in the request.
  desk.order("table", {{"table", "warm.csv"}, {"options", options}});
  CHECK(contains(read_file(desk.folder() / "warm.csv.options"), "--start-shift=30=-1.1\n"));
  CHECK(desk.order("fit", {{"table", "warm.csv"}}).json.at("command") == command);
  options["start-shift"] = Json::array({"15=1"});
  const ApiAnswer bad = desk.order("fit", {{"table", "warm.csv"}, {"options", options}});
  CHECK(bad.status == 422);
  CHECK(contains(message_of(bad), "no isotherm was measured at 15 C"));
}

TEST_CASE("the page sets options of a fit, and none that reads or writes another file",
          "[serve][desk]") {
  ServedDesk desk;
  desk.drop("a.csv", ServedDesk::example());
  const auto fit = [&](const Json& options) {
    return desk.order("fit", {{"table", "a.csv"}, {"options", options}});
  };
  const Json one = fit({{"terms", "1"}, {"column", {"time_s=1"}}, {"no-drift", true}}).json;
  INFO(one.dump());
  CHECK(one.at("result").at("n_terms") == 1);
  CHECK(one.at("command") == "viscard fit a.csv --terms=1 --column=time_s=1 --no-drift");
  for (const char* name : {"out", "csv", "svg", "force", "specimen", "constraints", "joint", "help",
                           "json", "show-table", "nothing", "--terms", ""}) {
    CAPTURE(name);
    CHECK(fit({{name, "x"}}).status == 400);
  }
  CHECK(fit({{"terms", 3}}).status == 400);
  CHECK(fit({{"terms", std::string(1000, '1')}}).status == 400);
  CHECK(fit(Json::array()).status == 400);
  const ApiAnswer bad = fit({{"terms", "many"}});
  CHECK(bad.status == 422);
  CHECK(contains(message_of(bad), "--terms"));
  const ApiAnswer card =
      desk.order("card", {{"table", "a.csv"}, {"card", {{"for", "abaqus"}, {"out", "/tmp/x"}}}});
  CHECK(card.status == 400);
  const Json described = desk.ask("/api/desk/choices").json;
  for (const Json& option : described.at("options")) {
    CHECK(option.at("name") != "specimen");
  }
  // All that a message of card names can be set, in the order in which the page shows it.
  std::set<std::string> of_card;
  for (const Json& option : described.at("card")) of_card.insert(option.at("name"));
  for (const char* name : {"accept-flags", "approximate", "extrapolate", "density", "terms"})
    CHECK(of_card.contains(name));
  CHECK_FALSE(of_card.contains("out"));
  CHECK(described.at("targets").size() > 10);
  CHECK(described.at("units").size() > 4);
}

TEST_CASE("what was chosen is kept beside the table, for the desk and for the command line",
          "[serve][desk]") {
  ServedDesk desk;
  desk.drop("a b.csv", ServedDesk::example());
  const Json first = desk.order("table", {{"table", "a b.csv"}}).json;
  CHECK(first.at("options").empty());
  const Json options = {
      {"terms", "1"}, {"no-drift", true}, {"column", {"time_s=1", "modulus_Pa=2 [kPa]"}}};
  const Json chosen = desk.order("table", {{"table", "a b.csv"}, {"options", options}}).json;
  INFO(chosen.dump());
  CHECK(chosen.at("options") == options);
  CHECK(chosen.at("result").at("columns").at(1).at("factor") == 1e3);
  CHECK(desk.order("table", {{"table", "a b.csv"}}).json.at("options") == options);
  CHECK(desk.ask("/api/desk").json.at("tables").size() == 1);
  const std::string kept = "@" + (desk.folder() / "a b.csv.options").string();
  const auto typed = run_command({"fit", (desk.folder() / "a b.csv").string(), kept, "--json"});
  const Json shown = desk.order("fit", {{"table", "a b.csv"}}).json.at("result");
  CHECK(Json::parse(typed.out).at("E0_Pa") == shown.at("E0_Pa"));
  CHECK(shown.at("n_terms") == 1);
  desk.order("table", {{"table", "a b.csv"}, {"options", Json::object()}});
  CHECK(names_in(desk.folder()) == std::set<std::string>{"a b.csv"});
  write_file(desk.folder() / "a b.csv.options", "mine\n", false);
  CHECK(desk.order("table", {{"table", "a b.csv"}, {"options", options}}).status == 409);
  CHECK(read_file(desk.folder() / "a b.csv.options") == "mine\n");
}

TEST_CASE("a wrong option is reported beside the table, so that it can be changed",
          "[serve][desk]") {
  ServedDesk desk;
  desk.drop("a.csv", ServedDesk::example());
  const Json options = {{"column", {"modulus_Pa=nothing"}}};
  const ApiAnswer answer = desk.order("table", {{"table", "a.csv"}, {"options", options}});
  INFO(answer.json.dump());
  CHECK(answer.status == 200);
  CHECK(answer.json.at("options") == options);
  for (const char* bad : {"a\nb", "a\x01", "--out=x\n"}) {
    CHECK(desk.order("table", {{"table", "a.csv"}, {"options", {{"terms", bad}}}}).status == 400);
  }
}

TEST_CASE("the desk predicts by the material of a table and compares with another table",
          "[serve][desk]") {
  ServedDesk desk;
  desk.drop("a.csv", ServedDesk::example());
  const ApiAnswer creep =
      desk.order("predict", {{"table", "a.csv"}, {"predict", {{"test", "creep"}}}});
  INFO(creep.json.dump());
  REQUIRE(creep.status == 200);
  CHECK(creep.json.at("command") == "viscard predict a.json --test=creep");
  CHECK(creep.json.at("result").at("curve").contains("time_s"));
  const ApiAnswer against = desk.order(
      "predict", {{"table", "a.csv"}, {"predict", Json::object()}, {"against", "a.csv"}});
  const Json& found = against.json.at("result").at("against");
  CHECK(found.at("quantities").at(0).at("rms_relative") < 1e-3);
  CHECK(found.at("quantities").at(0).at("agrees") == true);
  CHECK(found.at("measured").at(0).at("values").size() == found.at("quantities").at(0).at("n"));
  desk.drop("half.csv", ServedDesk::example(0.5));
  const Json half =
      desk.order("predict",
                 {{"table", "a.csv"}, {"predict", Json::object()}, {"against", "half.csv"}})
          .json;
  CHECK(half.at("result").at("against").at("quantities").at(0).at("agrees") == false);
  CHECK(desk.order("predict", {{"table", "a.csv"}, {"against", "../a.csv"}}).status == 404);
  CHECK(desk.order("predict", {{"table", "a.csv"}, {"predict", {{"out", "x"}}}}).status == 400);
  CHECK(desk.order("predict", {{"table", "a.csv"}, {"predict", {{"history", "x"}}}}).status == 400);
}

TEST_CASE("the desk reads a pasted card back and tells its mistakes", "[serve][desk]") {
  ServedDesk desk;
  desk.drop("a.csv", ServedDesk::example());
  const std::string card =
      desk.order("card", {{"table", "a.csv"}, {"card", {{"for", "abaqus"}, {"units", "SI"}}}})
          .json.at("result")
          .at("card");
  const Json checked = desk.order("check", {{"card", card}}).json;
  INFO(checked.dump());
  CHECK(checked.at("result").at("target") == "abaqus");
  CHECK(checked.at("result").at("agrees") == true);
  CHECK(checked.at("result").at("material").at("terms").size() == 2);
  CHECK(desk.order("check", {{"card", "*ELASTIC\nnonsense\n"}, {"for", "abaqus"}}).status == 422);
  CHECK(desk.order("check", {{"card", ""}}).status == 422);
  // A card of another program, in mm-t-s.
  const std::string foreign = "*MATERIAL, NAME=A\n*ELASTIC, MODULI=INSTANTANEOUS\n1.88, 0.495\n";
  const auto of_foreign = [&](const Json& more) {
    Json request{{"card", foreign}, {"for", "abaqus"}};
    request.update(more);
    return desk.order("check", request).json;
  };
  CHECK(of_foreign(Json::object()).at("result").at("verdict") == "the card is wrong");
  const Json in_mm = of_foreign({{"units", "mm-t-s"}});
  CHECK(in_mm.at("result").at("verdict") == "no mistake found");
  CHECK(in_mm.at("command") == "viscard card --check=CARD --for=abaqus --units=mm-t-s");
  CHECK(of_foreign({{"plausible", "off"}}).at("result").at("agrees") == true);
  CHECK(desk.order("check", {{"card", card}, {"for", "../x"}}).status == 422);
  CHECK(names_in(desk.folder()) == std::set<std::string>{"a.csv", "a.json"});
}

TEST_CASE(
    "a scene begins with an example, is kept when it is changed, and is drawn, planned and solved",
    "[serve][desk]") {
  ServedDesk desk;
  const Json choices = desk.ask("/api/desk/choices").json;
  const Json& examples = choices.at("examples");
  CHECK(std::any_of(examples.begin(), examples.end(),
                    [](const Json& one) { return one.at("name") == "pillar_press.toml"; }));
  const ApiAnswer opened = desk.order("scene/open", {{"example", "pillar_press.toml"}});
  INFO(opened.json.dump());
  REQUIRE(opened.status == 200);
  CHECK(opened.json.at("scene") == "pillar_press.toml");
  const auto text = opened.json.at("text").get<std::string>();
  CHECK(desk.ask("/api/desk").json.at("scenes") == Json::array({"pillar_press.toml"}));
  CHECK(desk.ask("/api/desk").json.at("tables").empty());

  // Of the desk: the same file. Of somebody else: a new one.
  const Json changed{{"scene", "pillar_press.toml"}, {"text", text + "\n# changed\n"}};
  CHECK(desk.order("scene/open", changed).json.at("scene") == "pillar_press.toml");
  CHECK(contains(read_file(desk.folder() / "pillar_press.toml"), "# changed"));
  const std::string own = text.substr(text.find('\n') + 1);
  write_file(desk.folder() / "own.toml", own, false);
  const Json other =
      desk.order("scene/open", {{"scene", "own.toml"}, {"text", own + "\n# mine\n"}}).json;
  CHECK(other.at("scene") == "own.2.toml");
  CHECK(read_file(desk.folder() / "own.toml") == own);

  const auto about = [&](const char* what) {
    return desk.order("scene", {{"scene", "pillar_press.toml"}, {"what", what}, {"tol", "1e-3"}})
        .json;
  };
  const Json drawn = about("drawing");
  INFO(drawn.dump());
  CHECK(contains(drawn.at("pictures").at(0).at("svg"), "<svg"));
  CHECK(drawn.at("command") == "viscard scene check pillar_press.toml");
  CHECK_FALSE(about("plan").at("result").at("effects").empty());
  const Json solved = about("answer");
  CHECK(solved.at("command") == "viscard simulate pillar_press.toml --tol=1e-3");
  CHECK(solved.at("result").at("results").at("electrode_voltage").at("value").get<double>() ==
        Approx(0.02853).epsilon(1e-3));
  CHECK(contains(solved.at("result").at("tolerance_doubt"),
                 "not within the tolerance: finite_strain is not computed"));
  CHECK(solved.at("pictures").size() >= 3);
  CHECK(names_in(desk.folder()) ==
        std::set<std::string>{"own.2.toml", "own.toml", "pillar_press.toml"});

  CHECK(desk.order("scene", {{"scene", "../pillar_press.toml"}, {"what", "plan"}}).status == 404);
  CHECK(desk.order("scene/open", {{"example", "../materials/pdms_1to10_seed.json"}}).status == 404);
  CHECK(desk.order("scene", {{"scene", "own.toml"}, {"what", "all"}}).status == 400);
  write_file(desk.folder() / "bad.toml", "[geometry]\nkind = \"pillar\"\ndiametre = \"1 um\"\n",
             false);
  const ApiAnswer bad = desk.order("scene", {{"scene", "bad.toml"}, {"what", "drawing"}});
  CHECK(bad.status == 422);
  CHECK(contains(message_of(bad), "diametre"));
}

TEST_CASE("a table at large strain is fitted by the kind that is chosen for it, which is kept",
          "[serve][desk]") {
  ServedDesk desk;
  desk.drop("rubber.csv", ServedDesk::rubber());
  desk.drop("sheet.csv", ServedDesk::rubber(true));
  const Json described = desk.ask("/api/desk/choices").json;
  CHECK(described.at("large_strain") == Json{"uniaxial", "compression", "planar", "equibiaxial",
                                             "confined", "volumetric", "shear"});
  for (const Json& option : described.at("options")) {
    if (option.at("name") != "kind") continue;
    CHECK(option.at("choices").at(0) == "indentation");
    CHECK(option.at("choices").back() == "shear");
  }
  const Json options = {{"kind", "uniaxial"}, {"model", "yeoh"}};
  const Json unknown = desk.order("table", {{"table", "rubber.csv"}}).json;
  CHECK(contains(unknown.at("result").at("kind_trouble"), "uniaxial=rubber.csv"));
  const Json read = desk.order("table", {{"table", "rubber.csv"}, {"options", options}}).json;
  INFO(read.dump());
  CHECK(read.at("options") == options);
  CHECK(read.at("result").at("kind") == "uniaxial");
  CHECK(read.at("result").at("kind_trouble") == "");

  const Json fitted = desk.order("fit", {{"table", "rubber.csv"}}).json;
  INFO(fitted.dump());
  CHECK(fitted.at("command") == "viscard fit uniaxial=rubber.csv --model=yeoh");
  CHECK(fitted.at("options") == options);
  CHECK(fitted.at("result").at("law") == "yeoh");
  CHECK(contains(fitted.at("pictures").at(0).at("svg"), "<svg"));
  const std::string kept = read_file(desk.folder() / "rubber.csv.options");
  CHECK(contains(kept, "viscard fit @rubber.csv.options"));
  CHECK(contains(kept, "\nuniaxial=rubber.csv\n--model=yeoh\n"));
  CHECK(desk.runs("viscard fit @rubber.csv.options"));

  for (int i = 0; i < 2; ++i) {  // the second time the law is there
    const Json card =
        desk.order("card", {{"table", "rubber.csv"}, {"card", {{"for", "abaqus"}}}}).json;
    INFO(card.dump());
    CHECK(card.at("material") == "rubber.json");
    CHECK(contains(card.at("result").at("card"), "*HYPERELASTIC"));
    CHECK(desk.runs(card.at("fit_command").get<std::string>() + "\n" +
                    card.at("command").get<std::string>()));
  }
  // Python takes the density as a number in SI.
  const Json dense = desk.order("card", {{"table", "rubber.csv"},
                                         {"card", {{"for", "lsdyna"}, {"density", "1.1 g/cm3"}}}})
                         .json;
  INFO(dense.dump());
  CHECK(contains(dense.at("command"), "'--density=1.1 g/cm3'"));
  CHECK(dense.at("options").size() == 1);
  CHECK(dense.at("options").at("density_kg_m3").get<double>() == Approx(1100.0));
  const ApiAnswer predicted =
      desk.order("predict", {{"table", "rubber.csv"}, {"predict", {{"test", "creep"}}}});
  CHECK(predicted.status == 422);
  CHECK(contains(message_of(predicted), "a law of rubber gives cards, and no predictions"));

  const Json one = Json::array({{{"table", "rubber.csv"}, {"kind", "uniaxial"}}});
  const Json empty = Json::object();
  CHECK(desk.order("fit", {{"tests", one}, {"options", empty}}).json.at("command") ==
        "viscard fit uniaxial=rubber.csv");
  // What stands before each file is no option of all.
  desk.order("table", {{"table", "sheet.csv"}, {"options", {{"kind", "planar"}}}});
  const Json both = {one[0], {{"table", "sheet.csv"}, {"kind", "planar"}}};
  const Json together = desk.order("fit", {{"tests", both}}).json;
  INFO(together.dump());
  CHECK(together.at("command") == "viscard fit uniaxial=rubber.csv planar=sheet.csv");
  CHECK(together.at("options").empty());
  // Without the kind the file of options is a list of options again.
  desk.order("table", {{"table", "sheet.csv"}, {"options", {{"model", "yeoh"}}}});
  CHECK(contains(read_file(desk.folder() / "sheet.csv.options"),
                 "viscard fit sheet.csv @sheet.csv.options"));
}

TEST_CASE("a report of the desk shows what the page shows of a table with options",
          "[serve][desk]") {
  ServedDesk desk;
  desk.drop("a.csv", ServedDesk::example());
  desk.drop("bare.csv", ServedDesk::without_header());
  desk.order("table", {{"table", "a.csv"}, {"options", {{"terms", "1"}}}});
  const Json columns = {{"column", {"time_s=1", "modulus_Pa=2 [MPa]"}}};
  desk.order("table", {{"table", "bare.csv"}, {"options", columns}});
  for (const char* table : {"a.csv", "bare.csv"}) {
    CAPTURE(table);
    const Json fitted = desk.order("fit", {{"table", table}}).json.at("result");
    const ApiAnswer made = desk.order("report", {{"tables", Json::array({table})}});
    INFO(made.json.dump().substr(0, 500));
    REQUIRE(made.status == 200);
    CHECK(made.json.at("result").at("specimens").at(0).at("E0_Pa") == fitted.at("E0_Pa"));
    CHECK(contains(made.json.at("notes").at(0), std::string(table) + " is shown by "));
    CHECK(desk.runs(made.json.at("command")));
  }
  // A density changes no fit: the page keeps the data.
  const Json density = {{"density", "965"}};
  desk.order("table", {{"table", "a.csv"}, {"options", density}});
  const Json both = desk.order("report", {{"tables", Json::array({"a.csv"})}}).json;
  CHECK(both.at("files").size() == 2);
  CHECK(both.at("files").at(0) == "a.csv");
  CHECK(both.at("notes").empty());
  CHECK(both.at("result").at("specimens").size() == 1);
  // The options of the folder are those of Python too.
  write_file(desk.folder() / "report.options", "--logo=logo.svg\n--card=febio\n", false);
  write_file(desk.folder() / "logo.svg", "<svg/>", false);
  const Json house =
      desk.order("report", {{"tables", Json::array({"a.csv"})}, {"title", "Mine"}}).json;
  CHECK(house.at("options") ==
        Json{{"logo", "logo.svg"}, {"card", Json::array({"febio"})}, {"title", "Mine"}});
}

TEST_CASE("the lines that the desk shows run when they are copied, and again", "[serve][desk]") {
  ServedDesk desk;
  desk.drop("a b.csv", ServedDesk::example());
  desk.drop("b.csv", ServedDesk::example(0.5));
  desk.drop("c.csv", ServedDesk::example(0.51));
  const auto lines_run = [&](const Json& answer) {
    INFO(answer.dump());
    const std::string lines = answer.at("fit_command").get<std::string>() + "\n" +
                              answer.at("command").get<std::string>();
    return desk.runs(lines) && desk.runs(lines);
  };
  const Json card = {{"for", "abaqus"}};
  const Json tests = {{{"table", "a b.csv"}, {"ratio", "10"}},
                      {{"table", "b.csv"}, {"ratio", "20"}},
                      {{"table", "c.csv"}, {"ratio", "20"}}};
  const Json of_one = desk.order("card", {{"table", "a b.csv"}, {"card", card}}).json;
  CHECK(lines_run(of_one));
  std::filesystem::remove(desk.folder() / "a b.json");  // they also make it again
  CHECK(lines_run(of_one));
  CHECK(lines_run(
      desk.order("card", {{"tests", tests}, {"card", {{"for", "abaqus"}, {"ratio", "15"}}}}).json));
  CHECK(lines_run(
      desk.order("predict", {{"table", "b.csv"}, {"predict", {{"test", "creep"}}}}).json));
  const ApiAnswer joint = desk.order("predict", {{"tests", tests}, {"predict", Json::object()}});
  CHECK(joint.status == 422);
  CHECK(contains(message_of(joint), "fit the specimens of one ratio together"));
}

TEST_CASE("a prediction reads the table beside it with what is kept for that table",
          "[serve][desk]") {
  ServedDesk desk;
  desk.drop("a.csv", ServedDesk::example());
  desk.drop("bare.csv", ServedDesk::without_header());
  Json options = {{"column", {"time_s=1", "modulus_Pa=2 [MPa]"}}};
  desk.order("table", {{"table", "bare.csv"}, {"options", options}});
  const Json wanted = {
      {"table", "a.csv"}, {"predict", {{"test", "relaxation"}}}, {"against", "bare.csv"}};
  const ApiAnswer against = desk.order("predict", wanted);
  INFO(against.json.dump().substr(0, 500));
  REQUIRE(against.status == 200);
  CHECK(against.json.at("result").at("against").at("quantities").at(0).at("rms_relative") < 1e-3);
  CHECK(against.json.at("options").at("column") == options.at("column"));
  CHECK(against.json.at("options").at("against") == "bare.csv");
  CHECK(against.json.at("notes").empty());
  options["table"] = "1";
  desk.order("table", {{"table", "bare.csv"}, {"options", options}});
  CHECK(contains(desk.order("predict", wanted).json.at("notes").at(0),
                 "bare.csv is read here without --table=1"));
}

TEST_CASE("the desk writes a report under a name that is free", "[serve][desk]") {
  ServedDesk desk;
  desk.drop("a.csv", ServedDesk::example());
  write_file(desk.folder() / "report.html", "mine", false);
  const ApiAnswer made =
      desk.order("report", {{"tables", Json::array({"a.csv"})}, {"title", "Silicone"}});
  INFO(made.json.dump().substr(0, 500));
  REQUIRE(made.status == 200);
  CHECK(made.json.at("name") == "report.2.html");
  CHECK(contains(made.json.at("command"),
                 "viscard report a.csv --title=Silicone --out report.3.html"));
  CHECK(made.json.at("next_name") == "report.3.html");
  CHECK(contains(read_file(desk.folder() / "report.2.html"), "Silicone"));
  CHECK(read_file(desk.folder() / "report.html") == "mine");
  CHECK(desk.order("report", {{"tables", Json::array()}}).status == 400);
  CHECK(desk.order("report", {{"tables", Json::array({"../a.csv"})}}).status == 404);
}

}  // namespace
}  // namespace viscard
