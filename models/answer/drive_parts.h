#pragma once

#include <type_traits>
#include <utility>
#include <variant>

namespace viscard {

// A drive is the load of a scene in one analysis: its loads, history or frequencies. The drives of
// a kind of scene form a std::variant with one struct for each analysis. Equal quantities have
// equal names in all structs, so that other code asks for the part it needs and not for the
// analysis:
//   part_of(drive,
//       [](const auto& d) requires requires { d.pressure_Pa; } { return d.pressure_Pa; }, 0.0)

// True if the current drive has the part that `read` reads.
template <typename Drive, typename Read>
bool has_part(const Drive& drive, const Read&) {
  return std::visit([](const auto& d) { return std::is_invocable_v<const Read&, decltype(d)>; },
                    drive);
}

// The part that `read` reads, or `otherwise` if the current drive has none.
template <typename Drive, typename Read, typename Value>
Value part_of(const Drive& drive, const Read& read, Value otherwise) {
  return std::visit(
      [&](const auto& d) -> Value {
        if constexpr (std::is_invocable_v<const Read&, decltype(d)>) {
          return read(d);
        } else {
          return std::move(otherwise);
        }
      },
      drive);
}

// Runs `write` on the current drive if it has the part that `write` sets; false if it has not.
template <typename Drive, typename Write>
bool set_part(Drive& drive, const Write& write) {
  return std::visit(
      [&](auto& d) {
        constexpr bool kHasPart = std::is_invocable_v<const Write&, decltype(d)>;
        if constexpr (kHasPart) write(d);
        return kHasPart;
      },
      drive);
}

}  // namespace viscard
