#pragma once

#include <set>
#include <string>

namespace viscard {

// Names that a header of namespace viscard declares for others: functions without a body, and the
// classes and structs whose members may be defined in a .cpp file.
struct Declarations {
  std::set<std::string> functions;
  std::set<std::string> classes;
};

// What a .cpp file defines for others: functions outside unnamed namespaces, and the classes whose
// members it defines.
struct Definitions {
  std::set<std::string> functions;
  std::set<std::string> classes;
};

// Both read formatted C++ as text: comments, strings and preprocessor lines are skipped, braces are
// counted. Good for this code base, where everything stands in namespace viscard.
Declarations declarations_in(const std::string& header_text);
Definitions definitions_in(const std::string& source_text);

}  // namespace viscard
