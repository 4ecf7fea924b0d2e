#pragma once

#include "io/plots/plot.h"

#include <string>
#include <vector>

namespace viscard {

// One picture of the page, to be written to a file of its own.
struct ReportPicture {
  std::string name;  // "03_spectrum", a file name without suffix
  std::string svg;
};

// A table as HTML: caption, column headers, and rows whose first cell is the row's header.
class HtmlTable {
 public:
  struct Column {
    std::string header_html;
    bool is_number = true;  // aligned to the right
  };
  explicit HtmlTable(std::vector<Column> columns);

  enum class RowStyle {
    kPlain,
    kBeginsGroup,
    kChosen
  };  // kBeginsGroup: a line above; kChosen: a tint

  // Adds a row of cells in HTML. Throws std::invalid_argument unless there are as many as columns.
  void add_row(std::vector<std::string> cells_html, RowStyle style = RowStyle::kPlain);
  bool is_empty() const { return rows_.empty(); }

  std::string html(const std::string& caption_html) const;

 private:
  struct Row {
    std::vector<std::string> cells;
    RowStyle style = RowStyle::kPlain;
  };
  std::vector<Column> columns_;
  std::vector<Row> rows_;
};

// Builds the body of a page: numbers tables and figures, and collects the table of contents.
class Page {
 public:
  // level is 2 or 3; id has letters, digits and '-' and is unique on the page.
  void add_heading(int level, const std::string& id, const std::string& text);
  void add_paragraph(const std::string& html);
  void add_html(const std::string& html);  // without any change
  void add_table(const HtmlTable& table, const std::string& caption_html);
  void add_figure(const Plot& plot, const std::string& name, const std::string& caption_html);

  const std::string& body() const { return body_; }
  std::string contents_html() const;  // navigation to the level-2 headings
  const std::vector<ReportPicture>& pictures() const { return pictures_; }

 private:
  struct Heading {
    std::string id, text;
  };
  std::string body_;
  std::vector<Heading> headings_;
  std::vector<ReportPicture> pictures_;
  int n_tables_ = 0;
};

// The style sheet of the page, for screen and paper.
std::string report_style();

}  // namespace viscard
