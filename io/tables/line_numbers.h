#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace viscard {

// The line of the file of each row of a table. Rows of successive lines, as nearly all are, take one
// entry together: ten million numbers would take 40 MB.
class LineNumbers {
 public:
  // The next row stands on this line, counted from 1.
  void push_back(std::uint32_t line) {
    if (runs_.empty() || line != next_) runs_.push_back({size_, line});
    next_ = line + 1;
    ++size_;
  }
  // O(log of the number of runs).
  std::uint32_t operator[](std::size_t row) const {
    const auto after =
        std::upper_bound(runs_.begin(), runs_.end(), row,
                         [](std::size_t at, const Run& run) { return at < run.row; });
    const Run& run = *(after - 1);
    return run.line + static_cast<std::uint32_t>(row - run.row);
  }
  std::uint32_t front() const { return runs_.front().line; }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  void clear() { *this = LineNumbers(); }
  std::vector<std::uint32_t> all() const {
    std::vector<std::uint32_t> lines;
    for (std::size_t row = 0; row < size_; ++row) lines.push_back((*this)[row]);
    return lines;
  }

 private:
  struct Run {
    std::size_t row;  // the first
    std::uint32_t line;
  };
  std::vector<Run> runs_;
  std::uint32_t next_ = 0;
  std::size_t size_ = 0;
};

}  // namespace viscard
