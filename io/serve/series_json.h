#pragma once

#include "io/serve/series_folder.h"
#include "models/experiment/rig_config.h"
#include "models/experiment/test_plan.h"
#include "models/quantities/plausible.h"
#include "rig/run/expected_course.h"
#include "rig/run/preflight.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace viscard {

// The objects that the page sends and receives; numbers in SI with the unit in the key (README.md).

// Throws ApiError 400 if the text is not a JSON object.
nlohmann::ordered_json object_from_text(const std::string& text);
// Throws ApiError 400 naming the key if it is missing or not a text.
std::string text_at(const nlohmann::ordered_json& object, const char* key);
// The finite number of a key. Throws ApiError 400.
double number_at(const nlohmann::ordered_json& object, const std::string& key);
// How the page wants the numbers of this request judged: "plausible", "on" or "off"; on without it. Throws ApiError 400.
Plausible judged_by(const nlohmann::ordered_json& request);

nlohmann::ordered_json json_of_rig(const RigConfig& rig, const std::string& calibration_trouble);
nlohmann::ordered_json json_of_test(const TestPlan& plan);
nlohmann::ordered_json json_of_specimen(const SeriesSpecimen& specimen, const SeriesFolder& folder);
nlohmann::ordered_json json_of_preflight(const Preflight& expected, const ExpectedCourse& course);

// The plan with the numbers that the object holds. Throws ApiError 400 naming the key for a value
// that is not a number, or a key that is unknown.
TestPlan test_with(TestPlan plan, const nlohmann::ordered_json& object);
// Throws ApiError 409 if a value of the test that a page has shown differs from the plan: another
// page, or an editor, has changed the file since.
void refuse_unseen_test(const nlohmann::ordered_json& shown, const TestPlan& plan);
Specimen specimen_from(const nlohmann::ordered_json& object);

// Readable on the wire: rounded to what a load cell and a stage resolve.
std::vector<double> rounded(const std::vector<double>& values, double step);

}  // namespace viscard
