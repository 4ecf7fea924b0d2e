#pragma once

#include "models/array/plane/array_scene.h"
#include "models/array/plane/array_statics.h"

namespace viscard::test {

// PVDF of data/materials/pvdf_seed.json and PDMS of the seed's arrays.
inline Medium seed_pvdf() {
  PiezoMatrix d = PiezoMatrix::Zero();
  d(2, 0) = 22e-12;
  d(2, 1) = 3e-12;
  d(2, 2) = -30e-12;
  return piezo_medium(isotropic_moduli_Pa(2e9, 0.29), d,
                      12.0 * kVacuumPermittivity_F_m * Eigen::Matrix3d::Identity(), 1780.0);
}

inline ArrayMedia seed_media(PlaneState plane = PlaneState::kStress) {
  return {isotropic_medium(1.8e6, 0.33, 965.0), seed_pvdf(), plane};
}

constexpr double kSeedPressure_Pa = 1e3;
const Discretisation kSeedMesh{.degree = 5, .layers = 2};
const Discretisation kFineMesh{.degree = 6,
                               .layers = 3};  // voltages to 3e-6, see the test of 4.12 mV

inline ArrayScene seed_scene() {
  ArrayScene scene;
  scene.pillar.E0_Pa = 1.8e6;
  scene.pillar.nu = 0.33;
  scene.pillar.rho_kg_m3 = 965.0;
  scene.film = seed_pvdf();
  scene.load_Pa = kSeedPressure_Pa;
  return scene;
}

// One pillar of an endless row, all loaded.
inline ArrayGeometry endless_row(double spacing_m, double thickness_m = 25e-6,
                                 double diameter_m = 40e-6) {
  return {.count = 1,
          .diameter_m = diameter_m,
          .length_m = 3.0 * diameter_m,
          .spacing_m = spacing_m,
          .film_thickness_m = thickness_m,
          .ends = FilmEnds::kMirror};
}

// Responses to unit loads on single pillars: rows are pillars that are read, columns pillars that
// are loaded (0-based). Every static answer of the array is a sum of columns.
struct ArrayResponse {
  Eigen::MatrixXd centre_V;     // charge-free face: under the pillars' centres
  Eigen::MatrixXd mean_V;       // charge-free face: mean over the electrode's width
  Eigen::MatrixXd electrode_V;  // equipotential electrodes, all open; else empty
  Eigen::MatrixXd midway_V;     // midway between pillar i and i + 1; last row the mirror's, if any
  Eigen::MatrixXd top_m;        // mean displacement of the tops: along z under pressure, along x
                                // under shear
  Eigen::MatrixXd V_per_C;      // electrodes: inverse of the capacitance matrix, per metre
};

inline ArrayResponse array_response(const ArrayModel& model, ArrayLoad load) {
  const int n = model.geometry().count;
  const int port = port_of(load);
  const bool has_electrodes = model.electrode_port(0) >= 0;
  std::vector<int> loaded;
  for (int i = 0; i < n; ++i) loaded.push_back(model.pillar_port(i, port));
  for (int i = 0; has_electrodes && i < n; ++i) loaded.push_back(model.electrode_port(i));
  const Eigen::MatrixXd all = model.chain().compliance(loaded);
  const auto rows = [&](auto row_of) {
    Eigen::MatrixXd matrix(0, n);
    for (int i = 0; i < n; ++i) {
      const int row = row_of(i);
      if (row < 0) continue;
      matrix.conservativeResize(matrix.rows() + 1, Eigen::NoChange);
      matrix.bottomRows(1) = all.row(row).head(n);
    }
    return matrix;
  };
  ArrayResponse response;
  response.centre_V = rows([&](int i) { return model.centre_port(i); });
  response.mean_V = rows([&](int i) { return model.mean_port(i); });
  response.electrode_V = rows([&](int i) { return model.electrode_port(i); });
  response.midway_V = rows([&](int i) { return model.midway_port(i); });
  response.top_m = metres_per_reading(load, model.geometry()) *
                   rows([&](int i) { return model.pillar_port(i, port); });
  if (has_electrodes) {
    response.V_per_C.resize(n, n);
    for (int i = 0; i < n; ++i) {
      response.V_per_C.row(i) = -all.row(model.electrode_port(i)).tail(n);
    }
  }
  return response;
}

inline ArrayResponse seed_response(const ArrayGeometry& geometry,
                                   PlaneState plane = PlaneState::kStress,
                                   const Discretisation& mesh = kSeedMesh) {
  return array_response(ArrayModel(geometry, {}, seed_media(plane), mesh), ArrayLoad::kPressure);
}

// Under the centre of a pillar of an endless row, 1 kPa on all; positive as the seed plots it.
inline double centre_mV(const ArrayGeometry& geometry, PlaneState plane = PlaneState::kStress,
                        const Discretisation& mesh = kSeedMesh) {
  return -1e3 * kSeedPressure_Pa * seed_response(geometry, plane, mesh).centre_V(0, 0);
}

}  // namespace viscard::test
