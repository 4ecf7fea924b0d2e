"""Sections of pillars for FreeFEM: meshes of triangles graded to every corner, and scripts of quadratic elements.

Lengths are in um, stresses in MPa, densities in g/um3 * 1e6 (so that a frequency squared is in 1/s2); potentials are in
units that make permittivities as large as moduli. Family m of motion, with theta the angle about the axis: (u cos(m theta),
v sin(m theta), w cos(m theta)), potential f cos(m theta).
"""
import math
import os
import subprocess

EPS0 = 8.8541878128e-12


def graded(breaks, sharp, finest, ratio):
    """A line through `breaks` whose elements shrink by `ratio` toward those that are sharp, down to the share `finest`."""
    points = [breaks[0]]
    for a, b in zip(breaks, breaks[1:]):
        span = b - a
        ends = [a in sharp, b in sharp]
        near = [ratio ** k for k in range(1, 1 + math.ceil(math.log(finest) / math.log(ratio)))]
        half = 0.5 if all(ends) else 1.0
        cut = {0.0, 1.0}
        if ends[0]:
            cut |= {half * d for d in near} | {half}
        if ends[1]:
            cut |= {1.0 - half * d for d in near} | {1.0 - half}
        cuts = sorted(cut)
        most = (1.0 - ratio) / 5.0  # of the span; smooth parts need elements too
        for s, e in zip(cuts, cuts[1:]):
            n = max(1, math.ceil((e - s) / most))
            points += [a + span * (s + (e - s) * (i + 1) / n) for i in range(n)]
    return points


# The smallest element over the length of its line, and the ratio of neighbouring elements: coarse and fine.
LEVELS = (5e-5, 0.45), (1e-5, 0.6)
CHEAP = (1e-3, 0.36), (2e-4, 0.45)       # for a dozen complex solutions to a number
BLUNT = (5e-3, 0.45), (2e-3, 0.6)        # no local modes of the rim of the bond below those of the pillar


class Section:
    """A pillar of radius R and length L on a film (thickness t, radius Rf) or on a rigid base (t = 0).

    Labels of edges: 10 held bottom within `inner`, 11 beyond; 20 and 21 likewise on the film's top; 30 the top.
    """
    def __init__(self, R, L, t=0.0, Rf=0.0, inner=None, first=0.0, pillars=None, smooth=None):
        self.R, self.L, self.t, self.Rf, self.first = R, L, t, Rf, first
        self.inner = inner or []    # ends of electrodes, in pairs
        self.smooth = smooth or []  # ends of elements only
        self.pillars = pillars or [(first, R)]  # from, to

    def write(self, path, level):
        finest, ratio = level
        feet = [x for pair in self.pillars for x in pair if x > self.first or self.first < 0.0]
        right = self.Rf if self.t > 0.0 else self.R
        xs_sharp = (set(feet) | set(self.inner) | {right, self.first}) - {0.0}
        xs = graded(sorted(xs_sharp | {self.first, right} | set(self.smooth)), xs_sharp, finest, ratio)
        shaft = min(self.L, 2.5 * self.R)
        zs = graded([0.0, shaft], {0.0}, finest, ratio)
        n = max(1, math.ceil((self.L - shaft) / (0.2 * shaft * (1.0 - ratio))))
        zs += [shaft + (self.L - shaft) * (i + 1) / n for i in range(n)] if self.L > shaft else []
        below = graded([-self.t, 0.0], {-self.t, 0.0}, finest, ratio) if self.t > 0.0 else []
        zs = below[:-1] + zs
        stands = lambda x: any(a < x < b for a, b in self.pillars)
        used, cells, edges = {}, [], []
        number = lambda i, j: used.setdefault((i, j), len(used) + 1)
        for i in range(len(xs) - 1):
            x = 0.5 * (xs[i] + xs[i + 1])
            within = 0 if not self.inner else int(not any(
                a < x < b for a, b in zip(self.inner[::2], self.inner[1::2])))
            for j in range(len(zs) - 1):
                is_film = zs[j + 1] <= 1e-12
                if not is_film and not stands(x):
                    continue
                a, b, c, d = number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)
                cells += [(a, b, c, 2 if is_film else 1), (a, c, d, 2 if is_film else 1)]
                if j == 0:
                    edges.append((a, b, 10 + within))
                if is_film and abs(zs[j + 1]) < 1e-12:
                    edges.append((d, c, 20 + within))
                if j == len(zs) - 2:
                    which = next(k for k, (p, q) in enumerate(self.pillars) if p < x < q)
                    edges.append((d, c, 30 + which))
        with open(path, "w", encoding="ascii") as file:
            file.write(f"{len(used)} {len(cells)} {len(edges)}\n")
            for (i, j) in used:  # in the order of their numbers
                file.write(f"{xs[i]:.17g} {zs[j]:.17g} 0\n")
            for a, b, c, region in cells:
                file.write(f"{a} {b} {c} {region}\n")
            for a, b, label in edges:
                file.write(f"{a} {b} {label}\n")


