#include "io/results/result_json.h"

#include "io/basics/json_string.h"
#include "io/basics/written_path.h"

#include <cmath>
#include <utility>

namespace viscard {
namespace {

using Json = nlohmann::ordered_json;

Json number_or_null_json(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json array_of(const std::vector<double>& values) {
  Json array = Json::array();
  for (const double value : values) array.push_back(number_or_null_json(value));
  return array;
}

// Texts without folders where the user wants none: paths and messages that quote them stand under many keys.
class JsonWriter : public ResultVisitor {
 public:
  explicit JsonWriter(Json& object) : within_{&object} {}

  void document(std::string_view key, const std::string& json, const char* /*what*/) override {
    set(key, ordered_json_from_text(written_text(json)));
  }
  void documents(std::string_view key, const std::vector<std::string>& json,
                 const char* /*what*/) override {
    Json& list = set(key, Json::array());
    for (const std::string& one : json) list.push_back(ordered_json_from_text(written_text(one)));
  }

 protected:
  void number(std::string_view key, double value, const char* /*what*/) override {
    set(key, number_or_null_json(value));
  }
  void whole(std::string_view key, std::int64_t value, const char* /*what*/) override {
    set(key, value);
  }
  void flag(std::string_view key, bool value, const char* /*what*/) override { set(key, value); }
  void text(std::string_view key, const std::string& value, const char* /*what*/,
            const std::vector<const char*>* /*words*/) override {
    set(key, written_text(value));
  }
  void pair(std::string_view key, const Interval& value, const char* /*what*/) override {
    set(key, array_of({value.low, value.high}));
  }
  void numbers(std::string_view key, const std::vector<double>& values,
               const char* /*what*/) override {
    set(key, array_of(values));
  }
  void wholes(std::string_view key, const std::vector<std::int64_t>& values,
              const char* /*what*/) override {
    set(key, values);
  }
  void texts(std::string_view key, const std::vector<std::string>& values,
             const char* /*what*/) override {
    Json& list = set(key, Json::array());
    for (const std::string& value : values) list.push_back(written_text(value));
  }
  void flags(std::string_view key, const std::vector<bool>& values, const char* /*what*/) override {
    set(key, values);
  }
  void matrix(std::string_view key, const Eigen::MatrixXd& values, const char* /*what*/) override {
    Json array = Json::array();
    for (const auto& row : values.rowwise()) array.push_back(array_of({row.begin(), row.end()}));
    set(key, std::move(array));
  }
  void null(std::string_view key) override { set(key, nullptr); }
  void open(Part part, std::string_view key, const char* /*what*/) override {
    Json empty = part == Part::kList ? Json::array() : Json::object();
    if (part == Part::kEntry) {
      within_.back()->push_back(std::move(empty));
      within_.push_back(&within_.back()->back());
    } else {
      within_.push_back(&set(key, std::move(empty)));
    }
  }
  void close() override { within_.pop_back(); }

 private:
  Json& set(std::string_view key, Json value) {
    return (*within_.back())[std::string(key)] = std::move(value);
  }
  std::vector<Json*> within_;
};

}  // namespace

nlohmann::ordered_json json_from_keys(const ShowKeys& show) {
  Json object = Json::object();
  JsonWriter writer(object);
  show(writer);
  return object;
}

}  // namespace viscard
