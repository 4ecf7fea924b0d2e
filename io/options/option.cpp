#include "io/options/option.h"

#include "io/basics/option_quantity.h"
#include "io/basics/words.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace viscard {
namespace {

template <class... Cases>
struct Overload : Cases... {
  using Cases::operator()...;
};
template <class... Cases>
Overload(Cases...) -> Overload<Cases...>;

[[noreturn]] void refuse_value(const Option& option, const std::string& value) {
  throw OptionError("--" + option.name + " cannot be '" + value + "'; expected " +
                    expected_of(option));
}

int whole_from(const Option& option, const std::string& text) {
  const auto number = integer_from_text(text);
  constexpr long long kLeast = std::numeric_limits<int>::min(),
                      kMost = std::numeric_limits<int>::max();
  if (!number || *number < kLeast || *number > kMost) refuse_value(option, text);
  return static_cast<int>(*number);
}

std::size_t count_from(const Option& option, const std::string& text) {
  const auto number = integer_from_text(text);
  if (!number || *number < 0) refuse_value(option, text);
  return static_cast<std::size_t>(*number);
}

double number_from(const Option& option, const std::string& text, Plausible judged) {
  if (!option.unit.empty()) {
    try {
      const QuantityOrUnit what = option.quantity != nullptr
                                      ? QuantityOrUnit(*option.quantity)
                                      : QuantityOrUnit::any(option.unit.c_str());
      return option_quantity("--" + option.name, text, what, judged);
    } catch (const std::invalid_argument& error) {
      throw OptionError(error.what());
    }
  }
  const auto number = number_from_text(text);
  if (!number || !std::isfinite(*number)) refuse_value(option, text);
  return *number;
}

// What a target holds that is not optional is its default.
std::string initial_of(const OptionTarget& target) {
  return std::visit(Overload{[](const int* value) { return std::to_string(*value); },
                             [](const std::size_t* value) { return std::to_string(*value); },
                             [](const double* value) { return text_of(*value); },
                             [](const std::string* value) { return *value; },
                             [](const auto*) { return std::string(); }},
                    target);
}

void check_choice(const Option& option, const std::string& value) {
  const auto& known = option.choices;
  if (known.empty() || option.has_other_choices) return;
  if (std::find(known.begin(), known.end(), value) != known.end()) return;
  std::string list = known.front();
  for (std::size_t i = 1; i < known.size(); ++i) {
    list += (i + 1 < known.size() ? ", " : " or ") + known[i];
  }
  throw OptionError("--" + option.name + " " + value + " is not known" +
                    did_you_mean(value, known, ";") +
                    (nearest_word(value, known).empty() ? " use " : " Use ") + list);
}

}  // namespace

Option& Option::shown_as(std::string text) {
  value = std::move(text);
  return *this;
}

Option& Option::of(const QuantityOrUnit& what_it_is) {
  unit = what_it_is.si;
  quantity = what_it_is.quantity;
  return *this;
}

Option& Option::among(std::vector<std::string> values) {
  choices = std::move(values);
  return *this;
}

Option& Option::such_as(std::vector<std::string> values) {
  has_other_choices = true;
  return among(std::move(values));
}

Option& Option::by_default(std::string text) {
  initial = std::move(text);
  return *this;
}

Option& Option::read_from_file() {
  is_file = true;
  return *this;
}

Option& Option::only_typed() {
  is_keyword = false;
  return *this;
}

Option& Option::only_with(std::vector<std::string> names) {
  only_beside = std::move(names);
  return *this;
}

bool is_switch(const Option& option) {
  return std::holds_alternative<bool*>(option.target);
}

bool is_list(const Option& option) {
  return std::holds_alternative<std::vector<std::string>*>(option.target) ||
         std::holds_alternative<std::vector<double>*>(option.target);
}

