# viscard 0.2.0: PDMS for FEniCS dolfinx (Python module)
# CANNOT REPRESENT: large strains, a shift with temperature; strain is taken as linear in each step
# units: mm-t-s (mm, t, s, N, MPa, t/mm3)
# conventions: instantaneous E, nu; branches relative (g_i = G_i/G_0); time tau; bulk relaxes with its own k_i
# E0 (instantaneous) = 1.88 MPa, E_inf (long-term) = 1.83851592 MPa
# K0 = 62.66666667 MPa from nu = 0.495 (assumed)
# rho = 9.65e-10 t/mm3
# terms: exact, 2
# bulk: exact, relaxes with its own k_i (assumed)
# numbers: exact
# density: exact
# valid: 0.0125 s to 60 s, strain up to 0.05, temperature not stated
# tests behind it: 1
# raw data run.viscap sha256 aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa
# card sha256 9f6439626805d709e9c971c0c780377a29433627dce1ca0052be5bb9603ef613
# Import it; see ufl_stress for the form of a step, and the one-element model (--deck) for the loop.
import numpy as np

name = "PDMS"
E0 = 1.88
nu = 0.495
rho = 9.65e-10
g = [0.008206, 0.01386]
k = [0.008206, 0.01386]
tau = [0.1945, 2.403]

G0 = E0 / (2.0 * (1.0 + nu))
K0 = E0 / (3.0 * (1.0 - 2.0 * nu))
G_inf = G0 * (1.0 - sum(g))
K_inf = K0 * (1.0 - sum(k))


def elastic(G, K, strain):
    """Stress of strains of shape (points, 3, 3)."""
    trace = np.trace(strain, axis1=1, axis2=2)[:, None, None] * np.eye(3)
    return 2.0 * G * (strain - trace / 3.0) + K * trace


def decay(dt):
    """Of each branch: what a step keeps of its stress, and the mean of its decay in the step."""
    x = dt / np.array(tau)
    return np.exp(-x), -np.expm1(-x) / x


def step_moduli(dt):
    """Shear and bulk modulus that act on the strain at the end of a step."""
    mean = decay(dt)[1]
    return G_inf + G0 * np.dot(g, mean), K_inf + K0 * np.dot(k, mean)


class Memory:
    """The branches at all points: the stress at the end of a step is that of step_moduli(dt) for
    the strain there, plus known_stress(dt). Exact for strain that is linear in each step."""

    def __init__(self, points):
        self.strain = np.zeros((points, 3, 3))
        self.branches = np.zeros((len(tau), points, 3, 3))

    def known_stress(self, dt):
        kept, mean = decay(dt)
        stress = np.zeros_like(self.strain)
        for i, branch in enumerate(self.branches):
            at_rest = elastic(G0 * g[i] * mean[i], K0 * k[i] * mean[i], self.strain)
            stress += kept[i] * branch - at_rest
        return stress

    def advance(self, dt, strain):
        kept, mean = decay(dt)
        for i, branch in enumerate(self.branches):
            rise = elastic(G0 * g[i] * mean[i], K0 * k[i] * mean[i], strain - self.strain)
            self.branches[i] = kept[i] * branch + rise
        self.strain = strain.copy()

    def stress(self):
        return elastic(G_inf, K_inf, self.strain) + self.branches.sum(axis=0)


# dolfinx: UFL stress of a step. G, K are fem.Constant, set by step_moduli(dt) before each solve;
# known is a fem.Function of a tensor space of degree p - 1, discontinuous, its values set to
# Memory.known_stress(dt).ravel(). After the solve: Memory.advance(dt, strain at those points).
def ufl_stress(strain, G, K, known):
    import ufl

    return 2.0 * G * ufl.dev(strain) + K * ufl.tr(strain) * ufl.Identity(3) + known
