#include "rig/emulator/faulty_lane.h"

#include <algorithm>
#include <utility>

namespace viscard {
namespace {

constexpr double kLongestSplit_s = 0.02;

}  // namespace

void FaultyLane::push(std::string bytes, double due_s) {
  if (!pieces_.empty()) due_s = std::max(due_s, pieces_.back().due_s);
  pieces_.push_back({due_s, std::move(bytes)});
}

void FaultyLane::corrupt(std::string& bytes, FaultCounts& counts) {
  if (happens(rates_.drop, counts)) {
    const std::size_t at = below(bytes.size());
    bytes.erase(at, 1 + below(8));
    ++counts.corrupted;
  }
  if (!bytes.empty() && happens(rates_.garble, counts)) {
    char& c = bytes[below(bytes.size())];
    const bool is_digit = c >= '0' && c <= '9';
    c = static_cast<char>(is_digit ? '0' + static_cast<char>(below(10)) : c ^ (1 << below(8)));
    ++counts.corrupted;
  }
  if (happens(rates_.insert, counts)) {
    std::string noise(1 + below(8), '\0');
    for (char& c : noise) c = static_cast<char>(below(256));
    bytes.insert(bytes.empty() ? 0 : below(bytes.size()), noise);
    ++counts.corrupted;
  }
}

void FaultyLane::take(std::string bytes, double now_s, FaultCounts& counts) {
  ++counts.pieces;
  if (happens(rates_.hang_up, counts)) wants_hang_up_ = true;
  corrupt(bytes, counts);
  if (bytes.empty()) return;
  if (happens(rates_.delay, counts)) now_s += upto(longest_delay_s_);
  if (happens(rates_.split, counts) && bytes.size() > 1) {
    const std::size_t at = 1 + below(bytes.size() - 1);
    push(bytes.substr(0, at), now_s);
    push(bytes.substr(at), now_s + upto(kLongestSplit_s));
  } else {
    push(bytes, now_s);
  }
  if (happens(rates_.duplicate, counts)) push(bytes, now_s);
}

std::string FaultyLane::due(double now_s) {
  std::string bytes;
  while (!pieces_.empty() && pieces_.front().due_s <= now_s) {
    bytes += pieces_.front().bytes;
    pieces_.pop_front();
  }
  return bytes;
}

}  // namespace viscard
