#include "io/flow/optimise/design_space.h"

#include "io/config/toml_text.h"
#include "io/scenes/scene_file.h"
#include "models/maths/text_of_number.h"

#include <toml++/toml.h>

#include <charconv>
#include <cmath>
#include <stdexcept>

namespace viscard {
namespace {

constexpr int kDigits = 9;

// "40 um" as number and unit.
std::pair<double, std::string> number_and_unit(const std::string& text) {
  const std::string_view all = trimmed(text);
  double number = 0.0;
  const auto [end, error] = std::from_chars(all.data(), all.data() + all.size(), number);
  if (error != std::errc() || !std::isfinite(number)) return {std::nan(""), ""};
  return {number,
          std::string(trimmed({end, static_cast<std::size_t>(all.data() + all.size() - end)}))};
}

}  // namespace

DesignSpace::DesignSpace(const DesignSpec& spec) : spec_(&spec) {
  const toml::table scene = parsed_toml(spec.scene_text, spec.scene_path.string());
  for (const DesignRange& range : spec.ranges) {
    const auto [from, unit] = number_and_unit(range.from);
    const auto [to, unit_of_to] = number_and_unit(range.to);
    const bool is_log = range.spacing == "log";
    const std::string where = spec.path.string() + ": the range of '" + range.key + "' ";
    if (!(from < to) || unit != unit_of_to || (is_log && !(from > 0.0))) {
      throw std::runtime_error(where +
                               "needs from < to with the same unit, such as from = \"20 um\", to = "
                               "\"80 um\"; spacing = \"log\" needs positive ends");
    }
    const auto node = scene.at_path(range.key);
    if (!node) {
      throw std::runtime_error(where + "has a key that " + spec.scene_path.string() +
                               " does not have");
    }
    const std::string words = node.value<std::string>().value_or("");
    const std::size_t at = words.find("+-");
    axes_.push_back(
        {range.key, unit, at == std::string::npos ? "" : " " + words.substr(at), from, to, is_log});
  }
}

double DesignSpace::value_at(std::size_t range, double share) const {
  const Axis& axis = axes_[range];
  return axis.is_log ? axis.from * std::pow(axis.to / axis.from, share)
                     : axis.from + share * (axis.to - axis.from);
}

StudyValues DesignSpace::values_at(const DesignPoint& point, int digits) const {
  StudyValues values;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const Axis& axis = axes_[i];
    values.emplace_back(axis.key, text_of(value_at(i, point[i]), digits) +
                                      (axis.unit.empty() ? "" : " " + axis.unit) +
                                      axis.uncertainty);
  }
  return values;
}

std::string DesignSpace::text_at(const DesignPoint& point, int digits) const {
  return scene_text_with(spec_->scene_text, spec_->scene_path, values_at(point, digits));
}

Scene DesignSpace::scene_at(const DesignPoint& point) const {
  return scene_from_toml(text_at(point, kDigits), spec_->scene_path).scene;
}

}  // namespace viscard
