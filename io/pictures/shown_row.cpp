#include "io/pictures/shown_row.h"

namespace viscard {
namespace {

constexpr int kMostPillars = 16;

}  // namespace

ShownRow shown_row(const ArrayGeometry& g) {
  const double pitch_m = g.diameter_m + g.spacing_m;
  ShownRow row;
  row.is_cut = g.count > kMostPillars;
  const int places = row.is_cut ? kMostPillars + 1 : g.count;
  const int half = kMostPillars / 2;
  for (int place = 0; place < places; ++place) {
    const double middle_m = (place - 0.5 * (places - 1)) * pitch_m;
    if (row.is_cut && place == half) {
      row.cut_m = middle_m;
      continue;
    }
    const int number = row.is_cut && place > half ? g.count - (places - 1 - place) : place + 1;
    row.pillars.emplace_back(number, middle_m);
  }
  const double beyond_m = g.ends == FilmEnds::kMirror ? 0.5 * g.spacing_m : g.film_edge_m;
  row.left_m = row.pillars.front().second - 0.5 * g.diameter_m - beyond_m;
  row.right_m = row.pillars.back().second + 0.5 * g.diameter_m + beyond_m;
  return row;
}

}  // namespace viscard
