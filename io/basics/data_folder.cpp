#include "io/basics/data_folder.h"

#include <dlfcn.h>

#include <stdexcept>
#include <string>
#include <system_error>

namespace fs = std::filesystem;

namespace viscard {

fs::path data_folder_beside(const fs::path& of_program) {
  // The first is set by CMake: the way from the installed program to the installed data.
  const fs::path installed = (of_program / VISCARD_DATA_FROM_PROGRAM).lexically_normal();
  const fs::path built = of_program / "share" / "viscard";
  for (const fs::path& folder : {installed, built}) {
    std::error_code error;
    if (fs::is_directory(folder / "demo", error)) return folder;
  }
  throw std::runtime_error("the files that come with viscard were not found in '" +
                           installed.string() + "' nor in '" + built.string() +
                           "'; install viscard again, or state the folder of the files");
}

fs::path data_folder() {
  // A Python module is not beside the program that runs it: PREFIX/lib/python3/dist-packages/viscard.
  static const char kHere = 0;
  Dl_info module{};
  const bool is_known = ::dladdr(&kHere, &module) != 0 && module.dli_fname != nullptr;
  if (is_known && fs::path(module.dli_fname).extension() == ".so") {
    std::error_code error;
    fs::path above = fs::absolute(module.dli_fname, error).parent_path();
    for (; above.has_relative_path(); above = above.parent_path()) {
      fs::path folder = above / "share" / "viscard";
      if (fs::is_directory(folder / "demo", error)) return folder;
    }
  }
  return data_folder_beside(fs::read_symlink("/proc/self/exe").parent_path());
}

std::string example_with_data(const std::string& example) {
  static const std::string kShort = " data/";
  if (fs::is_directory("data")) return example;
  std::string text = example, folder;
  try {
    folder = " " + data_folder().string() + "/";
  } catch (const std::runtime_error&) {
    return example;
  }
  for (std::size_t at = text.find(kShort); at != std::string::npos;
       at = text.find(kShort, at + 1)) {
    text.replace(at, kShort.size(), folder);
  }
  return text;
}

}  // namespace viscard
