#include "models/pillar/mesh/section.h"

#include "models/maths/require.h"
#include "models/maths/usable_machine.h"

#include <cmath>
#include <stdexcept>
#include <utility>

namespace viscard {
namespace {

double middle(const LineMesh& line, int element) {
  return line.breaks()[static_cast<std::size_t>(element)] + 0.5 * line.length(element);
}

// Refuses a mesh whose nodes, with one matrix of one field, need more memory than there is.
void require_room(const LineMesh& x, const LineMesh& z,
                  const std::function<int(double, double)>& region_at) {
  constexpr double kFew = 1e5;  // elements
  if (1.0 * x.element_count() * z.element_count() < kFew) return;
  double elements = 0.0;
  for (int row = 0; row < z.element_count(); ++row) {
    for (int column = 0; column < x.element_count(); ++column) {
      elements += region_at(middle(x, column), middle(z, row)) == Section::kEmpty ? 0.0 : 1.0;
    }
  }
  const double p = x.degree();
  const double nodes = elements * p * p;
  constexpr double kNode_B = 64.0, kEntry_B = 12.0;
  require_memory(nodes, nodes * (kNode_B + 0.5 * (p + 2.0) * (p + 2.0) * kEntry_B));
}

}  // namespace

Section::Section(LineMesh x, LineMesh z, const std::function<int(double, double)>& region_at)
    : x_(std::move(x)), z_(std::move(z)) {
  require(x_.degree() == z_.degree(), "both directions of a section must have one element degree");
  require_room(x_, z_, region_at);
  const int p = degree();
  node_.assign(
      static_cast<std::size_t>(x_.node_count()) * static_cast<std::size_t>(z_.node_count()), -1);
  for (int row = 0; row < z_.element_count(); ++row) {
    for (int column = 0; column < x_.element_count(); ++column) {
      region_.push_back(region_at(middle(x_, column), middle(z_, row)));
      if (region_.back() == kEmpty) continue;
      SectionElement element{column, row, region_.back(), {}};
      for (int i = 0; i <= p; ++i) {
        for (int j = 0; j <= p; ++j) {
          const int ix = column * p + j;
          const int iz = row * p + i;
          int& id = node_[static_cast<std::size_t>(iz * x_.node_count() + ix)];
          if (id < 0) {
            id = node_count();
            node_x_.push_back(x_.nodes()[static_cast<std::size_t>(ix)]);
            node_z_.push_back(z_.nodes()[static_cast<std::size_t>(iz)]);
          }
          element.nodes.push_back(id);
        }
      }
      elements_.push_back(std::move(element));
    }
  }
  require(!elements_.empty(), "the section has no material anywhere");
}

void Section::stretch(int region, std::function<Stretch(double)> of_height) {
  std::vector<bool> is_done(node_x_.size(), false);
  for (const SectionElement& element : elements_) {
    if (element.region != region) continue;
    for (const int id : element.nodes) {
      const auto node = static_cast<std::size_t>(id);
      const double scale = of_height(node_z_[node]).scale;
      if (!(scale > 0.0) || !std::isfinite(scale)) {
        throw std::invalid_argument(
            "the outline shrinks to nothing at z = " + micrometres(node_z_[node]) +
            ": elements would be turned inside out there");
      }
      if (!is_done[node]) node_x_[node] *= scale;
      is_done[node] = true;
    }
  }
  stretched_region_ = region;
  stretch_ = std::move(of_height);
}

int Section::region(int column, int row) const {
  if (column < 0 || row < 0 || column >= x_.element_count() || row >= z_.element_count())
    return kEmpty;
  return region_[static_cast<std::size_t>(row * x_.element_count() + column)];
}

int Section::node(int ix, int iz) const {
  return node_[static_cast<std::size_t>(iz * x_.node_count() + ix)];
}

}  // namespace viscard
