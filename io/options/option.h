#pragma once

#include "models/quantities/plausible.h"

#include <cstddef>
#include <deque>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

namespace viscard {

// The value of an option is not allowed, or options exclude each other. The message names the option as
// the command line does, --max-terms; the Python module writes the same words with its own name, max_terms.
class OptionError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Where the value of an option goes. The type says what may be written: a switch has no value, a list
// may be given several times. A target keeps its value if the option is not given.
using OptionTarget =
    std::variant<bool*, int*, std::optional<int>*, std::size_t*, std::optional<std::size_t>*,
                 double*, std::optional<double>*, std::vector<double>*, std::string*,
                 std::optional<std::string>*, std::vector<std::string>*>;

// One option of a command. Command line, help, completion, manual page, keywords of Python and their
// stubs are made from it.
struct Option {
  std::string name;     // "punch-diameter"
  OptionTarget target;  // outlives the option
  std::string what;     // for a person: a sentence or two
  std::string value;    // what stands for the value in the help: "FILE"
  // Of a quantity, which may be written with another unit ("0.1 mm"): its SI unit; empty: no quantity.
  std::string unit;
  const Quantity* quantity = nullptr;  // its plausible range; null: any number
  std::string initial;                 // the default as text; empty: none
  std::vector<std::string> choices;    // the values that are allowed; empty: any
  bool is_file = false;                // the value names a file to read
  bool has_other_choices = false;      // the choices are examples
  std::string group;                   // heading above it in the help
  bool is_keyword = true;              // of Python as well, and not of the command line alone
  // It has an effect only beside one of these, "rig"; empty: always.
  std::vector<std::string> only_beside;

  // Each returns the option itself, so that they can be chained.
  // "FILE" in the place of "arg".
  Option& shown_as(std::string text);
  // A quantity, with its unit and range.
  Option& of(const QuantityOrUnit& what_it_is);
  // Other values are refused.
  Option& among(std::vector<std::string> values);
  Option& such_as(std::vector<std::string> values);  // examples
  // Shown as its default.
  Option& by_default(std::string text);
  // The value names a file to read.
  Option& read_from_file();
  Option& only_typed();  // no keyword
  // Refused without one of these options.
  Option& only_with(std::vector<std::string> names);
};

// True if it takes no value.
bool is_switch(const Option& option);
// True if it may be given several times.
bool is_list(const Option& option);

// True if its target has a value, of those that are empty, false or have none without one.
bool is_set(const Option& option);

// What a value must be: "a whole number, such as 5".
std::string expected_of(const Option& option);

// Type of the value: "flag", "text", "file", "whole number", "number", "quantity".
std::string type_of(const Option& option);

// Sets the target from values as typed; a switch takes none. Throws OptionError naming option, value and
// what is expected.
void set_option(const Option& option, const std::vector<std::string>& values,
                Plausible judged = Plausible::kMeasured);

// The options of one command, in the order of the help.
class OptionList {
 public:
  // Those added from here on stand under this heading.
  void group(std::string heading) { heading_ = std::move(heading); }
  // The reference is valid as long as the list.
  Option& add(std::string name, OptionTarget target, std::string what);
  // Appends those of another list.
  void add_all(const OptionList& others);

  const std::deque<Option>& all() const { return options_; }
  bool empty() const { return options_.empty(); }
  // The option of that name; nullptr: none.
  const Option* find(const std::string& name) const;

 private:
  std::string heading_;
  std::deque<Option> options_;
};

// An option that has no effect is refused: given(name) is true for an option with a value. Throws OptionError.
void refuse_without_effect(const OptionList& options,
                           const std::function<bool(const std::string&)>& given);

}  // namespace viscard
