#pragma once

#include <string>
#include <vector>

namespace viscard {

// A file of another program may hold several materials. They are told apart by name or number in keyword files
// (Abaqus, CalculiX, FrontISTR), FEBio, ANSYS (numbers), LS-DYNA, OpenRadioss and COMSOL (the words before the last
// "_"); in files for other targets not.

// The names, or the numbers of materials without a name, in their order; none for another target.
std::vector<std::string> material_names(const std::string& text, const std::string& target);

// The text in which all other materials are comments or blanks, so that lines keep their numbers. In CalculiX a name
// stands for all materials NAME_... that overlay each other. Throws std::invalid_argument naming the materials if there is
// no such one, and for a target whose materials are not told apart.
std::string material_named(const std::string& text, const std::string& target,
                           const std::string& name);

}  // namespace viscard
