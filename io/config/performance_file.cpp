#include "io/config/performance_file.h"

#include "io/basics/atomic_file.h"
#include "io/basics/file_kind.h"
#include "io/config/config_show.h"

namespace viscard {

void show_performance(FieldVisitor& fields, RigPerformance& performance) {
  using enum Range;
  fields.quantity({"noise", "N", kNotNegative}, performance.noise_N);
  fields.quantity({"gain_drift", "1/s", kNotNegative}, performance.gain_drift_1_s);
  fields.quantity({"step", "m", kNotNegative}, performance.step_m);
  fields.quantity({"acceleration", "m/s2", kPositive}, performance.acceleration_m_s2);
  fields.quantity({"max_speed", "m/s", kPositive}, performance.max_speed_m_s);
  fields.quantity({"approach", "s", kNotNegative}, performance.approach_s);
  fields.quantity({"handling", "s", kNotNegative}, performance.handling_s);
}

RigPerformance performance_from_toml(const std::string& rig_text, const std::string& name) {
  RigPerformance performance;
  RigConfig rig;
  read_toml_fields(rig_text, name, [&](FieldVisitor& fields) {
    show_rig(fields, rig);
    fields.section("performance",
                   [&](FieldVisitor& inner) { show_performance(inner, performance); });
  });
  return performance;
}

RigPerformance read_performance(const std::filesystem::path& rig_path) {
  const std::string text = read_file(rig_path);
  return read_as(FileKind::kRig, text, rig_path.string(),
                 [&] { return performance_from_toml(text, rig_path.string()); });
}

}  // namespace viscard
