#pragma once

#include <functional>
#include <string>
#include <vector>

namespace viscard::peers {

// Numbers of a whole answer, each with its error estimate (an absolute value).
struct Answer {
  std::vector<double> value;
  std::vector<double> error;
};

// A question to the pillar solver: geometry and media in, numbers out. The time includes meshes,
// matrices, factorisations, solutions, and the error estimate if the scene asks for one.
struct AnswerCase {
  std::string name;
  std::function<Answer()> run;
};
std::vector<AnswerCase> answer_cases();

}  // namespace viscard::peers
