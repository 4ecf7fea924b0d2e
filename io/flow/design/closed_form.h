#pragma once

#include "models/quantities/quantities.h"
#include "models/sensor/sensor_design.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace viscard {

class ResultVisitor;

// A pillar sensor whose limits are known in closed form (models/README.md, eqs. D1 to D6).
struct ClosedFormDesign {
  SensorGeometry geometry;
  SensorMaterial material;
  SensorRequirements requirements;
};

// A quantity of a design: a number in SI, or a text with its unit.
struct DesignOption {
  const char* name;  // "film-thickness"
  QuantityOrUnit unit;
  const char* what;  // in words
  double* value;     // in the design
};

// All quantities of `design`, which must outlive them.
std::vector<DesignOption> options_of(ClosedFormDesign& design);

// Refuses a value below 0, in SI, with its text as typed: "diameter is -1 um; it must be positive". An auxetic pillar has
// a negative Poisson ratio. Throws std::invalid_argument.
void refuse_negative(const std::string& name, double value, const std::string& typed);

// The design with the values (in SI) that `given` returns for the name and the unit of an option;
// if it returns nothing, the default is used. lattice: "square", "hexagonal" or "plain". Without
// work of adhesion, twice the surface energy is used (equal surfaces). Throws std::invalid_argument
// naming the value that is outside its range.
ClosedFormDesign closed_form_design(
    const std::function<std::optional<double>(const char* name, const QuantityOrUnit& unit)>& given,
    const std::optional<std::string>& lattice);

// The keys of `viscard design --json`, and its text with one line for each limit.
void show_keys(ResultVisitor& v, const ClosedFormDesign& design);
std::string text_from_design(const ClosedFormDesign& design);

}  // namespace viscard
