#include "models/array/plane/array_statics.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace viscard {

ArrayModel::ArrayModel(const ArrayGeometry& geometry, const ArrayElectrodes& electrodes,
                       const ArrayMedia& media, const Discretisation& discretisation,
                       const PillarPorts& extra)
    : geometry_(geometry), electrodes_(electrodes), has_potential_(media.film.has_permittivity()) {
  if (electrodes.is_equipotential && !has_potential_) {
    throw std::invalid_argument("electrodes need a film with a permittivity");
  }
  const ArrayMesh mesh = array_mesh(geometry, electrodes, discretisation);
  const int degree = discretisation.degree;
  pillar_ = condensed_pillar(mesh, media, degree, extra);
  unknowns_ = pillar_.unknowns;
  cells_ = condensed_cells(mesh, media, degree);
  const auto film_only = [&](const std::vector<double>& x_m, double read_m) {
    FilmPiece film;
    film.mesh.x = x_m;
    film.readings = {{read_m, read_m}};
    return piece(mesh, media, degree, film);
  };
  if (geometry.count > 1) gap_ = film_only(mesh.gap_x, 0.5 * mesh.gap_x.back());
  if (!mesh.edge_x.empty()) {
    edge_ = film_only(mesh.edge_x, mesh.edge_x.back());
    left_edge_ = mirrored(edge_);
  }
  const std::size_t first = mesh.edge_x.empty() ? 0 : 1;
  for (int i = 0; i < geometry.count; ++i) {
    cell_place_.push_back(first + 2 * static_cast<std::size_t>(i));
    midway_place_.push_back(cell_place_.back() + 1);
  }
  chain_ = chain_of(cells_);
  unknowns_ += chain_->unknowns();
}

CondensedCells ArrayModel::condensed_cells(const ArrayMesh& mesh, const ArrayMedia& media,
                                           int degree) {
  const double half_width_m = electrode_half_width_m(geometry_, electrodes_);
  const auto cell = [&](const CellMesh& lines) {
    FilmPiece film;
    film.mesh = lines;
    film.pillar = &pillar_;
    if (electrodes_.is_equipotential) {
      film.electrode_half_width_m = half_width_m;
    } else {
      film.readings = {{0.0, 0.0}, {-half_width_m, half_width_m}};
    }
    return piece(mesh, media, degree, film);
  };
  CondensedCells cells;
  cells.inner = cell(mesh.cell);
  cells.ends_differ = mesh.ends_differ;
  if (cells.ends_differ) {
    cells.first = cell(mesh.first_cell);
    cells.last = cell(mesh.last_cell);
  }
  return cells;
}

std::unique_ptr<ArrayChain> ArrayModel::chain_of(const CondensedCells& cells) const {
  const bool has_edges = edge_.unknowns > 0;
  std::vector<const CondensedPiece*> pieces;
  if (has_edges) pieces.push_back(&left_edge_);
  for (int i = 0; i < geometry_.count; ++i) {
    const bool is_last = i + 1 == geometry_.count;
    pieces.push_back(!cells.ends_differ ? &cells.inner
                     : i == 0           ? &cells.first
                     : is_last          ? &cells.last
                                        : &cells.inner);
    if (!is_last) pieces.push_back(&gap_);
  }
  if (has_edges) pieces.push_back(&edge_);
  return std::make_unique<ArrayChain>(std::move(pieces), geometry_.ends);
}

Eigen::VectorXd ArrayModel::readings_at_0_V(const Eigen::VectorXd& loads) const {
  const int electrode = pillar_.port_count();
  const auto held = [&](const CondensedPiece& cell) {
    return cell.unknowns > 0 ? with_port_held(cell, electrode) : cell;
  };
  const CondensedCells cells{held(cells_.inner), held(cells_.first), held(cells_.last),
                             cells_.ends_differ};
  return chain_of(cells)->readings(loads);
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

ArrayAnswer array_answer(const ArrayModel& model, ArrayLoad load, const Eigen::VectorXd& load_Pa) {
  const int n = model.geometry().count;
  const int port = port_of(load);
  Eigen::VectorXd loads = Eigen::VectorXd::Zero(model.chain().port_count());
  for (int i = 0; i < n; ++i) loads[model.pillar_port(i, port)] = load_Pa[i];
  ArrayAnswer answer = array_answer(model, loads);
  answer.top_m = metres_per_reading(load, model.geometry()) *
                 (port == kPressurePort ? answer.pushed_m2 : answer.sheared_m2);
  return answer;
}

ArrayAnswer array_answer(const ArrayModel& model, const Eigen::VectorXd& loads) {
  const int n = model.geometry().count;
  const auto picked = [&](const Eigen::VectorXd& readings, auto row_of) {
    std::vector<int> rows;
    for (int i = 0; i < n; ++i) {
      if (row_of(i) >= 0) rows.push_back(row_of(i));
    }
    return Eigen::VectorXd(readings(rows));
  };
  const auto electrode_port = [&](int i) { return model.electrode_port(i); };
  const Eigen::VectorXd all = model.chain().readings(loads);
  ArrayAnswer answer;
  answer.centre_V = picked(all, [&](int i) { return model.centre_port(i); });
  answer.mean_V = picked(all, [&](int i) { return model.mean_port(i); });
  answer.electrode_V = picked(all, electrode_port);
  answer.midway_V = picked(all, [&](int i) { return model.midway_port(i); });
  answer.pushed_m2 = picked(all, [&](int i) { return model.pillar_port(i, kPressurePort); });
  answer.sheared_m2 = picked(all, [&](int i) { return model.pillar_port(i, kShearPort); });
  if (answer.electrode_V.size() > 0) {
    answer.electrode_C = -picked(model.readings_at_0_V(loads), electrode_port);
  }
  return answer;
}

double own_V_per_Pa(const ArrayModel& model, ArrayLoad load, int pillar) {
  const int first = model.pillar_port(pillar, 0);
  const int read = std::max(model.centre_port(pillar), model.electrode_port(pillar));
  return model.chain().reading_within(model.cell_place(pillar), read - first, port_of(load));
}

double own_V_per_C(const ArrayModel& model, int pillar) {
  const int electrode = model.electrode_port(pillar) - model.pillar_port(pillar, 0);
  return -model.chain().reading_within(model.cell_place(pillar), electrode, electrode);
}

}  // namespace viscard
