#pragma once

#include "fit/intervals/fit_result.h"

#include <cstddef>
#include <string>

namespace viscard {

// Why rows of the input are not fitted: the keys of the JSON object `left_out`.
namespace left_out {
inline constexpr const char* kNotANumber = "not_a_number";
inline constexpr const char* kIsotherm = "isotherm";
inline constexpr const char* kSpike = "spike";
inline constexpr const char* kDepthSpike = "depth_spike";
inline constexpr const char* kStamp = "stamp";
inline constexpr const char* kDropout = "dropout";
inline constexpr const char* kStuck = "stuck";
inline constexpr const char* kBeforeLoad = "before_load";
inline constexpr const char* kSaturated = "saturated";
inline constexpr const char* kGlitch = "glitch";
inline constexpr const char* kBeforeZero = "before_zero";
inline constexpr const char* kEarlierTouch = "earlier_touch";
inline constexpr const char* kUnloading = "unloading";
inline constexpr const char* kContactLost = "contact_lost";
inline constexpr const char* kLifted = "lifted_off";
inline constexpr const char* kAdhesion = "adhesion";
inline constexpr const char* kBeforeTest = "before_test";
inline constexpr const char* kAfterTest = "after_test";
inline constexpr const char* kNotChosen = "not_chosen";
}  // namespace left_out

// Adds rows to the count of a reason, and to n_left_out. Nothing happens for a count of 0.
void add_left_out(FitResult& result, const std::string& reason, std::size_t count);

// Adds the flag rows-left-out if more than 1 % of the rows of the test are lost, and the defect
// rows-lost if it is more than 20 %. Rows that do not belong to the test or that the user did not
// choose are not lost. The part of a captured run after the punch was lifted off is a reason for the
// first flag only.
void flag_left_out(FitResult& result);

// "3 of 3000 rows left out: 2 rows that are spikes, 1 row without a number"; empty without any.
std::string left_out_text(const FitResult& result);

}  // namespace viscard
