#pragma once

#include "models/answer/scene_answer.h"
#include "models/pillar/body/section_grid.h"

#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace viscard {

// Displacement of a field at an angle, with its scalar, in Cartesian axes.
std::array<double, 3> displacement_at(const SectionGrid& grid, const SectionField& field,
                                      std::size_t point, double theta);
// A field without direction at an angle.
double scalar_at(const SectionGrid& grid, const SectionField& field, std::size_t point,
                 double theta);

// Pictures of a solution in the section along the axis, name and SVG: of every displacement the
// deformed body, coloured by its magnitude and exaggerated by a factor that the picture prints; of
// every scalar the body coloured by it. A potential is drawn over the film alone. A bar shows a length of the body.
//   captions: words for fields by their name; scene: its name, which ends the title
std::vector<std::pair<std::string, std::string>> pictures_from_grid(
    const SectionGrid& grid, const std::map<std::string, std::string>& captions = {},
    const std::string& scene = "");

// The frequencies of modes ("lateral_2") and the load of a buckling shape, with their errors.
std::map<std::string, std::string> captions_from_answer(const SceneAnswer& answer);

// A solution as an unstructured grid in VTK's XML format (.vtu, ASCII), which ParaView opens: a
// round pillar as hexahedra turned about the axis, a strip as quadrilaterals of both halves.
// Lengths in m; vectors are Cartesian, scalars keep their unit in the name. Source: Kitware, VTK
// File Formats, chapter "XML File Formats".
std::string vtu_from_grid(const SectionGrid& grid);

}  // namespace viscard
