#include "io/results/result_json.h"
#include "io/results/result_schema.h"

#include <catch2/catch.hpp>

#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

using namespace viscard;

namespace {

struct Row {
  double value_m = 0.0;
  std::optional<int> number;
};

void show_keys(ResultVisitor& v, const Row& row) {
  v("value_m", row.value_m, "a length");
  v("number", row.number, "missing where there is none");
}

struct Example {
  bool is_force = false;
  std::vector<Row> rows;
  std::optional<std::string> cause;
  std::vector<std::pair<std::string, int>> counts;
};

void show_keys(ResultVisitor& v, const Example& example) {
  v(example.is_force ? "F_N" : "E_Pa", 1.0, "named by its unit");
  v("rows", example.rows, "a list");
  v.or_null("cause", example.cause, "null where there is none");
  v.map("counts", "by reason", example.counts,
        [&](const std::pair<std::string, int>& one) { v(one.first, one.second, "rows"); });
  v("interval_95", Interval{-std::numeric_limits<double>::infinity(), 2.0}, "[low, high]");
}

DescribedResult of_example() {
  DescribedResult result{"example", "an example", {}};
  for (const bool is_force : {false, true}) {
    result.examples.emplace_back(
        [is_force](ResultVisitor& v) { show_keys(v, Example{.is_force = is_force}); });
  }
  return result;
}

}  // namespace

TEST_CASE("JSON has the keys of a result in their order, null for what is not finite", "[io]") {
  const Example example{.rows = {{std::numeric_limits<double>::quiet_NaN(), 3}, {2.0, {}}},
                        .counts = {{"late", 4}}};
  CHECK(json_from_result(example).dump() ==
        R"({"E_Pa":1.0,"rows":[{"value_m":null,"number":3},{"value_m":2.0}],"cause":null,)"
        R"("counts":{"late":4},"interval_95":[null,2.0]})");
  CHECK(json_from_result(Example{.cause = "late"}).at("cause") == "late");
  CHECK(json_from_result(Example{}).at("rows") == nlohmann::ordered_json::array());
}

TEST_CASE("a schema refuses unknown keys, requires those of all examples and marks nulls", "[io]") {
  const nlohmann::ordered_json schema = schema_of(of_example());
  CHECK(schema.at("additionalProperties") == false);
  CHECK(schema.at("required") ==
        nlohmann::ordered_json::array(
            {"schema", "version", "inputs", "rows", "cause", "counts", "interval_95"}));
  const auto& keys = schema.at("properties");
  CHECK(keys.at("schema").at("const") == "viscard-example/1");
  CHECK(keys.contains("E_Pa"));
  CHECK(keys.contains("F_N"));
  CHECK(keys.at("cause").at("type") == nlohmann::ordered_json::array({"string", "null"}));
  const auto& row = keys.at("rows").at("items");
  CHECK(row.at("additionalProperties") == false);
  CHECK(row.at("required") == nlohmann::ordered_json::array({"value_m"}));
  CHECK(row.at("properties").at("value_m").at("type") ==
        nlohmann::ordered_json::array({"number", "null"}));
  CHECK(row.at("properties").at("number").at("type") == "integer");
  CHECK(keys.at("counts").at("additionalProperties").at("type") == "integer");
}

TEST_CASE("the list of keys names the place, the type and what is not always there", "[io]") {
  CHECK(list_of_keys({of_example()}) ==
        "example E_Pa?: number\n"
        "example rows: list\n"
        "example rows[].value_m: number\n"
        "example rows[].number?: whole number\n"
        "example cause: text or null\n"
        "example counts: object\n"
        "example interval_95: list\n"
        "example F_N?: number\n");
  CHECK(table_of_keys({of_example()}).find("| `rows` | list | a list {`value_m`, `number`} |") !=
        std::string::npos);
}
