#pragma once

#include <limits>
#include <string>
#include <vector>

namespace viscard {

// Which numbers of a column or list the range is compared with; a single number is compared itself.
enum class QuantityKind {
  kEach,     // every number
  kLargest,  // the largest magnitude: a record may begin at 0
};

// Which signs a number by itself can have. A column may have the other sign of its instrument, and
// its reader proposes to flip it.
enum class Sign { kAny, kNotNegative, kPositive };

// From a lowest number of 0 or above, the range is that of the magnitude.
struct PlausibleRange {
  double lowest = 0.0;   // in the SI unit of the quantity
  double highest = 0.0;  // likewise
};

// What a number that enters viscard means, and how large it can be. All readers take unit and range
// from here: files, columns of tables, options, keywords, requests, cards.
struct Quantity {
  const char* name;  // "modulus"
  const char* unit;  // SI; "1": a plain number
  QuantityKind kind;
  PlausibleRange measured;  // in records, options and files of the bench
  PlausibleRange scene;     // in scenes, which may describe what nobody has measured
  const char* example;      // with the unit in which people write it; "": none
  const char* reason;       // of the measured range
  const char* meaning;
  Sign sign = Sign::kAny;
  bool zero_is_none = false;  // 0 means that it is not given
};

// README.md has them as a table, which a test compares.
namespace quantities {

inline constexpr double kMonth_s = 30.0 * 86400.0;
// The end of a range without an end, in any unit.
inline constexpr double kAny = std::numeric_limits<double>::infinity();

// Materials.
inline constexpr Quantity kStress{"stress",
                                  "Pa",
                                  QuantityKind::kLargest,
                                  {0.1, 1e12},
                                  {0.0, 1e12},
                                  "10 kPa",
                                  "a rheometer sees no less in soft gels; no solid bears more",
                                  "force over area"};
inline constexpr Quantity kModulus{
    "modulus",
    "Pa",
    QuantityKind::kLargest,
    {100.0, 1e12},
    {10.0, 1e16},
    "2 MPa",
    "from the softest gels that hold their shape to diamond",
    "stress over strain at once: E0, or the largest value of a column",
    Sign::kPositive};
inline constexpr Quantity kBulkModulus{"bulk modulus",
                                       "Pa",
                                       QuantityKind::kEach,
                                       {100.0, 1e12},
                                       {10.0, 1e16},
                                       "2 GPa",
                                       "no solid lies outside; rubber has 1 to 3 GPa",
                                       "pressure over the share of volume that is lost",
                                       Sign::kPositive};
inline constexpr Quantity kCompliance{
    "compliance",
    "1/Pa",
    QuantityKind::kLargest,
    {1e-12, 1e6},
    {1e-16, 1e6},
    "0.5 1/MPa",
    "the reciprocal of 1 TPa; a liquid that flows for long has much",
    "strain over stress",
    Sign::kPositive};
inline constexpr Quantity kDensity{"density",
                                   "kg/m3",
                                   QuantityKind::kEach,
                                   {5.0, 25000.0},
                                   {0.1, 1e5},
                                   "1.1 g/cm3",
                                   "from foams to osmium, 22600 kg/m3",
                                   "mass over volume",
                                   Sign::kPositive,
                                   true};
inline constexpr Quantity kPoissonRatio{
    "Poisson ratio",
    "1",
    QuantityKind::kEach,
    {-1.0, 0.5},
    {-1.0, 0.5},
    "0.495",
    "an isotropic solid outside gains energy when it is deformed",
    "strain across over strain along, with the other sign"};
inline constexpr Quantity kStretch{"stretch",
                                   "1",
                                   QuantityKind::kEach,
                                   {0.05, 15.0},
                                   {0.05, 15.0},
                                   "1.5",
                                   "the softest elastomers break at stretches of 10 to 15",
                                   "length over length at rest",
                                   Sign::kPositive};
inline constexpr Quantity kStrain{"strain",
                                  "1",
                                  QuantityKind::kLargest,
                                  {0.0, 14.0},
                                  {0.0, 14.0},
                                  "1 %",
                                  "the softest elastomers break at stretches of 10 to 15",
                                  "change of length over length at rest"};
inline constexpr Quantity kTemperature{
    "temperature",
    "degC",
    QuantityKind::kEach,
    {-200.0, 1000.0},
    {-273.15, 3000.0},
    "23 degC",
    "polymers are neither measured in liquid hydrogen nor above red heat",
    "of the specimen"};
inline constexpr Quantity kTemperatureChange{"temperature difference",
                                             "K",
                                             QuantityKind::kEach,
                                             {0.0, 1000.0},
                                             {0.0, 3000.0},
                                             "1 K",
                                             "as for temperatures",
                                             "of two states, or an absolute temperature"};
inline constexpr Quantity kDriftOfTemperature{
    "temperature drift",
    "K",
    QuantityKind::kEach,
    {0.01, 50.0},
    {0.01, 50.0},
    "1 K",
    "thermometers resolve no less; 1 degC is 274.15 K and no difference",
    "that a run may have",
    Sign::kPositive};

// Forces and lengths.
inline constexpr Quantity kForce{"force",
                                 "N",
                                 QuantityKind::kLargest,
                                 {0.0, 1e6},
                                 {0.0, 1e6},
                                 "10 mN",
                                 "the largest testing machines have 1 MN",
                                 "on the specimen"};
inline constexpr Quantity kBenchForce{"force",
                                      "N",
                                      QuantityKind::kEach,
                                      {0.0, 1e4},
                                      {0.0, 1e4},
                                      "10 mN",
                                      "a stage on a bench does not press more",
                                      "that a test asks for at the bench",
                                      Sign::kNotNegative};
inline constexpr Quantity kStiffness{"stiffness",
                                     "N/m",
                                     QuantityKind::kEach,
                                     {1e-3, 1e12},
                                     {1e-6, 1e15},
                                     "10 N/mm",
                                     "from the softest cantilevers to the frame of a press",
                                     "force over displacement",
                                     Sign::kPositive};
inline constexpr Quantity kLength{"length",
                                  "m",
                                  QuantityKind::kEach,
                                  {0.0, 1.0},
                                  {0.0, 10.0},
                                  "0.1 mm",
                                  "nothing on a bench or in a sensor is longer",
                                  "any length, distance or displacement"};
inline constexpr Quantity kDepth{"depth",
                                 "m",
                                 QuantityKind::kLargest,
                                 {0.0, 0.05},
                                 {0.0, 1.0},
                                 "0.13 mm",
                                 "a punch goes into a specimen by millimetres at most",
                                 "of a tip below the surface at rest",
                                 Sign::kNotNegative};
inline constexpr Quantity kTipSize{"size of the tip",
                                   "m",
                                   QuantityKind::kEach,
                                   {1e-8, 0.1},
                                   {1e-9, 1e3},
                                   "4.4 mm",
                                   "from the tips of force microscopes to plates",
                                   "diameter of a punch, radius of a sphere",
                                   Sign::kPositive};
inline constexpr Quantity kThickness{
    "thickness",
    "m",
    QuantityKind::kEach,
    {1e-8, 1.0},
    {1e-10, 1.0},
    "11 mm",
    "from films of a few molecules to the largest blocks on a bench",
    "of a layer on a rigid base",
    Sign::kPositive};
inline constexpr Quantity kTravel{"travel",
                                  "m",
                                  QuantityKind::kEach,
                                  {1e-6, 2.0},
                                  {1e-6, 2.0},
                                  "10 mm",
                                  "no stage on a bench moves less or more",
                                  "of the stage",
                                  Sign::kPositive};
inline constexpr Quantity kShapeRadius{"radius",
                                       "m",
                                       QuantityKind::kEach,
                                       {1e-9, 1e4},
                                       {1e-9, 1e4},
                                       "100 mm",
                                       "a lens of a larger radius is flat over any sensor",
                                       "of a sphere or cylinder that touches",
                                       Sign::kPositive};
inline constexpr Quantity kAngle{"angle",    "rad",   QuantityKind::kEach, {0.0, 6.3},
                                 {0.0, 6.3}, "2 deg", "a full turn",       "between directions"};
inline constexpr Quantity kMass{"mass",
                                "kg",
                                QuantityKind::kLargest,
                                {0.0, 1e5},
                                {0.0, 1e5},
                                "100 g",
                                "the weight of 100 t is the load of the largest testing machines",
                                "of a weight"};

// Motion and time.
inline constexpr Quantity kTime{"time",
                                "s",
                                QuantityKind::kLargest,
                                {0.0, 1e30},
                                {0.0, 1e30},
                                "10 s",
                                "curves shifted in temperature reach over thirty decades",
                                "since the start of the test or of the clock"};
inline constexpr Quantity kRamp{
    "duration",
    "s",
    QuantityKind::kEach,
    {1e-3, kMonth_s},
    {1e-3, kMonth_s},
    "1 s",
    "a stage needs 1 ms to start; nobody waits at a bench for more than a month",
    "of a move at the rig",
    Sign::kPositive};
inline constexpr Quantity kHold{"duration",
                                "s",
                                QuantityKind::kEach,
                                {0.0, kMonth_s},
                                {0.0, kMonth_s},
                                "60 s",
                                "nobody waits at a bench for more than a month",
                                "of a rest at the rig",
                                Sign::kNotNegative};
inline constexpr Quantity kPeriod{"period",
                                  "s",
                                  QuantityKind::kEach,
                                  {0.01, 3600.0},
                                  {0.01, 3600.0},
                                  "1 s",
                                  "thermometers answer no faster; a drift is not seen with fewer",
                                  "between readings of a thermometer",
                                  Sign::kPositive};
inline constexpr Quantity kSpeed{"speed",
                                 "m/s",
                                 QuantityKind::kEach,
                                 {1e-9, 0.2},
                                 {1e-12, 1e4},
                                 "0.05 mm/s",
                                 "no stage on a bench moves slower or faster",
                                 "of the stage",
                                 Sign::kPositive};
inline constexpr Quantity kAcceleration{
    "acceleration", "m/s2",      QuantityKind::kEach,          {0.0, 1e6},
    {0.0, 1e12},    "200 mm/s2", "a hammer blow has 1e5 m/s2", "of the stage or the base"};
inline constexpr Quantity kRate{"rate",
                                "Hz",
                                QuantityKind::kEach,
                                {0.01, 1e5},
                                {0.01, 1e5},
                                "80 Hz",
                                "load cells are read neither slower nor faster",
                                "of readings",
                                Sign::kPositive};
inline constexpr Quantity kFrequency{"frequency",
                                     "Hz",
                                     QuantityKind::kLargest,
                                     {1e-12, 1e20},
                                     {0.0, 1e20},
                                     "1 Hz",
                                     "curves shifted in temperature reach over thirty decades",
                                     "of an oscillation",
                                     Sign::kNotNegative};

// Electricity and surfaces.
inline constexpr Quantity kVoltage{
    "voltage",  "V",      QuantityKind::kLargest,      {0.0, 1e6},
    {0.0, 1e9}, "1.2 uV", "films break through below", "between electrodes, or of an amplifier"};
inline constexpr Quantity kResistance{
    "resistance",      "ohm",     QuantityKind::kEach,     {0.0, 1e20},
    {0.0, 1e20},       "10 Mohm", "no insulator has more", "of a readout",
    Sign::kNotNegative};
inline constexpr Quantity kCapacitance{
    "capacitance",     "F",     QuantityKind::kEach,   {0.0, 1.0},
    {0.0, 1.0},        "10 pF", "no readout has more", "of a readout",
    Sign::kNotNegative};
inline constexpr Quantity kSurfaceEnergy{"surface energy",
                                         "J/m2",
                                         QuantityKind::kEach,
                                         {0.0, 1e4},
                                         {0.0, 1e6},
                                         "40 mJ/m2",
                                         "the toughest glue takes less",
                                         "of a surface, or work of adhesion",
                                         Sign::kNotNegative};

}  // namespace quantities

// The whole table.
const std::vector<const Quantity*>& all_quantities();

// What a number in this unit is if nothing more is known: in "m" a length, in "s" a time, in "Pa" a
// stress. None for a plain number and for units that the table does not have.
const Quantity* quantity_of_unit(const std::string& unit);

// What a number is: a quantity of the table, or one of which only the unit is known, "m", and so its
// general quantity.
struct QuantityOrUnit {
  const char* si;            // "m"; "1": a plain number
  const Quantity* quantity;  // null: any number is plausible
  // A quantity of the table.
  constexpr QuantityOrUnit(const Quantity& of) : si(of.unit), quantity(&of) {}
  // The general quantity of an SI unit.
  QuantityOrUnit(const char* unit) : si(unit), quantity(quantity_of_unit(unit)) {}
  // Any number in this unit.
  static constexpr QuantityOrUnit any(const char* unit) { return {unit, nullptr}; }

 private:
  constexpr QuantityOrUnit(const char* unit, const Quantity* of) : si(unit), quantity(of) {}
};

}  // namespace viscard
