#pragma once

#include <string>
#include <vector>

namespace viscard {

// Shares of one total, 0 to 1 each; the rest up to 1 is drawn in grey.
struct ShareBar {
  std::string name;
  std::string text;  // beside the bar
  std::vector<double> shares;
};

// Bars with one colour for each part, and the names of the parts below, as an SVG document.
std::string svg_from_shares(const std::vector<std::string>& parts, const std::string& rest,
                            const std::vector<ShareBar>& bars, const std::string& title);

}  // namespace viscard
