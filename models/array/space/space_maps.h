#pragma once

#include "models/answer/scene_answer.h"
#include "models/array/space/space_array.h"
#include "models/array/space/space_scene.h"

#include <cstddef>
#include <string>
#include <vector>

namespace viscard {

constexpr double kCrosstalkScale = 10.0;  // %: a tolerance of 1e-3 gives percentages to 0.01 points
constexpr const char* kCrosstalk = "crosstalk_percent";

// True if the scene asks for a map, or for one of its values.
bool asks_for_map(const SpaceScene& scene, const std::string& map);
// True if there are unloaded pillars, and loaded ones have a voltage of their own to compare with.
bool has_crosstalk(const SpaceScene& scene);

// The pillars and the loads on their tops, as an answer shows them.
SceneArray array_of_answer(const SpaceScene& scene, const TopLoads& loads_Pa);

// The least voltage that the tolerance refers to, also where pillars are only sheared: 1 % of what the
// largest load would give as a pressure.
double least_voltage_V(const SpaceResponse& response, const TopLoads& loads_Pa,
                       Eigen::Index reading);
// The maps of voltages and of cross-talk that the scene asks for, without errors. The readings are those of
// SpaceResponse under the loads.
std::vector<SceneMap> maps_of(const SpaceScene& scene, const SpaceResponse& response,
                              const TopLoads& loads_Pa, const Eigen::MatrixXd& readings_V);

// The side of the cells of a square lattice of like pillars without gaps; 0 for other arrays.
double square_pitch_m(const SpaceScene& scene);

// Curves over the wavelength of a wave along x on an endless square lattice, if the scene asks for them by
// name (eq. S13): voltage_per_pressure (of the mean pressure on the cells) and voltage_per_height (of a
// rigid surface that touches all tops), of the disc or electrode under a pillar, with neighbours up to
// `reach_m` away.
void add_transfer(const SpaceScene& scene, const SpaceResponse& response, double reach_m,
                  SceneAnswer& answer);
// Forces of the pillars from the quarters of their electrodes (models/array/quadrants). The maps
// sensed_normal_force (N, down), sensed_shear_x_force and sensed_shear_y_force; the results
//   sensed_normal_deviation, ...  N, the largest difference from what the scene's loads put on a top
//   without_neighbours_percent    largest error of pillars that are read by their own four voltages alone, over the
//                                 largest force
//   unexplained_voltage           V, the largest voltage of a quarter that the forces leave open
//   gain_normal, ...              Pa/V, of quarter 1 of the usual pillars (eq. Q1)
//   resolution_normal_force, ...  N rms, as large as the noise, of a pillar in the middle (eq. Q4)
//   decoupling_condition          of the array, or of its middle
std::vector<std::string> sensed_maps(const SpaceScene& scene);
std::vector<std::string> sensed_results(const SpaceScene& scene);
// True if the scene asks for any of them.
bool senses_forces(const SpaceScene& scene);
// Adds the maps and the results that depend on the voltages. The readings are those of
// SpaceResponse under the loads, or the measured ones of the scene.
void add_sensed(const SpaceScene& scene, const SpaceResponse& response, const TopLoads& loads_Pa,
                const Eigen::MatrixXd& readings_V, SceneAnswer& answer);
// Adds to the errors of forces what the stated noise of the measured voltages makes of them (eq. Q4), 95 %.
void add_reading_noise(const SpaceScene& scene, SceneAnswer& answer);
// Adds the remaining results, once, and notes for the reader.
void finish_sensed(const SpaceScene& scene, SceneAnswer& answer);
std::vector<std::string> sensed_notes(const SpaceScene& scene);
// The loads behind the measured voltages, coarsely.
TopLoads measured_loads_Pa(const SpaceScene& scene);
// Throws SceneMistake naming what contradicts the quarters.
void check_quadrants(const SpaceScene& scene);
// Noise of the open voltage of a quarter, V rms: as stated, or that of the amplifier; 0 if neither is given.
double quarter_noise_V(const SpaceScene& scene);

// Results of heat and noise that the scene may ask for by name.
std::vector<std::string> sensing_results(const SpaceScene& scene);

// Results name single pillars where there are at most this many.
constexpr std::size_t kMostNamedPillars = 25;

// Replaces the results of the answer that are values of its maps: the largest and the smallest
// value of each map, and the values of single pillars that the scene wants.
void set_results(const SpaceScene& scene, SceneAnswer& answer);

// Curves along the row under a shape: the pressure on each top, and the gap over its middle.
constexpr const char* kPressureProfile = "pressure_profile";
constexpr const char* kGapProfile = "gap_profile";
struct SpaceContact;
void add_profiles(const SpaceScene& scene, const SpaceContact& contact, SceneAnswer& answer);

}  // namespace viscard
