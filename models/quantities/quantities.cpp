#include "models/quantities/quantities.h"

namespace viscard {

const std::vector<const Quantity*>& all_quantities() {
  using namespace quantities;
  static const std::vector<const Quantity*> kAll{&kStress,
                                                 &kModulus,
                                                 &kBulkModulus,
                                                 &kCompliance,
                                                 &kDensity,
                                                 &kPoissonRatio,
                                                 &kStretch,
                                                 &kStrain,
                                                 &kTemperature,
                                                 &kTemperatureChange,
                                                 &kDriftOfTemperature,
                                                 &kForce,
                                                 &kBenchForce,
                                                 &kStiffness,
                                                 &kLength,
                                                 &kDepth,
                                                 &kTipSize,
                                                 &kThickness,
                                                 &kTravel,
                                                 &kShapeRadius,
                                                 &kAngle,
                                                 &kMass,
                                                 &kTime,
                                                 &kRamp,
                                                 &kHold,
                                                 &kPeriod,
                                                 &kSpeed,
                                                 &kAcceleration,
                                                 &kRate,
                                                 &kFrequency,
                                                 &kVoltage,
                                                 &kResistance,
                                                 &kCapacitance,
                                                 &kSurfaceEnergy};
  return kAll;
}

const Quantity* quantity_of_unit(const std::string& unit) {
  using namespace quantities;
  static const std::vector<const Quantity*> kGeneral{
      &kStress,     &kCompliance,  &kDensity,      &kTemperature, &kTemperatureChange,
      &kForce,      &kStiffness,   &kLength,       &kAngle,       &kMass,
      &kTime,       &kSpeed,       &kAcceleration, &kFrequency,   &kVoltage,
      &kResistance, &kCapacitance, &kSurfaceEnergy};
  for (const Quantity* quantity : kGeneral) {
    if (unit == quantity->unit) return quantity;
  }
  return nullptr;
}

}  // namespace viscard
