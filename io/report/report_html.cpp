#include "io/report/report_html.h"

#include "io/plots/plot_svg.h"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

namespace viscard {

HtmlTable::HtmlTable(std::vector<Column> columns) : columns_(std::move(columns)) {}

void HtmlTable::add_row(std::vector<std::string> cells_html, RowStyle style) {
  if (cells_html.size() != columns_.size()) {
    throw std::invalid_argument("report: a row of a table has " +
                                std::to_string(cells_html.size()) + " cells for " +
                                std::to_string(columns_.size()) + " columns");
  }
  rows_.push_back({std::move(cells_html), style});
}

std::string HtmlTable::html(const std::string& caption_html) const {
  constexpr const char* kRowStarts[] = {"<tr>", "<tr class=\"group\">", "<tr class=\"chosen\">"};
  std::string out =
      "<div class=\"table\"><table>\n<caption>" + caption_html + "</caption>\n<thead><tr>";
  const auto css = [&](std::size_t i) { return columns_[i].is_number ? " class=\"n\"" : ""; };
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    out += fmt::format("<th scope=\"col\"{}>{}</th>", css(i), columns_[i].header_html);
  }
  out += "</tr></thead>\n<tbody>\n";
  for (const Row& row : rows_) {
    out += kRowStarts[static_cast<std::size_t>(row.style)];
    out += fmt::format("<th scope=\"row\"{}>{}</th>", css(0), row.cells[0]);
    for (std::size_t i = 1; i < row.cells.size(); ++i) {
      out += fmt::format("<td{}>{}</td>", css(i), row.cells[i]);
    }
    out += "</tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

void Page::add_heading(int level, const std::string& id, const std::string& text) {
  const std::string safe = escaped_markup(text);
  body_ += fmt::format("<h{0} id=\"{1}\">{2}</h{0}>\n", level, id, safe);
  if (level == 2) headings_.push_back({id, safe});
}

void Page::add_paragraph(const std::string& html) {
  body_ += "<p>" + html + "</p>\n";
}

void Page::add_html(const std::string& html) {
  body_ += html;
}

void Page::add_table(const HtmlTable& table, const std::string& caption_html) {
  ++n_tables_;
  body_ += table.html(fmt::format("<b>Table {}.</b> {}", n_tables_, caption_html));
}

void Page::add_figure(const Plot& plot, const std::string& name, const std::string& caption_html) {
  const std::size_t number = pictures_.size() + 1;
  const std::string id = fmt::format("fig-{}", number);
  pictures_.push_back({fmt::format("{:02}_{}", number, name), svg_from_plot(plot, id)});
  body_ += fmt::format(
      "<figure id=\"{}\">\n<div class=\"drawing\">{}</div>\n<figcaption><b>Figure {}.</b> "
      "{}</figcaption></figure>\n",
      id, pictures_.back().svg, number, caption_html);
}

std::string Page::contents_html() const {
  std::string out = "<nav aria-label=\"Contents\"><ol>\n";
  for (const Heading& heading : headings_) {
    out += fmt::format("<li><a href=\"#{}\">{}</a></li>\n", heading.id, heading.text);
  }
  return out + "</ol></nav>\n";
}

}  // namespace viscard
