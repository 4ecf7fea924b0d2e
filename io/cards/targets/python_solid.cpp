// The numpy part of the cards for SfePy and dolfinx. Recursion of a generalised Maxwell solid,
// exact for strain that is linear in the step: Simo and Hughes, Computational Inelasticity (1998),
// section 10.3.
#include "io/cards/targets/python_solid.h"

#include "io/basics/patterns.h"
#include "io/cards/deck.h"
#include "io/cards/named_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace viscard {
namespace {

constexpr const char* kMemory = R"py(
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
)py";

constexpr const char* kLoop = R"py(
memory = None
time = load = 0.0
for end, steps, goal in blocks:
    dt, start, begin = (end - time) / steps, load, time
    for n in range(1, steps + 1):
        load = start + (goal - start) * n / steps
        known = memory.known_stress(dt) if memory else None
        strain = solve(dt, load * amplitude, known)
        if memory is None:
            memory = Memory(len(strain))
        memory.advance(dt, strain)
        stress = memory.stress()[:, 2, 2].mean()
        response = strain[:, 2, 2].mean() / amplitude if creep else stress / (amplitude * E0)
        print("%.17g,%.17g" % (begin + n * dt, response), flush=True)
    time = end
)py";

}  // namespace

std::string python_solid(const CardBody& body) {
  const CardNumbers& numbers = body.numbers;
  const auto list = [&](const char* name, double CardBranch::*member) {
    return fmt::format("{} = [{}]\n", name, joined(numbers.branches, member, ", "));
  };
  std::string out = fmt::format("import numpy as np\n\nname = \"{}\"\nE0 = {}\nnu = {}\n",
                                body.name, numbers.young, numbers.poisson);
  if (numbers.density > 0.0) out += fmt::format("rho = {}\n", numbers.density);
  out +=
      list("g", &CardBranch::shear) + list("k", &CardBranch::bulk) + list("tau", &CardBranch::time);
  return out + kMemory;
}

void read_python_solid(const std::string& commented, ReadCard& card) {
  const std::string text = without_line_comments(commented, "#");
  const auto name = first_match(text, "(?:^|\\n)name\\s*=\\s*[\"'](\\w*)[\"']");
  if (name) card.name = name->group[1];
  NamedNumbers named;
  const char* row = "^(E0|nu|rho|g|k|tau)\\s*=\\s*(?:\\[([^\\]]*)\\]|([^\\s\\[]+))\\s*$";
  for (const CardLine& line : card_lines(text, "\n")) {
    const auto match = first_match(line.text, row);
    if (!match) continue;
    if (named.count(match->group[1]) > 0) {
      card.add("doubled-number", at_line(line, match->group[1] + " is set a second time"));
    }
    std::vector<double>& list = named[match->group[1]];
    list.clear();
    const std::string& content = match->group[2].empty() ? match->group[3] : match->group[2];
    if (content.empty()) continue;
    for (const std::string& cell : cells(content, ',')) {
      list.push_back(card_number(cell, line, match->group[1]));
    }
  }
  card.numbers.young = one_of(named, "E0");
  card.numbers.poisson = one_of(named, "nu");
  if (named.count("rho") > 0) card.numbers.density = one_of(named, "rho");
  const std::size_t count = named.count("tau") > 0 ? named.at("tau").size() : 0;
  const auto& shear = list_of(named, "g", count);
  const auto& bulk = list_of(named, "k", count);
  for (std::size_t i = 0; i < count; ++i) {
    card.numbers.branches.push_back({shear[i], bulk[i], named.at("tau")[i]});
  }
}

std::string python_test_loop(const DeckInput& input) {
  std::string blocks;
  for (const DeckBlock& block : input.blocks()) {
    blocks += fmt::format("    ({}, {}, {}),\n", block.end, block.increments, block.load);
  }
  return fmt::format(
             "\ncreep = {}\namplitude = {}  # strain, or stress over E0\n# end, steps and load of "
             "each part of the test\nblocks = [\n{}]\n",
             input.is_creep() ? "True" : "False", input.test.amplitude, blocks) +
         kLoop;
}

}  // namespace viscard
