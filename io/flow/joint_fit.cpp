#include "io/basics/written_path.h"
#include "io/flow/fit_file.h"
#include "io/flow/input_files.h"
#include "io/materials/material_file.h"
#include "models/material/liquid.h"
#include "models/maths/text_of_number.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <stdexcept>

namespace viscard {
namespace {

// One file of the joint fit: a fitted capture or table, or a material file.
struct JointRecord {
  std::string file;
  std::optional<FittedFile> fitted;
  Material material;  // of a fitted file only at the end
  double ratio = 0.0;
  std::string specimen_id;
};

std::vector<JointRecord> read_records(const JointRequest& request) {
  std::vector<JointRecord> records;
  std::vector<std::string> measured;
  for (const std::string& file : request.files) {
    records.push_back({file, std::nullopt, {}, 0.0, ""});
    if (!is_material_file(file)) {
      measured.push_back(file);
      continue;
    }
    Material& material = records.back().material =
        read_material(file, request.fit.plausible).material;
    refuse_liquid(material, file);
    if (material.name.empty()) material.name = std::filesystem::path(file).stem().string();
  }
  FitRequest fit = request.fit;
  fit.needs_specimen = request.specimen_ids.empty();
  std::vector<FittedFile> fitted = fit_files(measured, fit, request.progress);
  auto next = fitted.begin();
  for (std::size_t i = 0; i < records.size(); ++i) {
    JointRecord& one = records[i];
    if (!is_material_file(one.file)) one.fitted = std::move(*next++);
    one.ratio = one.fitted ? one.fitted->specimen.mixing_ratio : one.material.mixing_ratio;
    one.specimen_id = one.fitted ? one.fitted->specimen_id : one.material.specimen_id;
    if (!request.ratios.empty()) one.ratio = request.ratios[i];
    if (!request.specimen_ids.empty()) one.specimen_id = request.specimen_ids[i];
  }
  return records;
}

// Repeats of one specimen must be marked as such: counted as specimens, they would make the
// intervals too narrow.
void check_specimens(const std::vector<JointRecord>& records) {
  std::map<std::string, const JointRecord*> first_of;
  const JointRecord* repeat = nullptr;
  for (const JointRecord& one : records) {
    if (one.specimen_id.empty()) continue;
    const auto [first, is_new] = first_of.emplace(one.specimen_id, &one);
    if (is_new) continue;
    repeat = &one;
    if (first->second->ratio == one.ratio) continue;
    throw std::runtime_error(fmt::format(
        "specimen '{}' has mixing ratio {} in {} and {} in {}, but a specimen has one ratio. Give "
        "each specimen an id of its own: id in specimen.toml, or --specimen-id once for each file",
        one.specimen_id, text_of(first->second->ratio), first->second->file, text_of(one.ratio),
        one.file));
  }
  if (repeat == nullptr) return;
  for (const JointRecord& one : records) {
    if (!one.specimen_id.empty()) continue;
    throw std::runtime_error(fmt::format(
        "{} does not state its specimen, but {} and {} are repeats on specimen '{}'. Give "
        "--specimen-id once for each file, in their order, or a column 'specimen' in the table",
        one.file, first_of[repeat->specimen_id]->file, repeat->file, repeat->specimen_id));
  }
}

// The law compares terms one by one, so all records (of a ratio, with terms of their own) need the
// same number: that of the material files, or the most frequent choice among the measured ones (the
// smallest of equals).
int common_order(const std::vector<JointRecord*>& records) {
  std::map<int, int> votes;
  for (const JointRecord* one : records) {
    if (!one->fitted) return static_cast<int>(one->material.terms.size());
    ++votes[static_cast<int>(one->fitted->result.terms.size())];
  }
  return std::max_element(votes.begin(), votes.end(),
                          [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

void refit_others(const std::vector<JointRecord*>& records, const JointRequest& request) {
  const int order = common_order(records);
  FitRequest forced = request.fit;
  forced.options.n_terms = order;
  for (JointRecord* one : records) {
    if (!one->fitted || static_cast<int>(one->fitted->result.terms.size()) == order) continue;
    if (request.note) {
      request.note(fmt::format("{}: fitted again with {}, as the other specimens{}, instead of {}",
                               one->file, counted(static_cast<std::size_t>(order), "term"),
                               request.options.own_terms ? " of its ratio" : "",
                               one->fitted->result.terms.size()));
    }
    one->fitted = fit_file(one->file, forced);
  }
}

// A record counts once, even if both a file and a material made from it are given.
void refuse_repeated_records(const std::vector<JointRecord>& records) {
  std::map<std::string, const JointRecord*> first_with;
  for (const JointRecord& one : records) {
    for (const RawFile& raw : one.material.provenance.raw_files) {
      if (raw.sha256.empty()) continue;
      const auto [first, is_new] = first_with.emplace(raw.sha256, &one);
      if (is_new || first->second == &one) continue;
      throw std::runtime_error(
          fmt::format("{} and {} come from the same record ({}); each record counts once. Remove "
                      "one of the two",
                      first->second->file, one.file, raw.path));
    }
  }
}

// What is known of how the records were made and read goes on into the joint fit and its cards.
void add_doubts(const std::vector<JointRecord>& records, RatioFit& fit) {
  std::vector<std::string> files;
  for (const JointRecord& one : records) files.push_back(one.file);
  const WrittenValues written(files, "");
  for (const JointRecord& one : records) {
    const auto add = [&](const std::string& flag, const std::string& text) {
      const MaterialFlag named{flag, 0, written(one.file) + ": " + text};
      fit.flags.push_back(named);
      fit.common.flags.push_back(named);
    };
    for (const MaterialFlag& flag : one.material.flags) {
      if (is_about_record(flag.name)) add(flag.name, flag.text);
    }
    if (!one.fitted) continue;
    for (const std::string& note : one.fitted->notes) add("as-read", note);
  }
}

}  // namespace

RatioFit fit_jointly(const JointRequest& asked) {
  JointRequest request = asked;
  refuse_repeated_files(request.files);
  request.fit.is_beside_others = true;
  std::vector<JointRecord> records = read_records(request);
  std::vector<const FittedFile*> measured;
  for (const JointRecord& one : records) {
    if (one.fitted) measured.push_back(&*one.fitted);
  }
  refuse_copies(measured);
  OptionUses uses;
  for (const FittedFile* one : measured) add_uses(one->uses, uses);
  refuse_idle(uses);
  check_specimens(records);
  std::map<double, std::vector<JointRecord*>> with_one_order;
  for (JointRecord& one : records) {
    with_one_order[request.options.own_terms ? one.ratio : 0.0].push_back(&one);
  }
  for (const auto& [ratio, members] : with_one_order) refit_others(members, request);
  std::vector<Material> materials;
  for (JointRecord& one : records) {
    if (one.fitted) one.material = material_from_fitted(*one.fitted, request.material);
    one.material.mixing_ratio = one.ratio;
    one.material.specimen_id = one.specimen_id;
    if (!request.specimen_ids.empty() && !one.specimen_id.empty()) {
      one.material.name = one.specimen_id;
    }
    materials.push_back(one.material);
  }
  refuse_repeated_records(records);
  RatioFit fit = fit_mixing_ratio(materials, request.options);
  add_doubts(records, fit);
  return fit;
}

}  // namespace viscard
