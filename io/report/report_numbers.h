#pragma once

#include "models/material/material.h"

#include <string>
#include <vector>

namespace viscard {

// A unit a person would choose: a value in SI times per_si is the number shown with `text` behind
// it.
struct ShownUnit {
  double per_si = 1.0;
  std::string text;
};

// The prefix that brings the largest finite magnitude among the values to 1 ... 999; base "Pa",
// "N", "N/m", "V", "m", "s" or "1/Pa" ("1/MPa" ...). Anything else is shown as it is.
ShownUnit shown_unit(const std::string& base, const std::vector<double>& values_SI);

// The value with as many decimals as its 95 % interval deserves (two digits of its half-width), or
// four significant digits without one. "–" if it is not finite.
std::string number_text(double value, const Interval* interval = nullptr);

// "[1.874, 1.890]", with as many decimals; an end that is not finite is called unbounded.
std::string interval_text(const Interval& interval);

// The number as HTML that carries the full value in SI for whoever reads the page by program:
// <data value="1880123.4">1.880</data>. "–" if it is not finite.
std::string number_html(double value_SI, double per_si, const Interval* interval_SI = nullptr);

// The interval likewise, in the colour of a side note; "" if both ends are missing or zero.
std::string interval_html(const Interval& interval_SI, double per_si);

// Every value times the factor.
std::vector<double> scaled(const std::vector<double>& values, double factor);

}  // namespace viscard
