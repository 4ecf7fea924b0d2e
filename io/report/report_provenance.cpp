#include "io/plots/plot_svg.h"
#include "io/report/report_numbers.h"
#include "io/report/report_sections.h"
#include "models/experiment/run_temperature.h"

#include <fmt/format.h>

#include <string_view>

namespace viscard {
namespace {

// Percent-encodes every byte except letters and digits, for a data: URL.
std::string percent_encoded(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const bool is_plain =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    is_plain ? out.push_back(c)
             : static_cast<void>(out += fmt::format("%{:02X}", static_cast<unsigned char>(c)));
  }
  return out;
}

std::string card_html(const ReportCard& card, const std::string& label) {
  if (!card.refusal.empty()) {
    return fmt::format("<p><b>{}</b> for {} was not written: {}</p>\n", escaped_markup(card.target),
                       escaped_markup(label), escaped_markup(card.refusal));
  }
  const std::string name = escaped_markup(card.file_name);
  return fmt::format(
      "<details>\n<summary><b>{0}</b> for {1}, units {2}: <code>{3}</code></summary>\n"
      "<p class=\"tools\"><a download=\"{3}\" href=\"data:text/plain;charset=utf-8,{4}\">Save as "
      "{3}</a></p>\n<pre tabindex=\"0\" aria-label=\"Card {3}\">{5}</pre>\n</details>\n",
      escaped_markup(card.target), escaped_markup(label), escaped_markup(card.units), name,
      percent_encoded(card.text), escaped_markup(card.text));
}

// A list of names and values; empty values are omitted.
class Facts {
 public:
  void add(const std::string& name, const std::string& value, const char* before = "",
           const char* after = "") {
    if (value.empty()) return;
    html_ += "<dt>" + escaped_markup(name) + "</dt><dd>" + before + escaped_markup(value) + after +
             "</dd>\n";
  }
  void add_quantity(const std::string& name, double value_SI, const std::string& base) {
    if (!(value_SI != 0.0)) return;
    const ShownUnit unit = shown_unit(base, {value_SI});
    add(name, readable_number(value_SI * unit.per_si, 6) + " " + unit.text);
  }
  void add_code(const std::string& name, const std::string& value) {
    add(name, value, "<code>", "</code>");
  }
  std::string html() const { return html_.empty() ? "" : "<dl>\n" + html_ + "</dl>\n"; }

