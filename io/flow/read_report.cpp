#include "io/flow/read_report.h"

#include "io/basics/atomic_file.h"
#include "io/basics/data_uri.h"
#include "io/basics/inputs.h"
#include "io/basics/program.h"
#include "io/basics/written_path.h"
#include "io/flow/test_words.h"
#include "io/materials/hyperelastic_file.h"
#include "io/report/report_rubber.h"
#include "models/hyperelastic/hyperelastic_law.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

namespace viscard {
namespace {

namespace fs = std::filesystem;

// A law of rubber as the page shows it.
RubberReport rubber_report(const std::string& path) {
  const HyperelasticFile file = read_hyperelastic(path);
  RubberReport out{fs::path(path).filename().string(),
                   name_of(file) + (file.damage ? std::string("+") + kMullinsName : std::string()),
                   file.E0_Pa,
                   file.E_inf_Pa,
                   file.E0_interval_95,
                   file.E_inf_interval_95,
                   {},
                   file.t_min_s,
                   file.t_max_s,
                   "",
                   file.is_trustworthy};
  for (const RubberTerm& term : file.terms) out.terms.push_back({term.g, 0.0, term.tau_s});
  out.stretches = file.foam_tests;
  for (std::size_t d = 0; d < file.measured.size(); ++d) {
    if (!file.measured[d]) continue;
    out.stretches += (out.stretches.empty() ? "" : ", ") + deformation_names()[d] + " " +
                     text_of(file.measured[d]->low, 3) + " to " +
                     text_of(file.measured[d]->high, 3);
  }
  if (file.damage) {
    out.stretches += "; softened by its first loading to no less than " +
                     text_of(100.0 * (1.0 - 1.0 / file.damage->r), 3) + " %";
  }
  return out;
}

// Takes the laws of rubber out of the files.
std::vector<std::string> take_rubbers(std::vector<std::string>& files) {
  std::vector<std::string> rubbers, others;
  std::error_code error;
  for (const std::string& file : files) {
    const bool is_law = fs::path(file).extension() == ".json" && fs::is_regular_file(file, error) &&
                        looks_like_hyperelastic_file(file);
    (is_law ? rubbers : others).push_back(file);
  }
  files = others;
  return rubbers;
}

bool passed_pillar(const SpecimenReport& specimen) {
  if (!specimen.pillar) return true;
  const PillarCheck& pillar = *specimen.pillar;
  const double worst =
      std::max(pillar.relaxation.largest_relative_error, pillar.creep.largest_relative_error);
  return worst <= pillar.limit;
}

}  // namespace

void sort_inputs(ReportRequest& request) {
  if (request.files.empty()) {
    throw std::invalid_argument("no files given; give a capture, a table or a material file");
  }
  request.rubbers = take_rubbers(request.files);
  if (request.files.empty()) {
    throw std::invalid_argument(
        "a law of rubber stands beside linear tests; give a capture, a table or a material "
        "file too");
  }
  request.tests = tests_from_words(request.files, false);
  if (request.tests.size() == 1) {
    throw std::invalid_argument(
        "there is one test only; give its file without the kind, or more tests");
  }
  if (!request.tests.empty()) request.files.clear();
  const std::size_t n_truths = request.truth_files.size();
  if (n_truths == 0) return;
  const std::size_t n_measured = measured_count(request.files);
  if (n_truths == n_measured) return;
  throw std::invalid_argument(counted(n_truths, "truth file") + " for " +
                              counted(n_measured, "capture") +
                              ": give one --truth for each, in the same order, or none");
}

std::vector<std::string> write_report_pictures(const RenderedReport& report,
                                               const std::string& folder, bool overwrite) {
  fs::create_directories(folder);
  std::vector<std::string> paths;
  for (const ReportPicture& picture : report.pictures) {
    paths.push_back((fs::path(folder) / (picture.name + ".svg")).string());
    write_file(paths.back(), written_text(picture.svg), overwrite);
  }
  return paths;
}

ReportInput read_report(const ReportRequest& request, const std::string& title,
                        const FlowProgress& progress) {
  ReportInput input;
  input.title = title;
  if (!request.logo.empty()) input.logo_uri = data_uri_of_picture(request.logo);
  input.created_by = program_with_version();
  input.created_at = request.created_at;
  input.command = request.command;
  input.specimens = read_specimens(request, progress);
  input.law = mixing_law_of(request.files, input.specimens);
  for (const std::string& rubber : request.rubbers) input.rubbers.push_back(rubber_report(rubber));
  for (const InputFile& file : provenance_of_inputs()) {
    if (!file.note.empty()) input.doubts.push_back(file.path + ": " + file.note);
  }
  return input;
}

std::vector<std::string> defects_of(const ReportInput& input) {
  std::vector<std::string> lines;
  for (const SpecimenReport& specimen : input.specimens) {
    const std::string& id = specimen.specimen.id;
    if (specimen.fit && !specimen.fit->is_trustworthy) {
      lines.push_back(id +
                      ": the fit is not to be trusted; the page and viscard fit give the reason");
    }
    if (!passed_pillar(specimen)) {
      lines.push_back(id +
                      ": the pillar differs from the exact solution by more than the limit; see "
                      "the page and viscard validate");
    }
  }
  return lines;
}

}  // namespace viscard