HEAD = """
cout.precision(15);
mesh Th = readmesh("{mesh}");
fespace V0(Th, P0);
V0 film = (region == 2);
fespace Vh(Th, {elements});
real m = {m}, pressing = {pressing}, axis = {axis};  // axis: 1 about an axis, 0 in the plane
func radius = axis*x + 1 - axis;
macro hoop(u, v) (axis*(u + m*v)/radius) //
macro tr(u, v, w) (dx(u) + hoop(u, v) + dy(w)) //
macro twist(u, v) (dx(v) - axis*(v + m*u)/radius) //
macro across(v, w) (dy(v) - axis*m*w/radius) //
macro shear(u, v, w, uu, vv, ww) (2*(dx(u)*dx(uu) + hoop(u, v)*hoop(uu, vv) + dy(w)*dy(ww))
  + (dy(u) + dx(w))*(dy(uu) + dx(ww)) + twist(u, v)*twist(uu, vv) + across(v, w)*across(vv, ww)) //
macro elastic(u, v, w, uu, vv, ww) (radius*(la*tr(u, v, w)*tr(uu, vv, ww) + mu*shear(u, v, w, uu, vv, ww))) //
"""

# Potential f and its test function ff, with the constants of the film in e31, e33, e15, k11, k33.
ELECTRIC = """
V0 la = {la_film}*film + {la}*(1 - film), mu = {mu_film}*film + {mu}*(1 - film);
V0 e31 = {e31}*film, e33 = {e33}*film, e15 = {e15}*film;
V0 k11 = {k11}*(film + 1e-10*(1 - film)), k33 = {k33}*(film + 1e-10*(1 - film));
macro couple(u, v, w, ff) (radius*((e31*(dx(u) + hoop(u, v)) + e33*dy(w))*dy(ff)
  + e15*((dy(u) + dx(w))*dx(ff) - across(v, w)*axis*m*ff/radius))) //
macro field(f, ff) (radius*(k11*(dx(f)*dx(ff) + axis*m^2*f*ff/radius^2) + k33*dy(f)*dy(ff))) //
Vh [u, v, w, f], [uu, vv, ww, ff];
varf whole([u, v, w, f], [uu, vv, ww, ff]) = int2d(Th, qforder = 6)(elastic(u, v, w, uu, vv, ww)
  + couple(u, v, w, ff) + couple(uu, vv, ww, f) - field(f, ff));
varf held([u, v, w, f], [uu, vv, ww, ff]) = on(10, 11, u = 0, v = 0, w = 0) + on({ground}, f = 0) + on({electrode}, f = 0);
varf electrode([u, v, w, f], [uu, vv, ww, ff]) = on({electrode}, f = 1);
varf press([u, v, w, f], [uu, vv, ww, ff]) = int1d(Th, 30)(radius*pressing*((m != 0)*(uu - vv) - (m == 0)*ww));
matrix A0 = whole(Vh, Vh), Bc = held(Vh, Vh, tgv = 1e30), A = A0 + Bc;
set(A, solver = sparsesolver);
real[int] on1 = electrode(0, Vh, tgv = 1), b = press(0, Vh), r = b;
u[] = A^-1*b;
r = A0*u[];
cout << "= charge " << -(r'*on1) << endl;
real top = int1d(Th, 30)(radius*((m == 0)*w + (m != 0)*0.5*(u - v)))/int1d(Th, 30)(radius);
cout << "= moved " << top << endl;
"""

DRIVEN = """
b = on1;
b = 1e30*b;
u[] = A^-1*b;
r = A0*u[];
cout << "= capacitance " << -(r'*on1) << endl;
top = int1d(Th, 30)(radius*w)/int1d(Th, 30)(radius);
cout << "= driven " << top << endl;
"""

