#pragma once

#include <string>

namespace viscard {

// gnuplot's SVG document as a figure of a page: the XML declaration goes, every id begins with
// `id`, ids and tooltips that nothing refers to go, empty groups go, and title and description are
// put in for readers who cannot see it. Throws std::runtime_error if it is not a gnuplot document.
std::string figure_from_gnuplot_svg(const std::string& document, const std::string& id,
                                    const std::string& title, const std::string& description,
                                    int width_px, int height_px);

// & < > " ' as entities, control characters as blanks: text that is safe inside an element and
// inside a quoted attribute, of HTML and of SVG alike. Bytes that are not UTF-8 become U+FFFD.
std::string escaped_markup(const std::string& text);

}  // namespace viscard
