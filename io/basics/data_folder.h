#pragma once

#include <filesystem>

namespace viscard {

// The folder with the demo, scenes, protocols and materials that came with the running program:
// share/viscard beside the folder of an installed program, share/viscard within a build folder.
// Found by the place of the program alone, so that both may be moved. Throws std::runtime_error
// naming the places where it was looked for.
std::filesystem::path data_folder();

// The same for a program in the folder `of_program`.
std::filesystem::path data_folder_beside(const std::filesystem::path& of_program);

}  // namespace viscard
