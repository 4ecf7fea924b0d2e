#pragma once

#include "fit/curves/master_model.h"
#include "fit/samples/fit_data.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace viscard {

// The rows of a master curve by temperature.
struct MasterSegments {
  std::vector<MasterSegment> segments;  // ascending temperature
  std::size_t n_left_out = 0;           // rows
  std::size_t n_of_isotherms = 0;       // those of isotherms that were left out
  std::vector<std::string> left_out;    // isotherms with the reason: "25 C (2 rows)"
};

// Number of isotherms: temperatures more than 1 K apart.
std::size_t n_isotherms(const std::vector<double>& temperature_C);

// "25 C"
std::string celsius(double temperature_C);

// Sorts the rows into segments. An isotherm of fewer than three rows is left out and named. Throws
// std::runtime_error for fewer than two segments and for moduli that are zero or of the wrong sign.
MasterSegments segments_of(const MasterData& data);

// Removes the segments from `first` to before `last`, and names them with the reason.
void leave_out(MasterSegments& all, std::size_t first, std::size_t last, const std::string& reason);

// The segment nearest to a temperature, within 1 K; none: nothing was measured there.
std::optional<std::size_t> segment_at(const std::vector<MasterSegment>& segments,
                                      double temperature_C);

// "0 C, 20 C"
std::string temperatures_of(const std::vector<MasterSegment>& segments);

// The segment at T_ref_C, or the middle one. Throws std::runtime_error if none is there.
std::size_t reference_of(const std::vector<MasterSegment>& segments,
                         const std::optional<double>& T_ref_C);

}  // namespace viscard
