#include "io/plots/plot_svg.h"
#include "io/report/report.h"
#include "io/report/report_estimates.h"
#include "io/report/report_rubber.h"
#include "io/report/report_sections.h"
#include "models/maths/text_of_number.h"

#include <map>
#include <stdexcept>
#include <string>

namespace viscard {
namespace {

// Repeats on one specimen differ by the number of their touch.
void number_touches(std::vector<SpecimenEstimates>& estimates) {
  std::map<std::string, int> n_touches, number;
  for (const SpecimenEstimates& one : estimates) ++n_touches[one.specimen_id];
  for (SpecimenEstimates& one : estimates) {
    if (one.specimen_id.empty() || n_touches[one.specimen_id] < 2) continue;
    one.label += ", touch " + std::to_string(++number[one.specimen_id]);
  }
}

std::vector<SpecimenEstimates> all_estimates(const ReportInput& input) {
  if (input.specimens.empty())
    throw std::invalid_argument(
        "report: there is no specimen to show; give a capture or a material file");
  std::vector<SpecimenEstimates> estimates;
  for (std::size_t i = 0; i < input.specimens.size(); ++i) {
    estimates.push_back(estimates_from_specimen(input.specimens[i], i));
    if (estimates.back().is_stiffness != estimates.front().is_stiffness) {
      throw std::invalid_argument(
          "report: " + estimates.back().label + " and " + estimates.front().label +
          " cannot share a page: one has moduli, the other stiffnesses, because no punch geometry "
          "was given; make two pages, or fit again with the geometry");
    }
  }
  number_touches(estimates);
  return estimates;
}

Page page_from_report(const ReportInput& input) {
  const std::vector<SpecimenEstimates> estimates = all_estimates(input);
  Page page;
  add_summary(page, input, estimates);
  add_recovery(page, input, estimates);
  add_rubbers(page, input, estimates);
  add_pillar(page, input, estimates);
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    add_specimen(page, input.specimens[i], estimates[i]);
  }
  add_cards(page, input, estimates);
  add_methods(page, input);
  add_provenance(page, input, estimates);
  return page;
}

std::string byline(const ReportInput& input) {
  std::string text = counted(input.specimens.size(), "specimen");
  if (!input.created_by.empty()) text += " · " + escaped_markup(input.created_by);
  if (!input.created_at.empty()) text += " · " + escaped_markup(input.created_at);
  return text;
}

std::string html_from_page(const ReportInput& input, const Page& page) {
  const std::string title = escaped_markup(input.title.empty() ? "viscard report" : input.title);
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n<title>" +
      title + "</title>\n<style>" + report_style() + "</style>\n</head>\n<body>\n";
  html +=
      "<header class=\"top\">\n" +
      (input.logo_uri.empty() ? ""
                              : "<img class=\"logo\" alt=\"\" src=\"" + input.logo_uri + "\">\n") +
      "<p class=\"by\">" + byline(input) + "</p>\n<h1>" + title + "</h1>\n";
  if (!input.introduction.empty()) {
    html += "<p class=\"lead\">" + escaped_markup(input.introduction) + "</p>\n";
  }
  if (!input.doubts.empty()) html += "<ul class=\"flags\">\n";
  for (const std::string& doubt : input.doubts) html += "<li>" + escaped_markup(doubt) + "</li>\n";
  if (!input.doubts.empty()) html += "</ul>\n";
  html += page.contents_html() + "</header>\n<main>\n" + page.body() + "</main>\n<footer>\n";
  if (!input.command.empty()) {
    html += "<p>Made by <code>" + escaped_markup(input.command) + "</code></p>\n";
  }
  return html + "</footer>\n</body>\n</html>\n";
}

}  // namespace

RenderedReport render_report(const ReportInput& input) {
  const Page page = page_from_report(input);
  return {html_from_page(input, page), page.pictures()};
}

}  // namespace viscard
