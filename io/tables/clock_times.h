#pragma once

#include "io/tables/csv_table.h"

#include <optional>
#include <string>
#include <string_view>

namespace viscard {

// A time as clocks write it, in seconds: "12:00:05.25", "00:05.25" (minutes and seconds),
// "2024-05-01T12:00:05.25Z", "01.05.2024 12:00:05", with AM or PM. Dates count from 1970-01-01 in the
// proleptic Gregorian calendar, without leap seconds.
struct ClockTime {
  double seconds = 0.0;   // whole ones
  double fraction = 0.0;  // of a second; of a minute in "hh:mm.5"
  bool has_date = false;
  int n_fields = 0;  // of the time: 2 or 3
};
// What the first of two small numbers of a date is: "05/01/2024".
enum class DateOrder { kDayFirst, kMonthFirst };
std::optional<ClockTime> clock_time_from(std::string_view cell,
                                         DateOrder order = DateOrder::kDayFirst);

// Turns columns of clock times into seconds. Where days and months can be told apart in no row, the order whose
// times go on most evenly is taken. Days since 1899-12-30, as spreadsheets count them (45413.50000116), are
// recognised in a column without unit whose steps would be shorter than 0.1 ms. A column with dates, or that begins later than it is long
// (the time of day), begins half a step after 0, because the load came before its first row; the table's notes
// say so. Times of day may pass midnight.
void read_clock_times(CsvTable& table);

}  // namespace viscard
