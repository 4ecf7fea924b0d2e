#include "models/pillar/body/directional_film.h"

#include "models/pillar/system/rotated_medium.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

namespace viscard {
namespace {

// Harmonics of one system: the fields of each harmonic follow those of the harmonic before.
struct HarmonicFields {
  int harmonic = 0;
  int first_field = 0;
  Kinematics own;  // with its potential, fields from 0
  int potential() const { return first_field + own.potential_field; }
};

OperatorRow shifted(OperatorRow row, int fields) {
  for (OperatorTerm& term : row) term.field += fields;
  return row;
}

constexpr Eigen::Index kRows = 9;  // strain and electric field of a harmonic

// Factors of the rows at an angle: the shears yz, xy and the field along theta go with the sine.
Eigen::VectorXd angular_factors(int harmonic, double angle) {
  Eigen::VectorXd factors = Eigen::VectorXd::Constant(kRows, std::cos(harmonic * angle));
  for (const Eigen::Index odd : {3, 5, 7}) factors[odd] = std::sin(harmonic * angle);
  return factors;
}

// The form of all harmonics, kRows rows of each, for constants form_at(angle).
template <typename FormAt>
Eigen::MatrixXd integrated_form(const std::vector<HarmonicFields>& parts, const FormAt& form_at) {
  const auto n = kRows * static_cast<Eigen::Index>(parts.size());
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(n, n);
  Eigen::MatrixXd size = sum;
  // The trapezoidal rule is exact up to the harmonic kAngles - 1; the integrand has those of two
  // fields and four of the constants (elastic constants are of fourth order).
  const int angles = 2 * parts.back().harmonic + 8;
  const double weight = 2.0 * std::numbers::pi / angles;
  for (int k = 0; k < angles; ++k) {
    // Half a step off the axes, so that the sines of no harmonic vanish at all points.
    const double angle = (k + 0.5) * weight;
    const Eigen::MatrixXd D = form_at(angle);
    Eigen::VectorXd T(n);
    for (std::size_t i = 0; i < parts.size(); ++i) {
      T.segment(kRows * static_cast<Eigen::Index>(i), kRows) =
          angular_factors(parts[i].harmonic, angle);
    }
    const auto count = static_cast<Eigen::Index>(parts.size());
    const Eigen::MatrixXd all =
        weight * T.asDiagonal() * D.replicate(count, count) * T.asDiagonal();
    sum += all;
    size += all.cwiseAbs();
  }
  // Terms that cancel over the angles leave rounding errors, which would cost time in every
  // element.
  constexpr double kRounding = 1e-13;
  return (sum.array().abs() > kRounding * size.array()).select(sum, 0.0);
}

class DirectionalModel {
 public:
  DirectionalModel(const PillarGeometry& geometry, const Discretisation& mesh,
                   const PillarMedia& media, const ModelOptions& options, int highest_harmonic)
      : options_(options),
        media_(media),
        mesh_(pillar_mesh(with_electrode_edge(geometry, options.electrodes), mesh)),
        scale_V_(potential_scale_V(*media.film)) {
    kinematics_.measure = 1.0;  // the forms contain the integral over the angle
    for (int m = 0; m <= highest_harmonic; m += 2) add_harmonic(m);
    DofMap dofs = make_dofs();
    for (const HarmonicFields& part : parts_) {
      Kinematics k = kinematics_;
      k.measure = part.own.measure;
      k.divergence = shifted(part.own.divergence, part.first_field);
      of_harmonic_.push_back(std::make_unique<DiscreteSystem>(mesh_.section, std::move(k), dofs));
    }
    system_ = std::make_unique<DiscreteSystem>(mesh_.section, kinematics_, std::move(dofs));
  }

  FilmAnswer answer() const {
    StiffnessFactor factored;
    factor(factored);
    const Eigen::VectorXd traction =
        2.0 * std::numbers::pi * system_->line_load(1, mesh_.top_row, 0, mesh_.pillar_columns);
    FilmAnswer answer;
    answer.area_m2 = traction.sum();
    answer.unknowns = system_->size();
    if (electrode_ >= 0) {
      answer.piezo =
          piezo_answer(factored, traction, system_->dofs().tied_dof(electrode_), scale_V_, 1.0);
      return answer;
    }
    const Eigen::VectorXd u = factored.solve(-traction);
    answer.piezo.top_displacement_m = traction.dot(u) / answer.area_m2;
    read_face(u, answer);
    return answer;
  }

 private:
  void add_harmonic(int m) {
    HarmonicFields part{
        m, kinematics_.field_count,
        with_potential(m == 0 ? kinematics_of(Motion::kLongitudinal) : fourier_kinematics(m),
                       scale_V_)};
    for (const OperatorRow& row : part.own.strain_and_field()) {
      rows_.push_back(shifted(row, part.first_field));
    }
    for (const int field : part.own.zero_on_axis) {
      kinematics_.zero_on_axis.push_back(part.first_field + field);
    }
    kinematics_.field_count += part.own.field_count;
    parts_.push_back(std::move(part));
  }

  int face_break(bool is_free) const {
    const bool is_bottom = (options_.electrodes->grounded == FilmFace::kTop) == is_free;
    return is_bottom ? 0 : mesh_.bond_row;
  }

