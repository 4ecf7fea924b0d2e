#pragma once

#include "models/pillar/body/section_grid.h"

#include <string>
#include <utility>
#include <vector>

namespace viscard {

// Pictures of a solution in the section along the axis, name and SVG: of every displacement the
// deformed body, coloured by its magnitude and exaggerated by a factor that the picture prints; of
// every scalar the body coloured by it. A potential is drawn over the film alone.
std::vector<std::pair<std::string, std::string>> pictures_from_grid(const SectionGrid& grid);

// A solution as an unstructured grid in VTK's XML format (.vtu, ASCII), which ParaView opens: a
// round pillar as hexahedra turned about the axis, a strip as quadrilaterals of both halves.
// Lengths in m; vectors are Cartesian, scalars keep their unit in the name. Source: Kitware, VTK
// File Formats, chapter "XML File Formats".
std::string vtu_from_grid(const SectionGrid& grid);

}  // namespace viscard
