#pragma once

#include "io/plots/plot.h"

#include <string>
#include <vector>

namespace viscard {

// A picture of the page for itself, in the order of the page.
struct ReportPicture {
  std::string name;  // "03_spectrum", a file name without suffix
  std::string svg;
};

// A table as HTML: caption, column headers, and rows whose first cell is the row's header.
class HtmlTable {
 public:
  struct Column {
    std::string header_html;
    bool is_number = true;  // set flush right
  };
  explicit HtmlTable(std::vector<Column> columns);

  enum class RowStyle { kPlain, kBeginsGroup, kChosen };  // a line above; a tint

  // Cells as HTML, as many as columns; throws std::invalid_argument otherwise.
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

// The body of a page as it grows: numbers sections, tables and figures, and remembers the contents.
class Page {
 public:
  // level 2 or 3; id of letters, digits and '-', unique on the page.
  void add_heading(int level, const std::string& id, const std::string& text);
  void add_paragraph(const std::string& html);
  void add_html(const std::string& html);  // as it is
  void add_table(const HtmlTable& table, const std::string& caption_html);
  // Figures between begin and end of a row stand side by side while the page is wide enough.
  void add_figure(const Plot& plot, const std::string& name, const std::string& caption_html);
  void begin_row_of_figures();
  void end_row_of_figures();

  const std::string& body() const { return body_; }
  std::string contents_html() const;  // navigation over the level-2 headings
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
const char* report_style();

}  // namespace viscard
