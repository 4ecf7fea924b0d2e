#pragma once

#include <string>
#include <vector>

namespace viscard {

class ResultVisitor;

// A file that the header of a card states, and whether it is still the same.
struct ChainLink {
  std::string path;    // where it was found; else as stated
  std::string stated;  // SHA-256 in the header
  std::string now;     // of the file; empty if it is not there
  bool matches() const { return !now.empty() && now == stated; }
};

// From a card to the raw data behind it.
struct CardChain {
  std::string card_sha256;  // of the file
  std::string stated_sum,
      found_sum;       // in the header, and of the text (card_sum.h); stated "": none
  ChainLink material;  // stated is empty if the header states none
  std::vector<ChainLink> raw_files;
  bool is_card_unchanged() const { return !stated_sum.empty() && stated_sum == found_sum; }
  bool is_complete() const;  // card, material and at least one raw file, all unchanged
  // Missing parts of the chain, and what to do about them, one sentence each; empty if it is
  // complete.
  std::vector<std::string> missing() const;
  // Those of them that the stated sums contradict or leave open: a material that names no raw data is none.
  std::vector<std::string> broken() const;
};
void show_keys(ResultVisitor& v, const ChainLink& link);
void show_keys(ResultVisitor& v, const CardChain& chain);
void show_ends(ResultVisitor& v, const CardChain& chain);  // without the raw files

// Follows the sums in the header of a card, of Prony series or of rubber. Files are looked for as stated,
// then beside the material and the card. Without a material the file that the header names is looked for.
CardChain chain_of(const std::string& card_path, const std::string& card_text,
                   const std::string& material_path);

}  // namespace viscard
