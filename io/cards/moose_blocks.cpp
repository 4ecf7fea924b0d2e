#include "io/cards/moose_blocks.h"

#include "io/basics/patterns.h"
#include "io/cards/card_lines.h"

#include <algorithm>
#include <stdexcept>

namespace viscard {
namespace {

using Words = std::vector<std::string>;

bool is_in(const std::string& word, const Words& words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

const Words kTypes{"GeneralizedMaxwellModel",
                   "LinearViscoelasticStressUpdate",
                   "ComputeMultipleInelasticStress",
                   "ComputeIncrementalSmallStrain",
                   "ComputeIncrementalStrain",
                   "ComputeFiniteStrain",
                   "GenericConstantMaterial",
                   "LinearViscoelasticityManager",
                   "ComputeIsotropicElasticityTensor",
                   "ComputeLinearElasticStress",
                   "ComputeSmallStrain",
                   "ComputeNeoHookeanStress",
                   "ComputeLagrangianStrain"};
// "block" names the part of the mesh.
const Words kParameters{"type",
                        "young_modulus",
                        "youngs_modulus",
                        "poisson_ratio",
                        "poissons_ratio",
                        "creep_modulus",
                        "creep_viscosity",
                        "creep_ratio",
                        "integration_rule",
                        "inelastic_models",
                        "displacements",
                        "prop_names",
                        "prop_values",
                        "viscoelastic_model",
                        "lambda",
                        "mu",
                        "large_kinematics",
                        "block"};

struct MooseBlock {
  std::string name;
  int line = 0;
  Words parameters;
  std::string type;
  bool has_blocks = false;
};

class MooseBlocks {
 public:
  explicit MooseBlocks(const std::string& text) : text_(text) {
    for (const CardLine& line : card_lines(text, "\n")) {
      for (const Match& match : all_matches(
               line.text, "\\[([^\\]]*)\\]|(\\w+)\\s*=\\s*('[^']*'|\"[^\"]*\"|[^\\s\\[]+)")) {
        if (match.group[0][0] != '[') {
          add_parameter(match.group[2], match.group[3], line);
        } else if (match.group[1].empty() || match.group[1] == "../") {
          close(line);
        } else {
          if (!open_.empty()) open_.back().has_blocks = true;
          const std::string& name = match.group[1];
          open_.push_back(
              {name.rfind("./", 0) == 0 ? name.substr(2) : name, line.number, {}, "", false});
        }
      }
    }
    if (!open_.empty()) throw std::runtime_error("a [block] of the card is not closed by []");
    if (!has_materials_) add("missing-block", "the card has no block [Materials]", true);
  }
  std::vector<CardFinding> findings;

 private:
  void add(const char* name, const std::string& text, bool is_mistake) {
    findings.push_back({name, text, is_mistake});
  }
  bool is_inside() const {
    return open_.size() > 1 &&
           (open_.front().name == "Materials" || open_.front().name == "UserObjects");
  }
  void add_parameter(const std::string& name, const std::string& value, const CardLine& line) {
    if (open_.empty()) return add_unread_parts({at_line(line, "'" + name + "'")}, findings);
    if (!is_inside()) return;
    MooseBlock& block = open_.back();
    if (is_in(name, block.parameters))
      add("doubled-parameter",
          at_line(line, name + " stands in [" + block.name + "] twice; delete one of them"), true);
    block.parameters.push_back(name);
    if (name == "type") block.type = value;
    if (!is_in(name, kParameters)) add_unread_parts({at_line(line, "'" + name + "'")}, findings);
  }
  void close(const CardLine& line) {
    if (open_.empty()) throw std::runtime_error(at_line(line, "closes a block that is not open"));
    const MooseBlock block = open_.back();
    const bool is_inner = is_inside() && !block.has_blocks;
    open_.pop_back();
    if (block.name == "Materials" && open_.empty()) has_materials_ = true;
    if (!is_inner) return;
    const CardLine place{block.line, ""};
    if (block.type.empty()) {
      add("missing-type", at_line(place, "[" + block.name + "] has no type"), true);
    } else if (!is_in(block.type, kTypes)) {
      add_unread_parts({at_line(place, "[" + block.name + "] of the type " + block.type)},
                       findings);
    }
    if (block.type.ends_with("Strain") && !is_in("displacements", block.parameters) &&
        text_.find("[GlobalParams]") == std::string::npos)
      add("missing-displacements",
          at_line(place, "[" + block.name + "] and [GlobalParams] name no displacements"), true);
  }

  const std::string& text_;
  std::vector<MooseBlock> open_;
  bool has_materials_ = false;
};

}  // namespace

std::vector<CardFinding> moose_block_findings(const std::string& text) {
  return MooseBlocks(text).findings;
}

}  // namespace viscard