 private:
  std::string html_;
};

void add_specimen_facts(Facts& facts, const Specimen& specimen) {
  facts.add("Material", specimen.material);
  const PunchContact& contact = specimen.contact;
  facts.add_quantity("Punch radius", contact.punch_radius_m, "m");
  if (contact.punch_radius_m > 0.0) {
    contact.layer_thickness_m > 0.0 ? facts.add_quantity("Layer thickness, bonded to a rigid base",
                                                         contact.layer_thickness_m, "m")
                                    : facts.add("Layer thickness", "taken as a half-space");
    facts.add("Poisson ratio", readable_number(contact.poisson_ratio, 6));
  }
  if (specimen.rho_kg_m3 > 0.0) {
    facts.add("Density", readable_number(specimen.rho_kg_m3, 6) + " kg/m³");
  }
}

std::string temperature_words(const CapturedRun& run) {
  const auto measured = run_temperature(run.temperatures);
  if (!measured) return readable_number(run.specimen.temperature_C, 4) + " °C (noted)";
  return fmt::format("{} °C, measured: {} to {} °C", readable_number(measured->mean_C, 4),
                     readable_number(measured->min_C, 4), readable_number(measured->max_C, 4));
}

void add_run_facts(Facts& facts, const CapturedRun& run) {
  const RigConfig& rig = run.rig;
  facts.add("Run", run.status + (run.started_at.empty() ? "" : ", begun " + run.started_at));
  facts.add("Temperature", temperature_words(run));
  facts.add("Rig", rig.name);
  facts.add("Devices",
            rig.stage.driver + " stage, " + rig.load_cell.driver + " load cell" +
                (rig.clock_speed != 1.0
                     ? ", emulated, clock " + readable_number(rig.clock_speed, 4) + " times"
                     : ""));
  const LoadCellCalibration& calibration = rig.calibration;
  std::string gain = readable_number(calibration.volts_per_newton, 6) + " V/N";
  if (calibration.volts_per_newton_u > 0.0) {
    gain += " ± " + readable_number(calibration.volts_per_newton_u, 2) + " (standard uncertainty)";
  }
  if (!calibration.id.empty()) gain += ", " + calibration.id;
  if (!calibration.date.empty()) gain += ", " + calibration.date;
  facts.add("Calibration", gain);
  if (calibration.largest_force_N > 0.0) {
    facts.add_quantity("Calibrated up to", calibration.largest_force_N, "N");
  }
  facts.add_quantity("Rated load of the cell", calibration.capacity_N, "N");
  if (rig.frame.stiffness_N_m > 0.0) {
    const ShownUnit unit = shown_unit("N/m", {rig.frame.stiffness_N_m});
    facts.add("Frame stiffness",
              fmt::format("{} {} ± {} %", readable_number(rig.frame.stiffness_N_m * unit.per_si, 6),
                          unit.text, readable_number(100.0 * rig.frame.stiffness_relative_u, 3)));
  }
  facts.add_quantity("Depth asked for", run.plan.depth_m, "m");
  facts.add(
      "Ramp, hold, recovery",
      fmt::format("{} s, {} s, {} s", readable_number(run.plan.ramp_s, 4),
                  readable_number(run.plan.hold_s, 4), readable_number(run.plan.recovery_s, 4)));
  facts.add("Captured by", run.program);
  facts.add_code("Capture command", run.command);
}

void add_material_facts(Facts& facts, const Material& material) {
  facts.add("Poisson ratio of the material",
            readable_number(material.nu, 6) + ", " + material.provenance.nu_origin);
  facts.add(
      "Fitted by",
      material.provenance.created_by +
          (material.provenance.created_at.empty() ? "" : ", " + material.provenance.created_at));
  facts.add_code("Fit command", material.provenance.command);
}

void add_files(HtmlTable& table, const SpecimenReport& specimen, const std::string& label) {
  std::vector<RawFile> files = specimen.files;
  if (specimen.material) {
    for (const RawFile& raw : specimen.material->provenance.raw_files) {
      bool is_listed = false;
      for (const RawFile& file : files) is_listed = is_listed || file.sha256 == raw.sha256;
      if (!is_listed) files.push_back(raw);
    }
  }
  bool is_first = true;
  for (const RawFile& file : files) {
    table.add_row(
        {is_first ? escaped_markup(label) : "", "<code>" + escaped_markup(file.path) + "</code>",
         "<code>" + escaped_markup(file.sha256) + "</code>"},
        is_first && !table.is_empty() ? HtmlTable::RowStyle::kBeginsGroup
                                      : HtmlTable::RowStyle::kPlain);
    is_first = false;
  }
}

}  // namespace

void add_cards(Page& page, const ReportInput& input,
               const std::vector<SpecimenEstimates>& estimates) {
  bool has_heading = false;
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    for (const ReportCard& card : input.specimens[i].cards) {
      if (!has_heading) page.add_heading(2, "cards", "Material cards");
      has_heading = true;
      page.add_html(card_html(card, estimates[i].label));
    }
  }
}

void add_provenance(Page& page, const ReportInput& input,
                    const std::vector<SpecimenEstimates>& estimates) {
  page.add_heading(2, "provenance", "Provenance");
  HtmlTable files({{"Specimen", false}, {"File", false}, {"SHA-256", false}});
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    add_files(files, input.specimens[i], estimates[i].label);
  }
  if (!files.is_empty()) page.add_table(files, "Files from which this page was made.");
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    const SpecimenReport& specimen = input.specimens[i];
    Facts facts;
    add_specimen_facts(facts, specimen.specimen);
    if (specimen.run) add_run_facts(facts, *specimen.run);
    if (specimen.material) add_material_facts(facts, *specimen.material);
    if (facts.html().empty()) continue;
    page.add_heading(3, "provenance-" + std::to_string(i + 1), estimates[i].label);
    page.add_html(facts.html());
  }
}

}  // namespace viscard
