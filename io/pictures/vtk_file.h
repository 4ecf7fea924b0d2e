#pragma once

#include "models/pillar/body/section_grid.h"

#include <string>

namespace viscard {

// A solution as an unstructured grid in VTK's XML format (.vtu, ASCII), which ParaView opens: a
// round pillar as hexahedra turned about the axis, a strip as quadrilaterals of both halves.
// Lengths in m; vectors are Cartesian, scalars keep their unit in the name. Source: Kitware, VTK
// File Formats, chapter "XML File Formats".
std::string vtu_from_grid(const SectionGrid& grid);

}  // namespace viscard
