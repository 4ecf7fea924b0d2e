#include "tests/io/plots/markup.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <regex>

namespace viscard::test {
namespace {

constexpr std::array<const char*, 4> kVoid{"meta", "br", "link", "hr"};

std::string fault_at(const std::string& what, const std::string& markup, std::size_t at) {
  return what + " near: " + markup.substr(at > 40 ? at - 40 : 0, 120);
}

// Index behind the '>' that ends the tag at `at`; quoted attributes may contain '>'.
std::size_t end_of_tag(const std::string& markup, std::size_t at) {
  char quote = 0;
  for (std::size_t i = at; i < markup.size(); ++i) {
    const char c = markup[i];
    if (quote != 0) {
      if (c == quote) quote = 0;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '>') {
      return i + 1;
    }
  }
  return std::string::npos;
}

std::string name_of_tag(const std::string& tag) {
  std::size_t begin = tag[1] == '/' ? 2 : 1, end = begin;
  while (end < tag.size() && std::isalnum(static_cast<unsigned char>(tag[end])) != 0) ++end;
  return tag.substr(begin, end - begin);
}

bool is_name(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == ':';
}

// <name attribute="value" attribute='value' flag> and nothing else; no < in a value. By hand: a
// regular expression would recurse once for every character of a path.
bool has_plain_attributes(const std::string& tag) {
  std::size_t i = 1;
  const auto skip = [&](auto&& belongs) {
    const std::size_t from = i;
    while (i < tag.size() && belongs(tag[i])) ++i;
    return i - from;
  };
  const auto is_blank = [](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; };
  if (skip(is_name) == 0) return false;
  for (;;) {
    const bool is_apart = skip(is_blank) > 0;
    if (tag.compare(i, 2, "/>") == 0 || tag.compare(i, 1, ">") == 0) return true;
    if (!is_apart || skip(is_name) == 0) return false;
    const std::size_t after_name = i;
    skip(is_blank);
    if (tag[i] != '=') {
      i = after_name;
      continue;
    }
    ++i;
    skip(is_blank);
    const char quote = tag[i++];
    if (quote != '"' && quote != '\'') return false;
    skip([&](char c) { return c != quote && c != '<'; });
    if (tag[i++] != quote) return false;
  }
}

bool is_entity(const std::string& markup, std::size_t at) {
  static const std::regex shape("&(amp|lt|gt|quot|#[0-9]+);");
  return std::regex_search(markup.begin() + static_cast<std::ptrdiff_t>(at), markup.end(), shape,
                           std::regex_constants::match_continuous);
}

}  // namespace

std::string first_fault(const std::string& markup) {
  std::vector<std::string> open;
  for (std::size_t i = 0; i < markup.size();) {
    if (markup[i] == '&' && !is_entity(markup, i)) return fault_at("bare &", markup, i);
    if (markup[i] != '<') {
      ++i;
      continue;
    }
    const std::size_t end = end_of_tag(markup, i);
    if (end == std::string::npos) return fault_at("tag without end", markup, i);
    const std::string tag = markup.substr(i, end - i);
    const std::string name = name_of_tag(tag);
    i = end;
    if (tag.rfind("<!DOCTYPE", 0) == 0) continue;
    if (name.empty()) return fault_at("bare <", markup, i);
    if (tag[1] == '/') {
      if (open.empty() || open.back() != name) return fault_at("stray </" + name + ">", markup, i);
      open.pop_back();
      continue;
    }
    if (!has_plain_attributes(tag)) return fault_at("odd attributes in " + tag, markup, i);
    const bool is_void = std::find(kVoid.begin(), kVoid.end(), name) != kVoid.end();
    if (tag[tag.size() - 2] == '/' || is_void) continue;
    open.push_back(name);
    if (name == "style") i = markup.find("</style>", i);  // css is no markup
  }
  return open.empty() ? "" : "<" + open.back() + "> is never closed";
}

std::vector<std::string> ids_of(const std::string& markup) {
  static const std::regex shape(R"(\sid=["']([^"']*)["'])");
  std::vector<std::string> ids;
  for (std::sregex_iterator it(markup.begin(), markup.end(), shape), end; it != end; ++it) {
    ids.push_back((*it)[1]);
  }
  return ids;
}

std::string text_of(const std::string& markup) {
  std::string text;
  for (std::size_t i = 0; i < markup.size();) {
    if (markup[i] == '<') {
      i = end_of_tag(markup, i);
      if (i == std::string::npos) break;
      text += ' ';
    } else {
      text += markup[i++];
    }
  }
  for (const auto& [entity, plain] :
       {std::pair{"&lt;", "<"}, {"&gt;", ">"}, {"&quot;", "\""}, {"&#39;", "'"}, {"&amp;", "&"}}) {
    text = std::regex_replace(text, std::regex(entity), plain);
  }
  return std::regex_replace(text, std::regex("\\s+"), " ");
}

std::vector<ShownNumber> numbers_of(const std::string& markup) {
  static const std::regex shape(R"re(<data value="([^"]*)">([^<]*)</data>)re");
  std::vector<ShownNumber> numbers;
  for (std::sregex_iterator it(markup.begin(), markup.end(), shape), end; it != end; ++it) {
    numbers.push_back({std::stod((*it)[1]), (*it)[2]});
  }
  return numbers;
}

}  // namespace viscard::test