# Moduli that depend on s: muP(i), laP(i), and dense = rho s^2. Prints the motion by a load, or the force at a motion.
OF_S = """
V0<complex> la, mu;
Vh<complex> [u, v, w], [uu, vv, ww];
complex dense;
V0 heavy = {rho_film}*film + {rho}*(1 - film);
varf whole([u, v, w], [uu, vv, ww]) = int2d(Th, qforder = 6)(elastic(u, v, w, uu, vv, ww)
  + dense*radius*heavy*(u*uu + v*vv + w*ww));
varf held([u, v, w], [uu, vv, ww]) = on(10, 11, u = 0, v = 0, w = 0);
varf lid([u, v, w], [uu, vv, ww]) = on(30, w = 1);
varf press([u, v, w], [uu, vv, ww]) = -int1d(Th, 30)(radius*ww);
varf shake([u, v, w], [uu, vv, ww]) = int2d(Th, qforder = 6)(-dense*radius*heavy*(uu - vv));
func int answer(int number, complex laP, complex muP, complex laF, complex muF, complex rhoS2) {
  la = laF*film + laP*(1 - film);
  mu = muF*film + muP*(1 - film);
  dense = rhoS2;
  matrix<complex> A0 = whole(Vh, Vh), Bc = held(Vh, Vh, tgv = 1e30), A = A0 + Bc;
  complex[int] b(Vh.ndof), r(Vh.ndof), one = lid(0, Vh, tgv = 1);
  b = {load}(0, Vh);
  if ({moved}) {
    matrix<complex> Lid = lid(Vh, Vh, tgv = 1e30);
    A = A + Lid;
    b = 1e30*one;
  }
  set(A, solver = sparsesolver);
  u[] = A^-1*b;
  r = A0*u[];
  complex found = {moved} ? complex(one'*r) : int1d(Th, 30)(radius*((m == 0)*w + (m != 0)*0.5*(u - v)))/int1d(Th, 30)(radius);
  cout << "= s" << number << " " << real(found) << " " << imag(found) << endl;
  return 0;
}
"""

MODES = """
V0 la = {la_film}*film + {la}*(1 - film), mu = {mu_film}*film + {mu}*(1 - film), rho = {rho_film}*film + {rho}*(1 - film);
Vh [u, v, w], [uu, vv, ww];
varf whole([u, v, w], [uu, vv, ww]) = int2d(Th, qforder = 6)(elastic(u, v, w, uu, vv, ww))
  + on(10, 11, u = 0, v = 0, w = 0);
varf mass([u, v, w], [uu, vv, ww]) = int2d(Th, qforder = 6)(radius*rho*(u*uu + v*vv + w*ww));
matrix K = whole(Vh, Vh, solver = sparsesolver), M = mass(Vh, Vh);
real[int] squares(4);
Vh[int] [shape, turn, rise](4);
int got = EigenValue(K, M, sym = true, sigma = 0, value = squares, vector = shape, nev = 4, tol = 1e-10);
for (int i = 0; i < 4; i++) {
  real twisted = int2d(Th)(radius*turn[i]^2)/int2d(Th)(radius*(shape[i]^2 + turn[i]^2 + rise[i]^2));
  cout << "= " << (twisted > 0.99 ? "torsion" : "mode") << i << " " << sqrt(squares[i])/(2*pi) << endl;
}
"""

BUCKLE = """
V0 la = {la_film}*film + {la}*(1 - film), mu = {mu_film}*film + {mu}*(1 - film);
Vh [us, vs, ws], [u, v, w], [uu, vv, ww];
varf whole([u, v, w], [uu, vv, ww]) = int2d(Th, qforder = 6)(elastic(u, v, w, uu, vv, ww))
  + on(10, 11, u = 0, v = 0, w = 0);
varf press([u, v, w], [uu, vv, ww]) = -int1d(Th, 30)(radius*ww);
m = 0;
matrix K = whole(Vh, Vh, solver = sparsesolver);
real[int] b = press(0, Vh);
us[] = K^-1*b;
macro all() (la*(dx(us) + us/x + dy(ws))) //
macro turns(u, v, w, uu, vv, ww) ((all + 2*mu*dx(us))*(dx(u)*dx(uu) + dx(v)*dx(vv) + dx(w)*dx(ww))
  + (all + 2*mu*us/x)*((u + v)*(uu + vv)*2 + w*ww)/x^2
  + (all + 2*mu*dy(ws))*(dy(u)*dy(uu) + dy(v)*dy(vv) + dy(w)*dy(ww))
  + mu*(dy(us) + dx(ws))*(dx(u)*dy(uu) + dy(u)*dx(uu) + dx(v)*dy(vv) + dy(v)*dx(vv) + dx(w)*dy(ww) + dy(w)*dx(ww))) //
varf stress([u, v, w], [uu, vv, ww]) = int2d(Th, qforder = 6)(-x*turns(u, v, w, uu, vv, ww));
m = 1;
K = whole(Vh, Vh, solver = sparsesolver);
matrix S = stress(Vh, Vh);
[u, v, w] = [y^2, -y^2, -2*x*y];
real p = 0;
for (int i = 0; i < 40; i++) {
  b = S*u[];
  uu[] = K^-1*b;
  p = (u[]'*u[])/(u[]'*uu[]);
  u[] = uu[]/uu[].linfty;
}
cout << "= buckling " << p << endl;
"""

