#include "io/materials/json_watch.h"

#include <nlohmann/json.hpp>

#include <set>
#include <vector>

namespace viscard {
namespace {

// The library tells it every value in turn. Its parser with a callback would, after each object, look through all
// objects of the same list.
class JsonWatch final : public nlohmann::json_sax<nlohmann::json> {
 public:
  JsonFaults faults;

  bool null() override { return take_value(); }
  bool boolean(bool) override { return take_value(); }
  bool number_integer(number_integer_t) override { return take_value(); }
  bool number_unsigned(number_unsigned_t) override { return take_value(); }
  bool number_float(number_float_t, const string_t&) override { return take_value(); }
  bool binary(binary_t&) override { return take_value(); }
  bool string(string_t& text) override {
    look_for_nul(text);
    return take_value();
  }
  bool start_object(std::size_t) override {
    take_value();
    keys_.emplace_back();
    ++n_open_;
    return true;
  }
  bool end_object() override {
    keys_.pop_back();
    --n_open_;
    return true;
  }
  bool start_array(std::size_t) override {
    take_value();
    ++n_open_;
    return true;
  }
  bool end_array() override {
    --n_open_;
    return true;
  }
  bool key(string_t& text) override {
    look_for_nul(text);
    take_value();
    faults.has_long_key = faults.has_long_key || text.size() > kLongestJsonKey;
    std::set<std::string>& keys = keys_.back();
    if (keys.count(text) != 0) {
      faults.repeated = text;
    } else if (keys.size() < kMostJsonKeys) {
      keys.insert(text);
    } else {
      faults.has_many_keys = true;
    }
    return true;
  }
  bool parse_error(std::size_t, const std::string&, const nlohmann::json::exception&) override {
    return false;
  }

 private:
  bool take_value() {
    faults.is_deep = faults.is_deep || n_open_ > kDeepestJson;
    return true;
  }
  void look_for_nul(const std::string& text) {
    faults.has_nul = faults.has_nul || text.find('\0') != std::string::npos;
  }

  std::vector<std::set<std::string>> keys_;  // of the objects not yet closed
  std::size_t n_open_ = 0;                   // objects and lists
};

}  // namespace

JsonFaults faults_of_json(const std::string& text) {
  JsonWatch watch;
  nlohmann::json::sax_parse(text, &watch);
  return watch.faults;
}

}  // namespace viscard
