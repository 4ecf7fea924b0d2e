#include "io/basics/named_file.h"
#include "io/config/config_fields.h"
#include "io/config/toml_text.h"

#include <toml++/toml.h>

#include <sstream>
#include <stdexcept>

namespace viscard {

int line_of_key(const std::string& toml, const std::string& dotted_key) {
  toml::table table;
  try {
    table = parsed_toml(toml);
  } catch (const std::runtime_error&) {  // toml::parse_error is one
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

std::filesystem::path path_at_key(const std::string& toml, const std::filesystem::path& in,
                                  const std::string& dotted_key, const std::string& name,
                                  FileKind wanted) {
  const std::string fault = fault_of_named_file(in.parent_path(), name, wanted);
  if (fault.empty()) return in.parent_path() / name;
  throw std::runtime_error(in.string() + ":" + std::to_string(line_of_key(toml, dotted_key)) +
                           ": " + dotted_key + ": " + fault);
}

}  // namespace viscard
