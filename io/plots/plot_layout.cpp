#include "io/plots/plot_layout.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace viscard {
namespace {

constexpr double kLeft = 68.0;  // axis label and tick labels
constexpr double kRight = 18.0;
constexpr double kTop = 10.0;
constexpr double kTitle = 20.0;
constexpr double kKeyRow = 18.0;
constexpr double kBottom = 46.0;
constexpr double kBottomShared = 8.0;
constexpr double kNotes = 14.0;
constexpr double kCharacter = 8.2;   // what gnuplot reckons for a character of the 12 px font
constexpr double kKeySample = 44.0;  // the bit of line beside a legend entry, and the gaps

struct KeyShape {
  int rows = 0;
  int columns = 1;
};

KeyShape key_shape(const PlotPanel& panel, double width) {
  int n_entries = 0;
  double entry_px = 0.0;
  for (const PlotSeries& series : panel.series) {
    if (series.label.empty()) continue;
    ++n_entries;
    const double label_px = kCharacter * static_cast<double>(length_in_characters(series.label));
    entry_px = std::max(entry_px, label_px + kKeySample);
  }
  if (n_entries == 0) return {};
  const int columns = std::clamp(static_cast<int>(width / entry_px), 1, n_entries);
  return {(n_entries + columns - 1) / columns, columns};
}

bool has_notes(const PlotPanel& panel) {
  return std::any_of(panel.notes.begin(), panel.notes.end(),
                     [](const PlotNote& note) { return !note.text.empty(); });
}

double above_data(const PlotPanel& panel, double width) {
  return kTop + (panel.title.empty() ? 0.0 : kTitle) + (has_notes(panel) ? kNotes : 0.0) +
         kKeyRow * key_shape(panel, width).rows;
}

struct RowHeights {
  std::vector<double> above, data, below;
};

RowHeights row_heights(const Plot& plot, double data_width) {
  RowHeights heights;
  const std::size_t columns = static_cast<std::size_t>(plot.columns);
  for (std::size_t first = 0; first < plot.panels.size(); first += columns) {
    double above = 0.0, below = 0.0;
    for (std::size_t i = first; i < std::min(first + columns, plot.panels.size()); ++i) {
      above = std::max(above, above_data(plot.panels[i], data_width));
      below = std::max(below, plot.panels[i].shares_x_with_below ? kBottomShared : kBottom);
    }
    heights.above.push_back(above);
    heights.below.push_back(below);
    heights.data.push_back(plot.panels[first].height_share);
  }
  const double fixed = std::accumulate(heights.above.begin(), heights.above.end(), 0.0) +
                       std::accumulate(heights.below.begin(), heights.below.end(), 0.0);
  const double shares = std::accumulate(heights.data.begin(), heights.data.end(), 0.0);
  for (double& height : heights.data) height *= (plot.height_px - fixed) / shares;
  return heights;
}

}  // namespace

std::size_t length_in_characters(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0u) != 0x80u;
  }));
}

std::vector<PanelBox> panel_boxes(const Plot& plot) {
  if (plot.columns < 1 || plot.panels.empty()) {
    throw std::invalid_argument("plot '" + plot.title + "' has no panel");
  }
  const double column_px = static_cast<double>(plot.width_px) / plot.columns;
  const double data_width = column_px - kLeft - kRight;
  const RowHeights rows = row_heights(plot, data_width);
  if (data_width < 40.0 || *std::min_element(rows.data.begin(), rows.data.end()) < 20.0) {
    throw std::invalid_argument("plot '" + plot.title + "' is too small for its panels");
  }
  std::vector<PanelBox> boxes;
  double top = 0.0;
  for (std::size_t i = 0; i < plot.panels.size(); ++i) {
    const std::size_t column = i % static_cast<std::size_t>(plot.columns);
    const std::size_t row = i / static_cast<std::size_t>(plot.columns);
    if (column == 0 && row > 0)
      top += rows.above[row - 1] + rows.data[row - 1] + rows.below[row - 1];
    PanelBox box;
    box.left = static_cast<double>(column) * column_px + kLeft;
    box.right = box.left + data_width;
    box.top = top + rows.above[row];
    box.bottom = box.top + rows.data[row];
    const KeyShape key = key_shape(plot.panels[i], data_width);
    box.key_columns = key.columns;
    box.key_top = box.top - (has_notes(plot.panels[i]) ? kNotes : 0.0) - kKeyRow * key.rows;
    box.title_top = box.key_top - kTitle;
    boxes.push_back(box);
  }
  return boxes;
}

}  // namespace viscard
