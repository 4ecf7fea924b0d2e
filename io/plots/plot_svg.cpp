#include "io/plots/plot_svg.h"

#include "io/basics/patterns.h"
#include "io/basics/words.h"

#include <fmt/format.h>

#include <stdexcept>
#include <string_view>

namespace viscard {
namespace {

std::string body_of(const std::string& document) {
  const std::size_t begin = document.find("<g id=\"gnuplot_canvas\">");
  const std::size_t end = document.rfind("</svg>");
  if (begin == std::string::npos || end == std::string::npos || end < begin) {
    throw std::runtime_error(
        "gnuplot drew something that is not an SVG picture; is its version 5?");
  }
  return document.substr(begin, end - begin);
}

void erase_all(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at)) {
    const std::size_t end = text.find(to, at + from.size());
    if (end == std::string::npos) return;
    text.erase(at, end + to.size() - at);
  }
}

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos;
       at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
}

// gnuplot opens a group for every change of pen, most of them without content.
void erase_empty_groups(std::string& text) {
  const std::string opening = "<g fill=\"none\"";
  std::string kept;
  kept.reserve(text.size());
  std::size_t done = 0;
  for (std::size_t at = text.find(opening); at != std::string::npos;
       at = text.find(opening, at + 1)) {
    const std::size_t close = text.find('>', at);
    if (close == std::string::npos) break;
    const std::size_t next = text.find_first_not_of(" \t\n", close + 1);
    if (next == std::string::npos || text.compare(next, 4, "</g>") != 0) continue;
    kept.append(text, done, at - done);
    done = next + 4;
  }
  kept.append(text, done);
  text = kept;
}

}  // namespace

std::string escaped_markup(const std::string& text) {
  constexpr std::string_view kSpecial = "&<>\"'";
  constexpr const char* kEntities[] = {"&amp;", "&lt;", "&gt;", "&quot;", "&#39;"};
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = utf8_length(text, i);
    if (length == 0) {
      out += "\xEF\xBF\xBD";
      ++i;
      continue;
    }
    if (length > 1) {
      out.append(text, i, length);
      i += length;
      continue;
    }
    const char c = text[i++];
    const std::size_t special = kSpecial.find(c);
    const bool is_control = static_cast<unsigned char>(c) < 0x20 || c == 0x7F;
    if (special != std::string_view::npos) {
      out += kEntities[special];
    } else {
      out += is_control && c != '\n' && c != '\t' ? ' ' : c;
    }
  }
  return out;
}

std::string figure_from_gnuplot_svg(const std::string& document, const std::string& id,
                                    const std::string& title, const std::string& description,
                                    int width_px, int height_px) {
  std::string body = body_of(document);
  erase_all(body, "<title>", "</title>");
  erase_all(body, "<filter", "</filter>");
  // Curves get ids that nothing refers to; symbols get ids that <use> needs.
  body = without_matches(body, " ?id=\"[A-Za-z0-9_-]*(_plot_[0-9]+[a-z]*|gnuplot_canvas)\" ?");
  replace_all(body, "id='gp", "id='" + id + "-gp");
  replace_all(body, "href='#gp", "href='#" + id + "-gp");
  // gnuplot dashes grid lines even if the script asks for solid ones.
  replace_all(body, "stroke-dasharray='2,4' class=\"gridline\"", "class=\"gridline\"");
  // "family:Bold" is split only in enhanced text, which would need escapes in every name.
  replace_all(body, "font-family=\"sans-serif:Bold\"",
              "font-family=\"sans-serif\" font-weight=\"600\"");
  erase_empty_groups(body);
  replace_all(body, "<g >", "<g>");
  return fmt::format(
             "<svg class=\"plot\" xmlns=\"http://www.w3.org/2000/svg\" "
             "xmlns:xlink=\"http://www.w3.org/1999/xlink\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" "
             "height=\"{1}\" style=\"background:#fff\" role=\"img\" aria-labelledby=\"{2}-title "
             "{2}-desc\">\n"
             "<title id=\"{2}-title\">{3}</title>\n<desc id=\"{2}-desc\">{4}</desc>\n",
             width_px, height_px, id, escaped_markup(title), escaped_markup(description)) +
         body + "</svg>\n";
}

}  // namespace viscard
