#include "io/plots/plot_svg.h"

#include <fmt/format.h>

#include <regex>
#include <stdexcept>

namespace viscard {
namespace {

// Length in bytes of the UTF-8 character that begins at `at`, 0 if none does.
std::size_t utf8_length(const std::string& text, std::size_t at) {
  const auto byte = [&](std::size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u;
  };
  const unsigned lead = byte(at);
  std::size_t length = 0;
  if (lead < 0x80) return 1;
  if (lead >= 0xC2 && lead <= 0xDF) length = 2;
  if (lead >= 0xE0 && lead <= 0xEF) length = 3;
  if (lead >= 0xF0 && lead <= 0xF4) length = 4;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(at + i) & 0xC0u) != 0x80u) return 0;
  }
  const unsigned second = byte(at + 1);  // too long a form, or half of a surrogate pair
  if ((lead == 0xE0 && second < 0xA0) || (lead == 0xED && second > 0x9F) ||
      (lead == 0xF0 && second < 0x90) || (lead == 0xF4 && second > 0x8F)) {
    return 0;
  }
  return length;
}

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
    switch (const char c = text[i++]) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      case '\n':
      case '\t':
        out += c;
        break;
      default:
        out += (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) ? ' ' : c;
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
  static const std::regex curve_id(" ?id=\"[A-Za-z0-9_-]*(_plot_[0-9]+[a-z]*|gnuplot_canvas)\" ?");
  body = std::regex_replace(body, curve_id, "");
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
