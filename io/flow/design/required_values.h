#pragma once

#include "io/flow/design/requirements.h"
#include "io/flow/design/scene_solver.h"
#include "models/scene/scene.h"

namespace viscard {

// The quantities that requirements limit, one function each, for any kind of scene;
// requirement_kinds() is the table of these functions, README.md has the formulas. If a kind of
// scene cannot answer a quantity, the value is "not answered", with the reason. They throw what
// `solve` throws.

// Of the body (required_body.cpp).
RequiredValue required_pillars_per_tactel(const Scene& scene, const Requirements& requirements,
                                          const SceneSolver& solve);
RequiredValue required_wavelength(const Scene& scene, const Requirements& requirements,
                                  const SceneSolver& solve);
RequiredValue required_pressure(const Scene& scene, const Requirements& requirements,
                                const SceneSolver& solve);
RequiredValue required_force(const Scene& scene, const Requirements& requirements,
                             const SceneSolver& solve);
RequiredValue required_bandwidth(const Scene& scene, const Requirements& requirements,
                                 const SceneSolver& solve);
RequiredValue required_hysteresis(const Scene& scene, const Requirements& requirements,
                                  const SceneSolver& solve);
RequiredValue required_nonlinearity(const Scene& scene, const Requirements& requirements,
                                    const SceneSolver& solve);
RequiredValue required_collapse_margin(const Scene& scene, const Requirements& requirements,
                                       const SceneSolver& solve);

// Of what electrodes read (required_readings.cpp).
RequiredValue required_lowest_frequency(const Scene& scene, const Requirements& requirements,
                                        const SceneSolver& solve);
RequiredValue required_pressure_resolution(const Scene& scene, const Requirements& requirements,
                                           const SceneSolver& solve);
RequiredValue required_force_resolution(const Scene& scene, const Requirements& requirements,
                                        const SceneSolver& solve);
RequiredValue required_crosstalk(const Scene& scene, const Requirements& requirements,
                                 const SceneSolver& solve);
RequiredValue required_crosstalk_all(const Scene& scene, const Requirements& requirements,
                                     const SceneSolver& solve);
RequiredValue required_pressure_per_kelvin(const Scene& scene, const Requirements& requirements,
                                           const SceneSolver& solve);
RequiredValue required_voltage_per_pressure(const Scene& scene, const Requirements& requirements,
                                            const SceneSolver& solve);

// Of a surface that slides over the sensor (required_motion.cpp).
RequiredValue required_slip_latency(const Scene& scene, const Requirements& requirements,
                                    const SceneSolver& solve);
RequiredValue required_texture_amplitude(const Scene& scene, const Requirements& requirements,
                                         const SceneSolver& solve);

}  // namespace viscard
