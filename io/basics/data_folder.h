#pragma once

#include <filesystem>
#include <string>

namespace viscard {

// The folder with the demo, scenes, protocols and materials that came with the running program:
// share/viscard beside the folder of an installed program or above that of a Python module, share/viscard
// within a build folder. Found by the place of the program alone, so that both may be moved. Throws std::runtime_error
// naming the places where it was looked for.
std::filesystem::path data_folder();

// The same for a program in the folder `of_program`.
std::filesystem::path data_folder_beside(const std::filesystem::path& of_program);

// An example of a command that works where it is read: its files of data/ are those of the source tree if
// there is such a folder in the current one, otherwise those of data_folder(), if it is there.
std::string example_with_data(const std::string& example);

}  // namespace viscard
