#include "models/experiment/calibration.h"

#include "models/maths/require.h"

#include <algorithm>
#include <cmath>

namespace viscard {

void validate(const LoadCellCalibration& calibration) {
  require_value(calibration.volts_per_newton != 0.0, "load cell gain", calibration.volts_per_newton,
                "V/N", "finite and not zero");
  require_positive("load cell capacity", calibration.capacity_N, "N");
}

namespace {

// Days of a month in the Gregorian calendar.
int days_of(int month, int year) {
  if (month == 2) return (year % 4 == 0 && year % 100 != 0) || year % 400 == 0 ? 29 : 28;
  return month == 4 || month == 6 || month == 9 || month == 11 ? 30 : 31;
}

}  // namespace

bool is_iso_day(const std::string& text) {
  const std::string day = text.substr(0, 10);
  if (day.size() < 10 || day[4] != '-' || day[7] != '-') return false;
  for (const std::size_t i : {0U, 1U, 2U, 3U, 5U, 6U, 8U, 9U}) {
    if (day[i] < '0' || day[i] > '9') return false;
  }
  if (text.size() > 10 && text[10] != 'T' && text[10] != ' ') return false;
  const int year = std::stoi(day.substr(0, 4));
  const int month = std::stoi(day.substr(5, 2));
  const int in_month = std::stoi(day.substr(8, 2));
  return month >= 1 && month <= 12 && in_month >= 1 && in_month <= days_of(month, year);
}

void validate_date(const std::string& key, const std::string& text) {
  require(text.empty() || is_iso_day(text),
          key + " '" + text + "' is not a day such as 2026-11-21");
}

void validate_dates(const LoadCellCalibration& calibration) {
  validate_date("calibration.date", calibration.date);
  validate_date("calibration.valid_until", calibration.valid_until);
}

std::string last_valid_day(const LoadCellCalibration& calibration) {
  if (!calibration.valid_until.empty()) return calibration.valid_until;
  const std::string& date = calibration.date;
  if (date.size() < 10 || date.find_first_not_of("0123456789") != 4) return {};
  const int year = std::stoi(date.substr(0, 4)) + 1;
  // The year after a leap day has no 29 February.
  const std::string day = date.substr(4, 6) == "-02-29" ? "-02-28" : date.substr(4, 6);
  return std::to_string(year) + day;
}

std::string calibration_trouble(const LoadCellCalibration& calibration, const std::string& today) {
  const std::string last = last_valid_day(calibration);
  const std::string name = calibration.id.empty() ? "" : " '" + calibration.id + "'";
  if (last.empty()) {
    return "the load cell's calibration" + name +
           " has no date, so it is unknown whether it is still valid. Make a new one with: viscard "
           "calibrate; or set date under [calibration] of the rig file";
  }
  // ISO dates can be compared as text.
  if (calibration.date.substr(0, 10) > today.substr(0, 10)) {
    return "the load cell's calibration" + name + " is dated " + calibration.date +
           ", which is later than today, " + today.substr(0, 10) +
           ". Correct date under [calibration], or this computer's clock";
  }
  if (today.substr(0, 10) <= last.substr(0, 10)) return {};
  return "the load cell's calibration" + name + " expired on " + last +
         ". Make a new one with: viscard calibrate";
}

namespace {

bool has_parts(const LoadCellCalibration& calibration) {
  return calibration.largest_force_N > 0.0 && calibration.common_u > 0.0;
}

double u_from_parts(const LoadCellCalibration& calibration, double force_N) {
  constexpr double kSmallLoads = 4.0;   // departures shrink with the load
  constexpr double kCreep = 1.0 / 3.0;  // of the hysteresis
  const double largest_N = calibration.largest_force_N;
  const double curvature =
      calibration.curvature_u * (force_N - calibration.curvature_at_N) / calibration.capacity_N;
  const double shape =
      calibration.shape_u * std::clamp(largest_N / force_N, 1.0, kSmallLoads);  // inf at no load
  const double loop = calibration.hysteresis * std::max(2.0 * (1.0 - force_N / largest_N), kCreep);
  return std::hypot(std::hypot(calibration.common_u, curvature), shape, loop / std::sqrt(3.0));
}

}  // namespace

double gain_relative_u_in_use(const LoadCellCalibration& calibration) {
  return std::max(u_from_parts(calibration, calibration.largest_force_N),
                  u_from_parts(calibration, calibration.capacity_N));
}

double gain_relative_u(const LoadCellCalibration& calibration, double force_N) {
  const double stated = std::abs(calibration.volts_per_newton_u / calibration.volts_per_newton);
  if (!has_parts(calibration)) return stated;
  const double parts = u_from_parts(calibration, std::abs(force_N));
  return parts * std::max(1.0, stated / gain_relative_u_in_use(calibration));
}

std::string calibration_range_doubt(const LoadCellCalibration& calibration, double force_N) {
  constexpr double kBeyond = 1.2;
  const double largest_N = calibration.largest_force_N;
  const double at_N = std::abs(force_N);
  if (!(largest_N > 0.0) || !(at_N > kBeyond * largest_N)) return {};
  const auto percent = [&](double force) {
    return text_of(100.0 * gain_relative_u(calibration, force), 2) + " %";
  };
  return "a force of " + text_of(at_N, 3) + " N is " + text_of(at_N / largest_N, 3) +
         " times the largest one of the load cell's calibration, " + text_of(largest_N, 3) +
         " N: the gain has a standard uncertainty of " + percent(at_N) + " there and of " +
         percent(largest_N) + " in the range of the calibration. Calibrate with weights up to " +
         text_of(at_N, 2) + " N";
}

double force_N_from_volts(const LoadCellCalibration& calibration, double volts) {
  return (volts - calibration.zero_volts) / calibration.volts_per_newton;
}

double volts_from_force_N(const LoadCellCalibration& calibration, double force_N) {
  return force_N * calibration.volts_per_newton + calibration.zero_volts;
}

}  // namespace viscard
