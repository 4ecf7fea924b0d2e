#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace viscard {

// What each result in the folder of a demo was made from, as sums, in the file demo.record.json beside them. Times of
// files do not show which inputs a result had, nor whether the step that made it ended.
class DemoRecord {
 public:
  // Reads the record of an earlier demo, if there is one.
  explicit DemoRecord(const std::filesystem::path& folder);

  // True if the result is what a finished step made from inputs with this sum, unchanged since.
  bool is_up_to_date(const std::filesystem::path& result, const std::string& made_from) const;
  // True if a step of a demo has written the result, or begun to.
  bool knows(const std::filesystem::path& result) const;
  // Notes that a step begins to write the result, and that it has done so.
  void begin(const std::filesystem::path& result);
  void finish(const std::filesystem::path& result, const std::string& made_from);

 private:
  struct Made {
    std::string from;    // sum of the inputs; empty: the step has not ended
    std::string sha256;  // of the result
  };
  void write() const;
  std::filesystem::path file_;
  std::map<std::string, Made> made_;  // by the name of the result
};

// One sum of the contents of all inputs, of this program, and of other settings that results depend on.
std::string sum_of_inputs(const std::vector<std::filesystem::path>& inputs,
                          const std::string& settings);

}  // namespace viscard
