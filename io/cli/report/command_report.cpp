#include "io/basics/atomic_file.h"
#include "io/basics/timestamp.h"
#include "io/basics/written_path.h"
#include "io/cards/targets/card_targets.h"
#include "io/cards/unit_system.h"
#include "io/cli/report/report_commands.h"
#include "io/cli/words/command_line.h"
#include "io/cli/words/json_output.h"
#include "io/cli/words/output_paths.h"
#include "io/cli/words/progress.h"
#include "io/cli/words/stop_on_signal.h"
#include "io/flow/fit_file.h"
#include "io/flow/read_report.h"
#include "io/flow/specimen_reports.h"
#include "io/report/report.h"
#include "io/report/report_rubber.h"
#include "models/maths/text_of_number.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <ostream>

namespace fs = std::filesystem;
namespace viscard {
namespace {

// The options of `viscard report`.
struct ReportWords {
  std::vector<std::string> files, truth, cards;
  std::optional<std::string> out, pictures, logo;
  std::string title = "Soft polymer, from load cell to material", units = "mm-t-s";
  bool is_reproducible = false, overwrite = false, unverified = false;
  Plausible plausible = Plausible::kMeasured;
};

CommandSyntax report_syntax(ReportWords& words) {
  CommandSyntax syntax{
      "viscard report FILE... --out PAGE.html [OPTIONS]",
      "Writes one self-contained HTML page about captures and tables (which it fits), material "
      "files and a joint fit, laws of rubber beside them (viscard fit uniaxial=a.csv --out), or "
      "about several tests of one material (relaxation=a.csv creep=b.csv): estimates with "
      "intervals, raw record, fit and residuals, spectrum, mixing ratios, the pillar, cards and "
      "provenance.",
      "viscard report data/materials/pdms_1to10_seed.json --out report.html"};
  std::vector<std::string> targets, units;
  for (const CardTarget& target : card_targets()) targets.push_back(target.name);
  for (const UnitSystem& system : unit_systems()) units.emplace_back(system.name);
  syntax.positional.add("files", &words.files, "captures, tables, materials");
  OptionList& options = syntax.options;
  options.add("out", &words.out, "the page");
  options.add("title", &words.title, "heading of the page");
  options.add(
      "logo", &words.logo,
      "picture above the heading, PNG, JPEG or SVG (a file of options, @FILE, keeps it for all "
      "pages)");
  options.add("truth", &words.truth,
              "truth of an emulated specimen; once for each capture, in their order. Default: the "
              "file that capture --emulate wrote beside the capture");
  options
      .add("card", &words.cards,
           "target of a card to show (repeatable; default: abaqus, ansys, febio, json)")
      .such_as(targets);
  options.add("units", &words.units, "unit system of the cards").such_as(units);
  options.add("pictures", &words.pictures, "folder to write every picture into, as SVG");
  options.add("reproducible", &words.is_reproducible,
              "omit the date, so that the same input gives the same bytes");
  options.add("unverified", &words.unverified, kUnverifiedHelp);
  options.add("force", &words.overwrite, "overwrite existing files");
  syntax.may_exist = {"pictures"};
  return syntax;
}

ReportRequest checked_words(const ReportWords& asked, const Words& words) {
  ReportRequest report{asked.files, {},          {},
                       asked.truth, asked.cards, asked.units,
                       "",          "",          quoted_command_line("report", words)};
  try {
    sort_inputs(report);
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
  if (!asked.out) {
    throw UsageError("no page given; name it with --out report.html");
  }
  if (report.card_targets.empty()) report.card_targets = {"abaqus", "ansys", "febio", "json"};
  try {
    for (const std::string& target : report.card_targets) card_target(target);
    unit_system(report.card_units);
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
  report.plausible = asked.plausible;
  report.logo = asked.logo.value_or("");
  report.accepts_unverified = asked.unverified;
  if (!asked.is_reproducible) report.created_at = now_iso8601();
  return report;
}

void show_specimen(ResultVisitor& v, const SpecimenReport& specimen) {
  v.when(specimen.material.has_value(), [&] {
    v("E0_Pa", specimen.material.value_or(Material{}).E0_Pa, "instantaneous modulus");
  });
  v.list("files", "raw data", specimen.files, [&](const RawFile& file) {
    v("path", file.path, "its path");
    v("sha256", file.sha256, "its sum");
  });
  v("has_fit", specimen.fit.has_value(), "whether it was fitted");
  v("id", specimen.specimen.id, "of the specimen");
  v("notes", specimen.notes, "what to keep in mind");
  v.when(specimen.pillar.has_value(), [&] {
    const PillarCheck pillar = specimen.pillar.value_or(PillarCheck{});
    v.object("pillar", "largest relative error of the pillar", [&] {
      v("creep", pillar.creep.largest_relative_error, "in creep");
      v("relaxation", pillar.relaxation.largest_relative_error, "in relaxation");
    });
  });
}

// What the command prints.
struct WrittenReport {
  std::string page;
  std::vector<SpecimenReport> specimens;
  std::size_t n_figures = 0;
  std::vector<std::string> pictures, defects, disagreements;
};

void show_keys(ResultVisitor& v, const WrittenReport& written) {
  v("defects", written.defects, "results that are not to be trusted");
  v("disagreements", written.disagreements, "where linear and large-strain tests disagree");
  v("figures", written.n_figures, "pictures on the page");
  v("pictures", written.pictures, "pictures that were written, with --pictures");
  v("report", written.page, "the page");
  v.list("specimens", "what the page shows", written.specimens,
         [&](const SpecimenReport& specimen) { show_specimen(v, specimen); });
}

}  // namespace

int run_report(const Words& words, Streams& streams) {
  ReportWords asked;
  CommandSyntax syntax = report_syntax(asked);
  syntax.results = {described<WrittenReport>("report", "viscard report")};
  if (!parse_words(syntax, words, streams)) return kDone;
  asked.plausible = given_plausible(syntax);
  const ReportRequest report = checked_words(asked, words);
  const fs::path page = *asked.out;
  const bool is_forced = asked.overwrite;
  refuse_existing(page, is_forced);

  Progress progress(streams, "report");
  const WordsOnSignal words_on_signal("the report was stopped; nothing is written");
  const ReportInput input =
      read_report(report, asked.title,
                  [&](double fraction, const std::string& what) { progress.show(fraction, what); });
  const RenderedReport rendered = render_report(input);
  std::vector<std::string> pictures;
  if (asked.pictures) {
    pictures = write_report_pictures(rendered, *asked.pictures, is_forced);
  }
  write_file(page, written_text(rendered.html), is_forced);
  const std::vector<std::string> defects = defects_of(input);
  const std::vector<std::string> disagreements = rubber_disagreements(input);
  const WrittenReport written{page.string(), input.specimens, rendered.pictures.size(),
                              pictures,      defects,         disagreements};
  const auto show = [&](ResultVisitor& v) { show_keys(v, written); };
  if (!print_result(syntax, {"viscard-report/1", given_words(syntax, {"files", "truth"})}, show,
                    streams)) {
    streams.out << fmt::format(
        "{}: {}, {}, {} kB\n", page.string(), counted(input.specimens.size(), "specimen"),
        counted(rendered.pictures.size(), "figure"), rendered.html.size() / 1024);
    for (const std::string& line : disagreements) streams.out << "  " << line << "\n";
  }
  for (const std::string& defect : defects) streams.err << "viscard: " << defect << "\n";
  return defects.empty() ? kDone : kFailed;
}

}  // namespace viscard
