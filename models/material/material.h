#pragma once

#include "models/material/prony_series.h"
#include "models/material/temperature_shift.h"
#include "models/maths/interval.h"

#include <Eigen/Core>

#include <complex>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace viscard {

class ResultVisitor;

// The one internal description of a viscoelastic solid, SI:
//   G(t) = G_0 [1 - sum g_i (1 - exp(-t/tau_i))],  K(t) likewise with k_i   (eq. 7)
// where G_0 and K_0 follow from the instantaneous E_0 and nu. k_i = g_i keeps the Poisson ratio
// constant (the default, and then E relaxes with the same g_i); k_i = 0 keeps the bulk modulus.
struct MaterialTerm {
  double g = 0.0;      // shear, relative to G_0
  double k = 0.0;      // bulk, relative to K_0
  double tau_s = 0.0;  // > 0
};

// Of one material: a series of 100 decades with ten terms in each.
inline constexpr std::size_t kMostMaterialTerms = 1000;

// Uncertainty of one term from the fit.
struct TermUncertainty {
  double modulus_se_Pa = 0.0;
  double ln_tau_se = 0.0;
  Interval modulus_Pa_95, g_95, tau_s_95;
};

// Changes by one standard deviation of one systematic cause (frame, load cell, geometry), all of
// them together: for example, a frame that is softer than believed raises E0 and all g. Relative
// changes, with their signs.
struct SystematicPart {
  std::string cause;
  double E0 = 0.0;             // relative change
  std::vector<double> g, tau;  // as Material::terms; missing ones are 0
};

// Uncertainty of the material from the fit; absent for a material typed in by hand.
struct MaterialUncertainty {
  Interval E0_Pa_95, E_inf_Pa_95;
  std::vector<TermUncertainty> terms;              // as Material::terms
  std::vector<std::string> covariance_parameters;  // of the rows: "E_inf_Pa", "E_1_Pa", "ln_tau_1"
  Eigen::MatrixXd covariance;                      // square, in the units that the names state
  double systematic_relative = 0.0;  // of E0, by geometry, calibration and frame together
  // Its causes, independent of each other. Empty: one that scales all moduli together.
  std::vector<SystematicPart> systematic_parts;
};

// The range in which the data support the description.
struct ValidityWindow {
  double t_min_s = 0.0;
  double t_max_s = 0.0;     // 0: unknown
  double strain_max = 0.0;  // 0: unknown
};

// An identifiability flag: something that the data do not determine. Cards annotate or refuse
// flagged terms.
struct MaterialFlag {
  std::string name;  // short and stable, e.g. "tau-below-sampling"
  int term = 0;      // 1-based; 0 for the whole material
  std::string text;  // a sentence for a person
};
void show_keys(ResultVisitor& v, const MaterialFlag& flag);
// True for a flag that makes the whole fit untrustworthy. Cards refuse it like a flagged term.
bool is_defect(const std::string& flag_name);
// True for a flag of how a record was made or read, which holds for every fit that the record is part of. Others
// are about what one fit determines in its window, which other tests may cover, and how well it describes its rows.
bool is_about_record(const std::string& flag_name);

// A file of measured data.
struct RawFile {
  std::string path;
  std::string sha256;
};

// Where a material comes from.
struct Provenance {
  std::string created_by;  // "viscard 0.1.0"
  std::string created_at;  // ISO 8601, empty in reproducible mode
  std::string command;     // command line
  std::vector<RawFile> raw_files;
  double fit_from_s = 0.0, fit_to_s = 0.0;  // fit window
  std::string nu_origin = "assumed";        // assumed | stated | measured
  std::string bulk_origin = "assumed";
};

// A linear viscoelastic solid or liquid: instantaneous modulus, Poisson ratio and Prony terms.
struct Material {
  std::string name;
  double E0_Pa = 0.0;
  double nu = 0.0;
  double rho_kg_m3 = 0.0;  // 0: not given
  std::vector<MaterialTerm> terms;
  double mixing_ratio = 0.0;  // parts of base to one of curing agent; 0: not given
  std::string specimen_id;    // of the specimen it was measured on; empty: not known
  std::optional<double> T_ref_C;
  std::optional<TemperatureShift> shift;  // of all times together, relative to T_ref_C
  ValidityWindow valid;
  std::optional<MaterialUncertainty> uncertainty;
  std::vector<MaterialFlag> flags;
  Provenance provenance;
};

// Throws std::invalid_argument naming the value: E0 not positive, nu outside (-1, 0.5], density
// negative, a g or k negative or not finite, tau not positive, sum g or sum k above 1 (sum g = 1 is
// a liquid, see liquid.h), a shift whose reference is not T_ref_C.
void validate(const Material& material);

// True when every k_i equals its g_i (constant Poisson ratio).
bool has_constant_poisson_ratio(const Material& material);

// The moduli that cards and solvers use, derived in this one place (eq. 7). K_0 is infinite at
// nu = 0.5, and the bulk series is then empty.
struct DerivedModuli {
  double E0_Pa = 0.0, E_inf_Pa = 0.0;
  double G0_Pa = 0.0, G_inf_Pa = 0.0;
  double K0_Pa = 0.0, K_inf_Pa = 0.0;
  double nu_inf = 0.0;  // long-term Poisson ratio
  double sum_g = 0.0, sum_k = 0.0;
  std::vector<double> G_Pa, K_Pa;     // branch moduli g_i G_0, k_i K_0
  std::vector<double> E_Pa;           // g_i E_0: a branch's share of E_0 at the Poisson ratio nu
  double E_rest_Pa = 0.0;             // (1 - sum g_i) E_0: the share that never relaxes
  std::vector<double> beta_1_s;       // 1/tau_i
  std::vector<double> norton_1_Pa_s;  // 1/(3 G_i tau_i): creep rate per von Mises stress
};
DerivedModuli derived_moduli(const Material& material);

PronySeries shear_series(const Material& material);  // G(t)
// E(t). With constant Poisson ratio the terms carry over; otherwise E(t) follows from G and K by
// 9KG/(3K + G) in the Laplace domain, which again gives a Prony series (eq. 7b).
PronySeries young_series(const Material& material);

// Relative shear (share = &MaterialTerm::g) or bulk (k) modulus in the Laplace domain,
//   M~(s) = s M^(s)/M_0 = 1 - sum m_i + sum m_i s tau_i/(1 + s tau_i)   (eq. 2 at s = i omega),
// written so that neither s tau = 1e12 nor 1e-12 loses digits.
std::complex<double> relative_modulus(const std::vector<MaterialTerm>& terms,
                                      double MaterialTerm::*share, std::complex<double> s);
// The range of the relaxation times of terms that relax; infinity and 0 without any.
struct RelaxationTimes {
  double fastest_s = 0.0, slowest_s = 0.0;
};
RelaxationTimes relaxation_times(const std::vector<MaterialTerm>& terms);

// Moduli in the Laplace domain over the instantaneous ones.
struct RelativeModuli {
  // Pure numbers.
  std::complex<double> shear, bulk;
};
// Both by relative_modulus() at s in 1/s.
RelativeModuli relative_moduli(const std::vector<MaterialTerm>& terms, std::complex<double> s);

}  // namespace viscard
