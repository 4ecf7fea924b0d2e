#pragma once

#include "models/material/material.h"

#include <string>
#include <vector>

namespace viscard {

// A unit with a suitable prefix: a value in SI times per_si is the number shown before `text`.
struct ShownUnit {
  double per_si = 1.0;
  std::string text;
};

// Chooses the prefix that brings the largest finite magnitude of the values into 1 ... 999. base is
// "Pa", "N", "N/m", "V", "m", "s" or "1/Pa" ("1/MPa" ...); any other unit gets no prefix.
ShownUnit shown_unit(const std::string& base, const std::vector<double>& values_SI);

// Writes the value with two digits of the half-width of its 95 % interval, or with four significant
// digits if there is no interval. "–" if the value is not finite.
std::string number_text(double value, const Interval* interval = nullptr);

// Writes a number for readers of the page, with at most `digits` significant digits and a minus
// sign instead of a hyphen: "0.002", "1500", "3×10⁻⁷"; "–" if it is not finite. Messages use
// text_of() (models/maths/text_of_number.h), whose text programs can read.
std::string readable_number(double value, int digits);

// "[1.874, 1.890]" with the decimals that number_text() chooses; an infinite end is "unbounded".
std::string interval_text(const Interval& interval);

// The number as HTML, with the full value in SI for programs that read the page:
// <data value="1880123.4">1.880</data>. "–" if it is not finite.
std::string number_html(double value_SI, double per_si, const Interval* interval_SI = nullptr);

// The interval as HTML in the colour of a side note; "" if both ends are infinite or both are zero.
std::string interval_html(const Interval& interval_SI, double per_si);

// Multiplies every value by the factor.
std::vector<double> scaled(const std::vector<double>& values, double factor);

}  // namespace viscard
