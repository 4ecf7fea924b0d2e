#pragma once

#include <string>
#include <string_view>

namespace viscard {

// A MATLAB file of level 5 with the same contents and no packed element. Empty if the file is damaged:
// if an element, or one in it, claims more bytes than there are, or does not unpack. libmatio asks for
// the memory that an element claims before it looks whether the file has as much.
// Source: MathWorks, "MAT-File Format", the chapter on level 5.
std::string unpacked_matlab_file(std::string_view bytes);

}  // namespace viscard
