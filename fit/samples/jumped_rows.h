#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace viscard {

// Rows begin to end - 1.
struct RowRun {
  std::size_t begin = 0, end = 0;
  std::size_t length() const { return end - begin; }
};

// Whether what causes the values goes on as before at both edges of these rows; true for a record of a step.
using RestsBeside = std::function<bool(const RowRun&)>;

// Blocks of at least two rows that jump away and back: by a fifth of the value and a twentieth of the largest one, and
// by eight standard deviations of the noise beside them, within one row on either side, to where the rows before lead; three rows on either side are calm.
// No material does that, with any scatter of the block: a plug was loose, or a converter overflowed. At most a quarter
// of the rows.
std::vector<RowRun> jumped_blocks(std::span<const double> values, const RestsBeside& rests);

// The first of the last rows, at least two and at most half of all, which lie about zero (a tenth of the value before)
// since a single step that is four times as large as the five before it and eight standard deviations: the load is gone.
std::optional<std::size_t> lost_from(std::span<const double> values, const RestsBeside& rests);

}  // namespace viscard
