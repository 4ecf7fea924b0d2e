#pragma once

#include <cstdint>

namespace viscard {

// Tables of a capture file; io/capture/README.md explains the columns. seq counts the records of
// all tables in the order of append().
inline constexpr std::uint32_t kCaptureApplicationId = 0x56434150;  // "VCAP"
inline constexpr std::uint32_t kCaptureSchemaVersion = 2;           // 2: load_samples.force_N

inline constexpr const char* kCaptureTables = R"sql(
CREATE TABLE run(key TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID;
CREATE TABLE raw_bytes(seq INTEGER PRIMARY KEY, host_time_s REAL, device TEXT, is_sent INTEGER,
                       bytes BLOB);
CREATE TABLE load_samples(seq INTEGER PRIMARY KEY, sample_index INTEGER, host_time_s REAL,
                          device_time_s REAL, counts REAL, volts REAL, is_saturated INTEGER,
                          is_glitch INTEGER, force_N REAL);
CREATE TABLE stage_reports(seq INTEGER PRIMARY KEY, host_time_s REAL, position_m REAL, state TEXT);
CREATE TABLE moves(seq INTEGER PRIMARY KEY, start_time_s REAL, from_m REAL, to_m REAL,
                   speed_m_s REAL, acceleration_m_s2 REAL, start_uncertainty_s REAL, purpose TEXT);
CREATE TABLE events(seq INTEGER PRIMARY KEY, host_time_s REAL, name TEXT, value TEXT, text TEXT);
)sql";

}  // namespace viscard
