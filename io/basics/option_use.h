#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace viscard {

// An option of a command, and whether it has an effect on what it was given for.
struct OptionUse {
  std::string option;  // "--depth"
  bool is_given = false, has_effect = false;
  std::string of;  // what it is for: "tables of force and depth"
};
using OptionUses = std::vector<OptionUse>;

// Why the first option that is given without an effect is refused, "--depth is for tables of force
// and depth; omit it"; empty: there is none.
std::string idle_option(const OptionUses& uses);

// Refuses such an option, because the user expects it to have an effect.
template <typename Error = std::runtime_error>
void refuse_idle(const OptionUses& uses) {
  if (const std::string why = idle_option(uses); !why.empty()) throw Error(why);
}

// Adds those of another file: an option has an effect if one of the files uses it.
void add_uses(const OptionUses& more, OptionUses& all);

}  // namespace viscard
