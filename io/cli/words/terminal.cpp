#include "io/cli/words/terminal.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <string>

namespace viscard {
namespace {

constexpr std::size_t kNarrowest = 40;

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

}  // namespace

std::size_t columns_of(int descriptor) {
  winsize size{};
  if (isatty(descriptor) == 1 && ioctl(descriptor, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) {
    return std::max<std::size_t>(size.ws_col, kNarrowest);
  }
  const std::string columns = variable("COLUMNS");
  const bool is_number = !columns.empty() && columns.size() < 6 &&
                         columns.find_first_not_of("0123456789") == std::string::npos;
  return is_number ? std::max<std::size_t>(std::stoul(columns), kNarrowest) : 0;
}

bool is_drawable(int descriptor) {
  return isatty(descriptor) == 1 && variable("TERM") != "dumb";
}

bool is_coloured(const Words& words, int descriptor) {
  for (std::size_t i = 0; i < words.size(); ++i) {
    const bool is_apart = words[i] == "--color" && i + 1 < words.size();
    const std::string when = is_apart                             ? words[i + 1]
                             : words[i].rfind("--color=", 0) == 0 ? words[i].substr(8)
                                                                  : "";
    if (when == "always") return true;
    if (when == "never") return false;
  }
  return is_drawable(descriptor) && variable("NO_COLOR").empty() && !variable("TERM").empty();
}

std::string bold(const std::string& text, bool is_coloured) {
  return is_coloured ? "\033[1m" + text + "\033[0m" : text;
}

std::string bold_red(const std::string& text, bool is_coloured) {
  return is_coloured ? "\033[1;31m" + text + "\033[0m" : text;
}

}  // namespace viscard