std::string type_of(const Option& option) {
  if (!option.unit.empty()) return "quantity";
  if (option.is_file) return "file";
  return std::visit(
      Overload{[](bool*) { return "flag"; }, [](int*) { return "whole number"; },
               [](std::optional<int>*) { return "whole number"; },
               [](std::size_t*) { return "whole number"; },
               [](std::optional<std::size_t>*) { return "whole number"; },
               [](double*) { return "number"; }, [](std::optional<double>*) { return "number"; },
               [](std::vector<double>*) { return "number"; }, [](std::string*) { return "text"; },
               [](std::optional<std::string>*) { return "text"; },
               [](std::vector<std::string>*) { return "text"; }},
      option.target);
}

std::string expected_of(const Option& option) {
  const bool counts = std::holds_alternative<std::size_t*>(option.target) ||
                      std::holds_alternative<std::optional<std::size_t>*>(option.target);
  if (counts) return "a whole number from 0 on, such as 5";
  const std::string type = type_of(option);
  if (type == "whole number") return "a whole number, such as 5";
  if (type == "number") return "a number without unit, such as 0.5";
  return type == "quantity" ? "a quantity in " + option.unit + " or with its unit" : "a text";
}

void set_option(const Option& option, const std::vector<std::string>& values, Plausible judged) {
  if (auto* const* flag = std::get_if<bool*>(&option.target)) {
    **flag = true;
    return;
  }
  for (const std::string& value : values) {
    if (value.empty()) {
      throw OptionError("--" + option.name +
                        " is empty, as by a variable that is not set; give it a value, or omit it");
    }
    check_choice(option, value);
  }
  if (auto* const* texts = std::get_if<std::vector<std::string>*>(&option.target)) {
    **texts = values;
    return;
  }
  if (auto* const* numbers = std::get_if<std::vector<double>*>(&option.target)) {
    (*numbers)->clear();
    for (const std::string& value : values)
      (*numbers)->push_back(number_from(option, value, judged));
    return;
  }
  const std::string& text = values.back();
  std::visit(
      Overload{[&](int* target) { *target = whole_from(option, text); },
               [&](std::optional<int>* target) { *target = whole_from(option, text); },
               [&](std::size_t* target) { *target = count_from(option, text); },
               [&](std::optional<std::size_t>* target) { *target = count_from(option, text); },
               [&](double* target) { *target = number_from(option, text, judged); },
               [&](std::optional<double>* target) { *target = number_from(option, text, judged); },
               [&](std::string* target) { *target = text; },
               [&](std::optional<std::string>* target) { *target = text; }, [](auto*) {}},
      option.target);
}

Option& OptionList::add(std::string name, OptionTarget target, std::string what) {
  Option& option = options_.emplace_back();
  option.name = std::move(name);
  option.target = target;
  option.what = std::move(what);
  option.group = heading_;
  option.initial = initial_of(target);
  return option;
}

void OptionList::add_all(const OptionList& others) {
  options_.insert(options_.end(), others.options_.begin(), others.options_.end());
}

const Option* OptionList::find(const std::string& name) const {
  const auto found = std::find_if(options_.begin(), options_.end(),
                                  [&](const Option& one) { return one.name == name; });
  return found == options_.end() ? nullptr : &*found;
}

bool is_set(const Option& option) {
  return std::visit(
      Overload{
          [](bool* target) { return *target; },
          [](std::string* target) { return !target->empty(); }, [](int*) { return false; },
          [](double*) { return false; }, [](std::size_t*) { return false; },
          [](const auto* target) { return *target != std::remove_cvref_t<decltype(*target)>(); }},
      option.target);
}

void refuse_without_effect(const OptionList& options,
                           const std::function<bool(const std::string&)>& given) {
  for (const Option& option : options.all()) {
    if (option.only_beside.empty() || !given(option.name)) continue;
    if (std::any_of(option.only_beside.begin(), option.only_beside.end(), given)) continue;
    std::string others;
    for (const std::string& name : option.only_beside)
      others += (others.empty() ? "--" : " or --") + name;
    throw OptionError("--" + option.name + " has no effect without " + others + "; add " +
                      (option.only_beside.size() > 1 ? "one of them" : "it") + ", or omit --" +
                      option.name);
  }
}

}  // namespace viscard
