#include "io/config/config_fields.h"

#include <toml++/toml.h>

#include <sstream>

namespace viscard {

int line_of_key(const std::string& toml, const std::string& dotted_key) {
  toml::table table;
  try {
    table = toml::parse(toml);
  } catch (const toml::parse_error&) {
    return 0;
  }
  const toml::table* around = &table;
  int line = 1;
  std::istringstream keys(dotted_key);
  std::string key;
  while (around != nullptr && std::getline(keys, key, '.')) {
    const toml::node* node = around->get(key);
    if (node == nullptr) break;
    line = static_cast<int>(node->source().begin.line);
    around = node->as_table();
    if (const toml::array* entries = node->as_array()) {
      std::size_t number = 0;
      if (keys >> number && number >= 1 && number <= entries->size()) {
        line = static_cast<int>(entries->get(number - 1)->source().begin.line);
      }
    }
  }
  return line;
}

}  // namespace viscard
