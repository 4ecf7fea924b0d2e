#include "io/basics/atomic_file.h"
#include "io/basics/json_string.h"
#include "io/basics/sha256.h"
#include "io/cards/proof/certificate.h"
#include "io/cli/card/card_words.h"
#include "io/cli/words/fitted_text.h"
#include "io/cli/words/json_output.h"
#include "models/maths/text_of_number.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <ostream>
#include <stdexcept>

namespace viscard {
namespace {

// What --verify found; of a card alone there is no certificate.
struct Verified {
  std::string card;
  CardChain chain;
  std::optional<bool> is_certificate_unchanged, is_card_of_certificate;

  std::vector<std::string> broken() const {
    std::vector<std::string> out;
    if (is_certificate_unchanged && !*is_certificate_unchanged)
      out.emplace_back("the certificate has been edited; prove the card again");
    if (is_card_of_certificate && !*is_card_of_certificate)
      out.push_back(card + " is not the card that the certificate is of; prove it again");
    const auto more = chain.broken();
    out.insert(out.end(), more.begin(), more.end());
    return out;
  }
};

void show_verified(ResultVisitor& v, const Verified& verified) {
  v("card", verified.card, "the card");
  v.or_null("certificate_unchanged", verified.is_certificate_unchanged,
            "whether the certificate has its own sum; null: a card was named");
  v.or_null("certificate_of_card", verified.is_card_of_certificate,
            "whether the card is the one that was proven; null: a card was named");
  show_keys(v, verified.chain);
  v("holds", verified.broken().empty(),
    "whether every stated sum from the certificate to the raw data matches");
  v("broken", verified.broken(), "what has changed or is not here, and what to do");
}

void print_verified(const Verified& verified, const CardWords& words, std::ostream& out) {
  const bool holds = verified.broken().empty();
  out << words.verify << ": " << (holds ? "every stated sum matches" : "not verified") << "\n";
  if (verified.is_certificate_unchanged)
    out << (*verified.is_certificate_unchanged ? "  certificate: as it was written\n"
                                               : "  certificate: EDITED\n");
  const auto row = [&](const ChainLink& link, const char* what) {
    out << "  " << what << " " << link.path << ": "
        << (link.matches()     ? "as stated"
            : link.now.empty() ? "NOT HERE"
                               : "CHANGED")
        << "\n";
  };
  out << "  card " << verified.card << ": "
      << (verified.chain.is_card_unchanged()  ? "as it was written"
          : verified.chain.stated_sum.empty() ? "states no sum"
                                              : "EDITED")
      << "\n";
  if (!verified.chain.material.stated.empty()) row(verified.chain.material, "material");
  for (const ChainLink& link : verified.chain.raw_files) row(link, "raw data");
  for (const std::string& one : holds ? verified.chain.missing() : verified.broken()) {
    out << "  " << one << "\n";
  }
}

// The file as stated, or that of its name beside the certificate.
std::string card_beside(const std::string& stated, const std::string& certificate) {
  std::error_code ignored;
  if (std::filesystem::is_regular_file(stated, ignored)) return stated;
  return (std::filesystem::path(certificate).parent_path() /
          std::filesystem::path(stated).filename())
      .string();
}

Verified verified_by(const CardWords& words) {
  const std::string text = read_file(words.verify);
  const nlohmann::json json = json_or_discarded(text);
  Verified out{.card = words.verify};
  if (!json.is_object() && text.find("\"certificate_sha256\"") != std::string::npos) {
    throw std::runtime_error(
        words.verify +
        ": the certificate has been edited: it is no JSON any more; prove the card again");
  }
  std::string material = words.material, card = text;
  if (json.is_object() && json.contains("certificate_sha256")) {
    const auto text_at = [&](const nlohmann::json& object, const char* key) {
      return object.contains(key) && object[key].is_string() ? object[key].get<std::string>() : "";
    };
    out.is_certificate_unchanged = is_certificate_unchanged(text);
    out.card = card_beside(text_at(json, "card"), words.verify);
    if (material.empty()) material = text_at(json, "compared_with");
    const std::string stated =
        json.contains("chain") ? text_at(json["chain"], "card_sha256") : std::string();
    card = read_file(out.card);
    out.is_card_of_certificate = sha256_of_text(card) == stated;
  }
  out.chain = chain_of(out.card, card, material);
  return out;
}

}  // namespace

std::string chain_in_words(const CardChain& chain) {
  if (chain.is_complete()) {
    return fmt::format(
        "  chain: card, material file and {} of raw data have the sums that the "
        "header states\n",
        counted(chain.raw_files.size(), "file"));
  }
  std::string missing;
  for (const std::string& one : chain.missing()) missing += (missing.empty() ? "" : "; ") + one;
  return "  chain: not complete: " + missing + "\n";
}

std::string rows_of(const std::vector<TermProof>& terms) {
  std::string out;
  for (std::size_t i = 0; i < terms.size(); ++i) {
    out += fmt::format(
        "  term {}: g = {:g}, tau = {:g} s: {}; a tau 10 % off changes an answer by {:.1e}\n",
        i + 1, terms[i].g, terms[i].tau_s, terms[i].is_exercised ? "exercised" : "NOT exercised",
        terms[i].change);
  }
  return out;
}

std::string rows_of(const std::vector<ConstantProof>& constants) {
  std::string out;
  for (const ConstantProof& constant : constants) {
    out += fmt::format("  {} = {:.6g}: ", constant.name, constant.value);
    if (constant.seen_by == "read back") {
      out += "as in the material (no static test shows it)\n";
    } else if (constant.name == "rho_kg_m3") {
      out += "NOT that of the material\n";
    } else {
      out += fmt::format(
          "{}; 10 % off changes an answer by {:.1e}\n",
          constant.is_exercised ? "seen by " + constant.seen_by : std::string("NOT exercised"),
          constant.change);
    }
  }
  return out;
}

int finish_proof(const CardWords& words, const std::string& path, const char* schema, bool holds,
                 const std::function<void(ResultVisitor&)>& show,
                 const std::function<void(std::ostream&)>& print, Streams& streams) {
  if (!words.json) {
    FittedText text(streams);
    print(text);
  }
  write_file(path, certificate_text(show), words.force);
  if (words.json) {
    Words inputs{words.prove};
    if (!words.material.empty()) inputs.push_back(words.material);
    print_result({schema, inputs}, show, streams);
  } else {
    streams.out << "wrote " << path << "\n";
  }
  return holds ? kDone : kFailed;
}

DescribedResult result_of_verify() {
  return {"card-verify", "viscard card --verify", {[](ResultVisitor& v) {
            show_verified(v, Verified{});
          }}};
}

int verify_file(const CardWords& words, Streams& streams) {
  const Verified verified = verified_by(words);
  const bool holds = verified.broken().empty();
  if (words.json) {
    print_result(
        {"viscard-card-verify/1", {words.verify}},
        [&](ResultVisitor& v) { show_verified(v, verified); }, streams);
    return holds ? kDone : kFailed;
  }
  print_verified(verified, words, FittedText(streams));
  return holds ? kDone : kFailed;
}

}  // namespace viscard
