#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace viscard {

// Predicts the cost of a run with a given number of unknowns from earlier runs: within one kind of
// elements, processor time is a part that no mesh changes (a contact in time, say) and one that grows
// as a power of the unknowns.
struct CostPower {
  double fixed_s = 0.0;
  double exponent = 0.0;
  double unknowns = 0.0;  // of the largest run that it goes through
  double cpu_s = 0.0;     // of that run, fixed_s included
  double memory_B = 0.0;
  double seconds() const;  // of one unknown, without fixed_s
  double cpu_s_of(double more_unknowns) const;
  double memory_B_of(double more_unknowns) const;
};

class CostModel {
 public:
  struct Run {
    double unknowns = 0.0, cpu_s = 0.0, memory_B = 0.0;
    double size = 0.0;  // of its mesh, in the unit of CostTrial::size
  };
  void add(const std::string& kind, const Run& run);

  // Of a kind that has no run yet, the power of the largest run of any kind; empty before any run.
  std::optional<CostPower> power(const std::string& kind) const;
  // Unknowns of a mesh of that size: in proportion to the nearest run of its kind, or of any kind.
  double unknowns(const std::string& kind, double size) const;
  // Both at once; 0 before any run.
  double cpu_s(const std::string& kind, double size) const;

 private:
  const std::vector<Run>* runs_like(const std::string& kind) const;
  std::map<std::string, std::vector<Run>> runs_;
};

}  // namespace viscard
