#include "models/calibration.h"

#include "models/text_of_number.h"

#include <chrono>
#include <cmath>
#include <stdexcept>

namespace viscard {

void validate(const LoadCellCalibration& calibration) {
  if (!std::isfinite(calibration.volts_per_newton) || calibration.volts_per_newton == 0.0) {
    throw std::invalid_argument("load cell gain is " + text_of(calibration.volts_per_newton) +
                                " V/N; it must be finite and not zero");
  }
  if (!(calibration.capacity_N > 0.0) || !std::isfinite(calibration.capacity_N)) {
    throw std::invalid_argument("load cell capacity is " + text_of(calibration.capacity_N) +
                                " N; it must be positive");
  }
}

namespace {

bool is_iso_day(const std::string& text) {
  const std::string day = text.substr(0, 10);
  if (day.size() < 10 || day[4] != '-' || day[7] != '-') return false;
  for (const std::size_t i : {0, 1, 2, 3, 5, 6, 8, 9}) {
    if (day[i] < '0' || day[i] > '9') return false;
  }
  if (text.size() > 10 && text[10] != 'T' && text[10] != ' ') return false;
  return std::chrono::year_month_day(
             std::chrono::year(std::stoi(day.substr(0, 4))),
             std::chrono::month(static_cast<unsigned>(std::stoi(day.substr(5, 2)))),
             std::chrono::day(static_cast<unsigned>(std::stoi(day.substr(8, 2)))))
      .ok();
}

void validate_date(const char* key, const std::string& text) {
  if (text.empty() || is_iso_day(text)) return;
  throw std::invalid_argument("calibration." + std::string(key) + " '" + text +
                              "' is no day such as 2026-11-21");
}

}  // namespace

void validate_dates(const LoadCellCalibration& calibration) {
  validate_date("date", calibration.date);
  validate_date("valid_until", calibration.valid_until);
}

std::string last_valid_day(const LoadCellCalibration& calibration) {
  if (!calibration.valid_until.empty()) return calibration.valid_until;
  const std::string& date = calibration.date;
  if (date.size() < 10 || date.find_first_not_of("0123456789") != 4) return {};
  const int year = std::stoi(date.substr(0, 4)) + 1;
  // A year after a leap day there is none.
  const std::string day = date.substr(4, 6) == "-02-29" ? "-02-28" : date.substr(4, 6);
  return std::to_string(year) + day;
}

std::string calibration_trouble(const LoadCellCalibration& calibration, const std::string& today) {
  const std::string last = last_valid_day(calibration);
  const std::string name = calibration.id.empty() ? "" : " '" + calibration.id + "'";
  if (last.empty()) {
    return "the load cell's calibration" + name +
           " has no date, so nobody can tell whether it still holds. Make one with: viscard "
           "calibrate; or set date under [calibration] of the rig file";
  }
  // ISO dates compare as text.
  if (calibration.date.substr(0, 10) > today.substr(0, 10)) {
    return "the load cell's calibration" + name + " is dated " + calibration.date +
           ", which is later than today, " + today.substr(0, 10) +
           ". Correct date under [calibration], or this computer's clock";
  }
  if (today.substr(0, 10) <= last.substr(0, 10)) return {};
  return "the load cell's calibration" + name + " expired on " + last +
         ". Make a new one with: viscard calibrate";
}

double force_N_from_volts(const LoadCellCalibration& calibration, double volts) {
  return (volts - calibration.zero_volts) / calibration.volts_per_newton;
}

double volts_from_force_N(const LoadCellCalibration& calibration, double force_N) {
  return force_N * calibration.volts_per_newton + calibration.zero_volts;
}

}  // namespace viscard
