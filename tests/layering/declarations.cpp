#include "tests/layering/declarations.h"

#include <algorithm>
#include <cctype>
#include <regex>
#include <vector>

namespace viscard {
namespace {

// The text without comments, string contents and preprocessor lines.
std::string plain_code(const std::string& text) {
  static const std::regex kComment(R"(//[^\n]*|/\*[\s\S]*?\*/)");
  static const std::regex kRaw(R"re(R"(\w*)\([\s\S]*?\)\1")re");
  static const std::regex kString(R"re("(\\.|[^"\\\n])*"|'(\\.|[^'\\\n])+')re");
  static const std::regex kPreprocessor(R"((^|\n)#([^\n]*\\\n)*[^\n]*)");
  std::string code = std::regex_replace(text, kRaw, "\"\"");
  code = std::regex_replace(code, kString, "\"\"");
  code = std::regex_replace(code, kComment, "");
  return std::regex_replace(code, kPreprocessor, "\n");
}

// A piece of code between ';', '{' and '}' at namespace level, and what ended it.
struct Statement {
  std::string text;
  char end = ';';
  bool is_unnamed = false;  // inside an unnamed namespace
};

// A brace that initialises a value has no blank before it ("a_{b}"), or stands in the brackets of a
// default argument ("= {}").
bool begins_value(const std::string& code, std::size_t brace, const std::string& statement) {
  if (brace > 0 && std::isspace(static_cast<unsigned char>(code[brace - 1])) == 0) return true;
  return std::count(statement.begin(), statement.end(), '(') >
         std::count(statement.begin(), statement.end(), ')');
}

std::vector<Statement> statements_at_namespace_level(const std::string& code) {
  static const std::regex kNamespace(R"(\bnamespace\b\s*([\w:]*)\s*$)");
  std::vector<Statement> statements;
  std::vector<bool> namespaces;  // whether each open one is unnamed
  int unnamed = 0;
  int depth = 0;  // of braces inside the innermost namespace
  std::string current;
  for (std::size_t i = 0; i < code.size(); ++i) {
    const char c = code[i];
    if (depth > 0) {
      depth += c == '{' ? 1 : c == '}' ? -1 : 0;
      continue;
    }
    if (c == '{' && begins_value(code, i, current)) {
      depth = 1;  // the statement goes on behind the value
      continue;
    }
    if (c != ';' && c != '{' && c != '}') {
      current += c;
      continue;
    }
    std::smatch match;
    if (c == '{' && std::regex_search(current, match, kNamespace)) {
      namespaces.push_back(match[1].length() == 0);
      unnamed += namespaces.back() ? 1 : 0;
    } else if (c == '}') {
      unnamed -= !namespaces.empty() && namespaces.back() ? 1 : 0;
      if (!namespaces.empty()) namespaces.pop_back();
    } else {
      statements.push_back({current, c, unnamed > 0});
      depth = c == '{' ? 1 : 0;
    }
    current.clear();
  }
  return statements;
}

bool begins_type(const std::string& text) {
  static const std::regex kType(R"(^\s*(template\s*<[^{;]*>\s*)?(struct|class|enum|union)\b)");
  return std::regex_search(text, kType);
}

// The name before the first '(': "viscard::f" gives "f", "Box::f" gives "Box::f".
std::string called_name(const std::string& text) {
  static const std::regex kName(R"(([A-Za-z_][\w:~]*|operator[^\s(]+)\s*\()");
  static const std::regex kOther(R"(^\s*(using|typedef|static_assert|extern|friend)\b)");
  std::smatch match;
  if (std::regex_search(text, kOther) || !std::regex_search(text, match, kName)) return "";
  // An initialised variable is no function.
  const std::size_t equals = text.find('=');
  if (equals != std::string::npos && equals < static_cast<std::size_t>(match.position(0)))
    return "";
  return match[1];
}

}  // namespace

Declarations declarations_in(const std::string& header_text) {
  static const std::regex kClass(R"(\b(?:struct|class)\s+(\w+))");
  Declarations found;
  for (const Statement& statement : statements_at_namespace_level(plain_code(header_text))) {
    std::smatch match;
    if (begins_type(statement.text)) {
      if (statement.end == '{' && std::regex_search(statement.text, match, kClass)) {
        found.classes.insert(match[1]);
      }
    } else if (statement.end == ';') {
      const std::string name = called_name(statement.text);
      if (!name.empty()) found.functions.insert(name);
    }
  }
  return found;
}

Definitions definitions_in(const std::string& source_text) {
  Definitions found;
  for (const Statement& statement : statements_at_namespace_level(plain_code(source_text))) {
    if (statement.is_unnamed || statement.end != '{' || begins_type(statement.text)) continue;
    // Loops with clones for processors cannot stand in an unnamed namespace (models/maths/wide_loops.h).
    if (statement.text.find("VISCARD_WIDE_LOOP") != std::string::npos) continue;
    if (statement.text.find("PYBIND11_MODULE") != std::string::npos) continue;  // Python finds it
    // BlockFactor<Scalar>::factor() is a member of BlockFactor.
    static const std::regex kArguments(R"((\w)<\w+>::)");
    const std::string name = called_name(std::regex_replace(statement.text, kArguments, "$1::"));
    const std::size_t scope = name.find("::");
    if (scope == std::string::npos) {
      if (!name.empty()) found.functions.insert(name);
    } else {
      found.classes.insert(name.substr(0, scope));
    }
  }
  return found;
}

}  // namespace viscard
