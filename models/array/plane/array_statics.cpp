#include "models/array/plane/array_statics.h"

#include <stdexcept>
#include <utility>

namespace viscard {

ArrayModel::ArrayModel(const ArrayGeometry& geometry, const ArrayElectrodes& electrodes,
                       const ArrayMedia& media, const Discretisation& discretisation,
                       const PillarInertia& inertia)
    : geometry_(geometry), electrodes_(electrodes), has_potential_(media.film.has_permittivity()) {
  if (electrodes.is_equipotential && !has_potential_) {
    throw std::invalid_argument("electrodes need a film with a permittivity");
  }
  const ArrayMesh mesh = array_mesh(geometry, electrodes, discretisation);
  const int degree = discretisation.degree;
  const double half_width_m = electrode_half_width_m(geometry, electrodes);
  pillar_ = condensed_pillar(mesh, media, degree, inertia);
  unknowns_ = pillar_.unknowns;
  const bool is_open_face = !electrodes.is_equipotential;
  cell_ = piece(
      mesh, media, degree,
      {.x_m = mesh.cell_x,
       .readings = is_open_face
                       ? std::vector<PotentialReading>{{0.0, 0.0}, {-half_width_m, half_width_m}}
                       : std::vector<PotentialReading>{},
       .pillar = &pillar_,
       .first_pillar_column = mesh.first_pillar_column,
       .last_pillar_column = mesh.last_pillar_column,
       .electrode_half_width_m = is_open_face ? 0.0 : half_width_m});
  const auto film_only = [&](const std::vector<double>& x_m, double read_m) {
    return piece(mesh, media, degree, {.x_m = x_m, .readings = {{read_m, read_m}}});
  };
  if (geometry.count > 1) gap_ = film_only(mesh.gap_x, 0.5 * mesh.gap_x.back());
  if (!mesh.edge_x.empty()) {
    edge_ = film_only(mesh.edge_x, mesh.edge_x.back());
    left_edge_ = mirrored(edge_);
  }
  std::vector<const CondensedPiece*> pieces;
  if (!mesh.edge_x.empty()) pieces.push_back(&left_edge_);
  for (int i = 0; i < geometry.count; ++i) {
    cell_place_.push_back(pieces.size());
    pieces.push_back(&cell_);
    midway_place_.push_back(pieces.size());
    if (i + 1 < geometry.count) pieces.push_back(&gap_);
  }
  if (!mesh.edge_x.empty()) pieces.push_back(&edge_);
  chain_ = std::make_unique<ArrayChain>(std::move(pieces), geometry.ends);
  unknowns_ += chain_->unknowns();
}

CondensedPiece ArrayModel::piece(const ArrayMesh& mesh, const ArrayMedia& media, int degree,
                                 const FilmPiece& film) {
  CondensedPiece made = condensed_film(film, mesh, media, electrodes_.grounded, degree);
  unknowns_ += made.unknowns;
  return made;
}

int ArrayModel::pillar_port(int pillar, int port) const {
  return chain_->first_port(cell_place_[static_cast<std::size_t>(pillar)]) + port;
}

int ArrayModel::centre_port(int pillar) const {
  if (!has_potential_ || electrodes_.is_equipotential) return -1;
  return pillar_port(pillar, pillar_.port_count());
}

int ArrayModel::mean_port(int pillar) const {
  const int centre = centre_port(pillar);
  return centre < 0 ? -1 : centre + 1;
}

int ArrayModel::electrode_port(int pillar) const {
  return electrodes_.is_equipotential ? pillar_port(pillar, pillar_.port_count()) : -1;
}

int ArrayModel::midway_port(int pillar) const {
  const bool is_last = pillar + 1 == geometry_.count;
  if (!has_potential_ || (is_last && geometry_.ends != FilmEnds::kMirror)) return -1;
  return chain_->first_port(midway_place_[static_cast<std::size_t>(pillar)]);
}

int port_of(ArrayLoad load) {
  return load == ArrayLoad::kPressure ? kPressurePort : kShearPort;
}

double metres_per_reading(ArrayLoad load, const ArrayGeometry& geometry) {
  return (load == ArrayLoad::kPressure ? -1.0 : 1.0) / geometry.diameter_m;
}

ArrayResponse array_response(const ArrayModel& model, ArrayLoad load) {
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

}  // namespace viscard