  DofMap make_dofs() {
    const Section& section = mesh_.section;
    const int columns = section.x().element_count();
    DofMap dofs(kinematics_.field_count, section.node_count());
    const std::vector<int> free_face = nodes_on_break(section, face_break(true), 0, columns);
    const std::vector<int> bottom = nodes_on_break(section, 0, 0, columns);
    const double edge_m = options_.electrodes->electrode_radius_m * (1.0 + 1e-9);
    for (const HarmonicFields& part : parts_) {
      const int phi = part.potential();
      std::vector<int> electrode;
      for (const int node : free_face) {
        if (edge_m > 0.0 && section.node_x(node) <= edge_m) electrode.push_back(node);
      }
      // An electrode has one potential: its higher harmonics are zero.
      if (part.harmonic == 0 && !electrode.empty()) electrode_ = dofs.tie(phi, electrode);
      if (part.harmonic > 0) fix_all(phi, electrode, dofs);
      fix_all(phi, nodes_on_break(section, face_break(false), 0, columns), dofs);
      for (int node = 0; node < section.node_count(); ++node) {
        if (section.node_z(node) > 0.0) dofs.fix(phi, node);  // the pillar has no electric field
      }
      for (int field = part.first_field; options_.fixed_bottom && field < phi; ++field) {
        fix_all(field, bottom, dofs);
      }
      hold_top(part, dofs);
    }
    if (!options_.fixed_bottom && options_.pin_bottom) {
      for (const RigidPin& pin : rigid_pins(Motion::kLongitudinal)) {
        dofs.fix(pin.field, pin.at_rim ? bottom.back() : bottom.front());
      }
    }
    for (int node = 0; node < section.node_count(); ++node) {
      if (section.node_x(node) != 0.0) continue;
      for (const int field : kinematics_.zero_on_axis) dofs.fix(field, node);
    }
    dofs.number();
    return dofs;
  }

  static void fix_all(int field, const std::vector<int>& nodes, DofMap& dofs) {
    for (const int node : nodes) dofs.fix(field, node);
  }

  // A rigid plate stays level: its height is one unknown, and higher harmonics of it are zero.
  void hold_top(const HarmonicFields& part, DofMap& dofs) const {
    if (!options_.rigid_top) return;
    const std::vector<int> top =
        nodes_on_break(mesh_.section, mesh_.top_row, 0, mesh_.pillar_columns);
    if (part.harmonic == 0) {
      dofs.tie(1, top);
    } else {
      fix_all(part.first_field + 2, top, dofs);
    }
  }

  bool condenses() const {
    return media_.pillar.is_isotropic &&
           media_.pillar.poisson_ratio >= options_.condense_pressures_from;
  }
  bool is_incompressible() const { return std::isinf(media_.pillar.bulk_Pa); }

  // The volume forms of all harmonics, which no pillar couples.
  SymmetricSparse pillar_volume(double bulk_Pa) const {
    SymmetricSparse sum = of_harmonic_.front()->volume_form({bulk_Pa, 0.0}, true);
    for (std::size_t i = 1; i < of_harmonic_.size(); ++i) {
      sum.coeffs() += of_harmonic_[i]->volume_form({bulk_Pa, 0.0}, true).coeffs();
    }
    return sum;
  }

  void factor(StiffnessFactor& factored) const {
    Eigen::MatrixXd pillar = Eigen::MatrixXd::Zero(kRows, kRows);
    pillar.topLeftCorner(6, 6) = condenses() ? Matrix6d(media_.pillar.shear_Pa * deviatoric_form())
                                             : media_.pillar.stiffness_Pa;
    SymmetricSparse matrix =
        system_->form(rows_, {integrated_form(parts_, [&](double) { return pillar; }),
                              integrated_form(parts_, [&](double angle) {
                                return coupled_form(rotated_about_z(*media_.film, angle));
                              })});
    if (!condenses()) return factored.factor(matrix);
    const SymmetricSparse volume = pillar_volume(
        is_incompressible() ? kPenaltyOverShear * media_.pillar.shear_Pa : media_.pillar.bulk_Pa);
    matrix.coeffs() += volume.coeffs();
    factored.factor(matrix);
    if (is_incompressible()) factored.constrain(volume);
  }

  // Higher harmonics vanish on the axis and in the mean over a disc.
  void read_face(const Eigen::VectorXd& u, FilmAnswer& answer) const {
    const Section& section = mesh_.section;
    const int phi = parts_.front().potential();
    const int row = face_break(true);
    const int centre = system_->dofs().dof(phi, section.node(0, row * section.degree()));
    answer.centre_V = scale_V_ * u[centre];
    const Eigen::VectorXd mean = system_->line_load(phi, row, 0, mesh_.pillar_columns);
    answer.mean_V = scale_V_ * mean.dot(u) / mean.sum();
  }

  ModelOptions options_;
  PillarMedia media_;
  PillarMesh mesh_;
  double scale_V_;
  Kinematics kinematics_;
  std::vector<HarmonicFields> parts_;
  std::vector<OperatorRow> rows_;
  int electrode_ = -1;  // handle
  std::unique_ptr<DiscreteSystem> system_;
  std::vector<std::unique_ptr<DiscreteSystem>> of_harmonic_;  // same unknowns, own divergence
};

}  // namespace

FilmAnswer directional_static(const PillarGeometry& geometry, const Discretisation& mesh,
                              const PillarMedia& media, const ModelOptions& options,
                              int highest_harmonic) {
  if (options.motion != Motion::kLongitudinal || !options.electrodes || !media.film) {
    throw std::invalid_argument("a film with a direction needs electrodes and a round pillar");
  }
  return DirectionalModel(geometry, mesh, media, options, highest_harmonic).answer();
}

}  // namespace viscard
