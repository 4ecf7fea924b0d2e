#include "io/pictures/section_picture.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <numbers>
#include <vector>

namespace viscard {
namespace {

constexpr int kAngles = 24;
constexpr int kHexahedron = 12;
constexpr int kQuadrilateral = 9;

// The half planes on which the section stands, one after the other.
std::vector<double> angles_of(const SectionGrid& grid) {
  if (!grid.is_round) return {0.0, std::numbers::pi};
  std::vector<double> angles;
  for (int i = 0; i < kAngles; ++i) angles.push_back(2.0 * std::numbers::pi * i / kAngles);
  return angles;
}

void open_array(std::string& text, const char* type, const std::string& name, int components) {
  text += fmt::format(
      "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"ascii\">\n", type,
      name, components);
}

void add_points(const SectionGrid& grid, const std::vector<double>& angles, std::string& text) {
  text += "<Points>\n";
  open_array(text, "Float64", "Points", 3);
  for (const double theta : angles) {
    for (std::size_t i = 0; i < grid.x_m.size(); ++i) {
      fmt::format_to(std::back_inserter(text), "{:.9g} {:.9g} {:.9g}\n",
                     grid.x_m[i] * std::cos(theta), grid.x_m[i] * std::sin(theta), grid.z_m[i]);
    }
  }
  text += "</DataArray>\n</Points>\n";
}

void add_cells(const SectionGrid& grid, const std::vector<double>& angles, std::string& text) {
  const std::size_t n = grid.x_m.size();
  const std::size_t cells = grid.quads.size() * angles.size();
  text += "<Cells>\n";
  open_array(text, "Int64", "connectivity", 1);
  for (std::size_t a = 0; a < angles.size(); ++a) {
    const std::size_t here = a * n;
    const std::size_t next = (a + 1) % angles.size() * n;
    for (const auto& quad : grid.quads) {
      for (const int corner : quad) {
        fmt::format_to(std::back_inserter(text), "{} ", here + static_cast<std::size_t>(corner));
      }
      for (const int corner : quad) {
        if (!grid.is_round) break;
        fmt::format_to(std::back_inserter(text), "{} ", next + static_cast<std::size_t>(corner));
      }
      text += "\n";
    }
  }
  text += "</DataArray>\n";
  open_array(text, "Int64", "offsets", 1);
  const std::size_t corners = grid.is_round ? 8 : 4;
  for (std::size_t i = 1; i <= cells; ++i) text += fmt::format("{}\n", i * corners);
  text += "</DataArray>\n";
  open_array(text, "UInt8", "types", 1);
  for (std::size_t i = 0; i < cells; ++i) {
    text += fmt::format("{}\n", grid.is_round ? kHexahedron : kQuadrilateral);
  }
  text += "</DataArray>\n</Cells>\n";
}

void add_field(const SectionGrid& grid, const SectionField& field,
               const std::vector<double>& angles, std::string& text) {
  open_array(text, "Float64", field.name, field.is_vector ? 3 : 1);
  for (const double theta : angles) {
    for (std::size_t i = 0; i < grid.x_m.size(); ++i) {
      if (field.is_vector) {
        const auto u = displacement_at(grid, field, i, theta);
        fmt::format_to(std::back_inserter(text), "{:.7g} {:.7g} {:.7g}\n", u[0], u[1], u[2]);
      } else {
        fmt::format_to(std::back_inserter(text), "{:.7g}\n", scalar_at(grid, field, i, theta));
      }
    }
  }
  text += "</DataArray>\n";
}

void add_materials(const SectionGrid& grid, const std::vector<double>& angles, std::string& text) {
  text += "<CellData>\n";
  open_array(text, "UInt8", "is_film", 1);
  for (std::size_t a = 0; a < angles.size(); ++a) {
    for (const bool is_film : grid.is_film) text += is_film ? "1\n" : "0\n";
  }
  text += "</DataArray>\n</CellData>\n";
}

}  // namespace

std::string vtu_from_grid(const SectionGrid& grid) {
  const std::vector<double> angles = angles_of(grid);
  std::string text = fmt::format(
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
      "<UnstructuredGrid>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n",
      grid.x_m.size() * angles.size(), grid.quads.size() * angles.size());
  add_points(grid, angles, text);
  add_cells(grid, angles, text);
  text += "<PointData>\n";
  for (const SectionField& field : grid.fields) add_field(grid, field, angles, text);
  text += "</PointData>\n";
  add_materials(grid, angles, text);
  return text + "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
}

}  // namespace viscard