STEPS = """
V0 la = {la}, mu = {mu}, rho = {rho};
Vh [u, v, w], [uu, vv, ww];
int steps = {steps};
real dt = {end}/steps, peak = 0;
varf whole([u, v, w], [uu, vv, ww]) = int2d(Th, qforder = 6)(elastic(u, v, w, uu, vv, ww));
varf mass([u, v, w], [uu, vv, ww]) = int2d(Th, qforder = 6)(radius*rho*(u*uu + v*vv + w*ww));
varf held([u, v, w], [uu, vv, ww]) = on(10, 11, u = 0, v = 0, w = 0);
varf press([u, v, w], [uu, vv, ww]) = -int1d(Th, 30)(radius*ww);
matrix K = whole(Vh, Vh), M = mass(Vh, Vh), H = held(Vh, Vh, tgv = 1e30), A = M + (dt^2/4)*K;
A = A + H;
set(A, solver = sparsesolver);
real[int] force = press(0, Vh), d(Vh.ndof), q(Vh.ndof), g(Vh.ndof), a(Vh.ndof), b(Vh.ndof);
d = 0; q = 0; a = 0;
for (int i = 1; i <= steps; i++) {  // Newmark, average acceleration
  g = d + dt*q; g += (dt^2/4)*a;
  b = K*g; b = -1.*b; b += ({height}*(i*dt < {duration} ? sin(pi*i*dt/{duration}) : 0.))*force;
  q += (dt/2)*a;
  a = A^-1*b;
  q += (dt/2)*a;
  d = g + (dt^2/4)*a;
  u[] = d;
  real now = int1d(Th, 30)(radius*w)/int1d(Th, 30)(radius);
  if (abs(now) > abs(peak)) peak = now;
  if (i == steps) cout << "= end " << now << endl;
}
cout << "= peak " << peak << endl;
"""


class Film:
    """Constants of a transversely isotropic film on an isotropic elasticity, in the units of this module."""
    def __init__(self, E_Pa, nu, d=None, permittivity=None):
        self.mu = E_Pa / (2 * (1 + nu)) / 1e6
        self.la = E_Pa * nu / ((1 + nu) * (1 - 2 * nu)) / 1e6
        self.volt = 1.0
        if d is None:
            return
        c11, c12, c44 = E_Pa * (1 - nu) / ((1 + nu) * (1 - 2 * nu)), self.la * 1e6, self.mu * 1e6
        e31 = d["d31"] * (c11 + c12) + d["d33"] * c12
        e33 = 2 * d["d31"] * c12 + d["d33"] * c11
        e15 = d.get("d15", 0.0) * c44
        k33 = permittivity[2] * EPS0 - 2 * d["d31"] * e31 - d["d33"] * e33
        k11 = permittivity[0] * EPS0 - d.get("d15", 0.0) * e15
        self.volt = 1e-6 * math.sqrt(c11 / k33)  # a unit of potential, in V
        per_m, stress = self.volt / 1e-6, 1e6
        self.e31, self.e33, self.e15 = (e * per_m / stress for e in (e31, e33, e15))
        self.k11, self.k33 = (k * per_m ** 2 / stress for k in (k11, k33))

    def charge_C(self, value):
        """A charge in the units of this module (energy over potential), without the integral over the angle."""
        return value * 1e6 * 1e-18 / self.volt


def run(script, folder, name):
    """The numbers that a script prints as lines "name value"; complex ones as "name real imaginary"."""
    path = os.path.join(folder, name + ".edp")
    with open(path, "w", encoding="ascii") as file:
        file.write(script)
    done = subprocess.run(["FreeFem++", "-v", "0", "-nw", path], capture_output=True, text=True, cwd=folder, check=False,
                          env=dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1"))
    found = {}
    for line in done.stdout.splitlines():
        words = line.split()
        if len(words) >= 3 and words[0] == "=":
            values = [float(w) for w in words[2:]]
            found[words[1]] = values[0] if len(values) == 1 else complex(*values)
    if done.returncode != 0 or not found:
        raise RuntimeError(f"FreeFem++ failed on {path}:\n{done.stdout[-2000:]}{done.stderr[-500:]}")
    return found
