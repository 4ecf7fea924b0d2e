#include "io/basics/named_file.h"

#include "io/basics/data_folder.h"
#include "io/basics/missing_file.h"

#include <stdexcept>
#include <system_error>

namespace fs = std::filesystem;

namespace viscard {
namespace {

// A file of this name among those that came with viscard; empty if there is none.
fs::path shipped_file(const std::string& name) {
  std::error_code error;
  try {
    for (const fs::directory_entry& folder : fs::directory_iterator(data_folder())) {
      if (fs::is_regular_file(folder.path() / name, error)) return folder.path() / name;
    }
  } catch (const std::runtime_error&) {
  }
  return {};
}

}  // namespace

std::string fault_of_named_file(const fs::path& folder, const std::string& name, FileKind wanted) {
  const fs::path path = folder / name;
  if (is_readable(path)) return "";
  std::error_code error;
  const fs::path whole = fs::weakly_canonical(fs::absolute(path, error), error);
  const std::string where = "names '" + name + "', but ";
  const std::string shown = "'" + (error ? path : whole).string() + "'";
  if (fs::exists(path, error)) {
    const bool is_folder = fs::is_directory(path, error);
    return where + shown +
           (is_folder ? " is a folder; name a file in it"
                      : " cannot be read; give yourself the right to (chmod u+r)");
  }
  const std::string fault = where + "there is no file " + shown + "; ";
  const fs::path file = path.filename();
  const fs::path shipped = file.empty() ? fs::path() : shipped_file(file.string());
  if (!shipped.empty())
    return fault + "viscard came with one of this name, '" + shipped.string() + "'";
  const std::string near = near_file(path);
  if (!near.empty()) return fault + "did you mean '" + near + "'?";
  return fault + "correct the path; expected is " + file_kind_in_words(wanted) + ", " +
         form_of_file_kind(wanted);
}

}  // namespace viscard
