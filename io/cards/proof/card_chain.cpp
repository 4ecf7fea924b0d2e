#include "io/cards/proof/card_chain.h"

#include "io/basics/atomic_file.h"
#include "io/basics/written_path.h"
#include "io/cards/card_sum.h"
#include "io/cards/header_name.h"
#include "models/maths/result_visitor.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <sstream>

namespace viscard {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSum = "sha256 ";
constexpr std::size_t kSumLength = 7, kDigits = 64;

// The file as stated, or the file of that name beside one of the others.
void look_for(const std::vector<std::string>& others, ChainLink& link) {
  std::vector<fs::path> places{link.path};
  for (const std::string& other : others) {
    if (other.empty()) continue;
    const fs::path folder = fs::path(other).parent_path();
    places.push_back(folder / fs::path(link.path));
    places.push_back(folder / fs::path(link.path).filename());
  }
  std::error_code ignored;
  const auto found = std::find_if(places.begin(), places.end(), [&](const fs::path& place) {
    return !place.empty() && fs::is_regular_file(place, ignored);
  });
  if (found == places.end()) return;
  link.path = found->string();
  link.now = sha256_of_file(*found);
}

// "** raw data a.csv sha256 ...": the file between the mark, which begins the line, and the sum, or nothing.
std::optional<ChainLink> link_in(const std::string& line, const std::string& mark) {
  const std::size_t begin = behind_mark(line, mark), sum = line.rfind(kSum);
  if (begin == std::string::npos || sum == std::string::npos || sum < begin) return std::nullopt;
  std::string path = line.substr(begin, sum - begin);
  while (!path.empty() && path.back() == ' ') path.pop_back();
  return ChainLink{name_from_header(path), line.substr(sum + kSumLength, kDigits), ""};
}

}  // namespace

bool CardChain::is_complete() const {
  return is_card_unchanged() && material.matches() && !raw_files.empty() &&
         std::all_of(raw_files.begin(), raw_files.end(),
                     [](const ChainLink& link) { return link.matches(); });
}

std::vector<std::string> CardChain::broken() const {
  if (material.stated.empty()) {
    return {
        "the card's header states no sums; write the card with viscard card MATERIAL.json --for "
        "TARGET --out FILE"};
  }
  std::vector<std::string> out;
  if (stated_sum.empty()) {
    out.emplace_back("the header states no sum of the card itself; write the card again");
  } else if (!is_card_unchanged()) {
    out.emplace_back("the card has been edited since viscard wrote it; write it again");
  }
  if (material.path.empty()) {
    out.emplace_back(
        "no material file was named; repeat with viscard card MATERIAL.json --prove CARD");
  } else if (material.now.empty()) {
    out.push_back(material.path +
                  ", the material file, is not here; put it beside the card, or name it");
  } else if (!material.matches()) {
    out.push_back(material.path + " has changed since the card was written; write the card again");
  }
  for (const ChainLink& link : raw_files) {
    if (link.matches()) continue;
    out.push_back(link.path + (link.now.empty()
                                   ? " is not here; put it beside the material file"
                                   : " has changed since the card was written; fit it again"));
  }
  return out;
}

std::vector<std::string> CardChain::missing() const {
  std::vector<std::string> out = broken();
  if (!material.stated.empty() && raw_files.empty()) {
    out.emplace_back(
        "the material names no raw data: it was typed in or fitted without them; viscard fit "
        "writes a material file that names them");
  }
  return out;
}

void show_keys(ResultVisitor& v, const ChainLink& link) {
  v("path", written_path(link.path), "the file");
  v("sha256_in_card", link.stated, "its sum as stated");
  v.or_null("sha256_now", link.now.empty() ? std::nullopt : std::optional(link.now),
            "its sum now; null: not here");
  v("matches", link.matches(), "whether both agree");
}

void show_ends(ResultVisitor& v, const CardChain& chain) {
  v("card_sha256", chain.card_sha256, "sum of the card");
  v("card_unchanged", chain.is_card_unchanged(),
    "whether the card has the sum that its header states");
  v.object(
      "material", "the material file", [&] { show_keys(v, chain.material); },
      chain.material.stated.empty());
  v("complete", chain.is_complete(), "whether all sums match");
  v("missing", chain.missing(), "what is missing or has changed, and what to do");
}

void show_keys(ResultVisitor& v, const CardChain& chain) {
  show_ends(v, chain);
  v.list("raw_files", "the raw data", chain.raw_files,
         [&](const ChainLink& link) { show_keys(v, link); });
}

CardChain chain_of(const std::string& card_path, const std::string& card_text,
                   const std::string& material_path) {
  CardChain chain{.card_sha256 = card_path.empty() ? "" : sha256_as_read(card_path),
                  .stated_sum = stated_card_sum(card_text),
                  .found_sum = card_sum(card_text)};
  std::istringstream lines(card_text);
  for (std::string line; std::getline(lines, line);) {
    if (const auto link = link_in(line, "material file ")) chain.material = *link;
    if (const auto link = link_in(line, "raw data ")) chain.raw_files.push_back(*link);
  }
  if (!material_path.empty()) chain.material.path = material_path;
  if (!chain.material.path.empty()) look_for({card_path}, chain.material);
  for (ChainLink& link : chain.raw_files) look_for({chain.material.path, card_path}, link);
  return chain;
}

}  // namespace viscard
