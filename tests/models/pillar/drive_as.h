#pragma once

namespace viscard::test {

// The drive of a scene as one of its alternatives; throws if it is another.
template <typename Drive, typename Scene>
auto& as(Scene& scene) {
  return std::get<Drive>(scene.drive);
}

}  // namespace viscard::test
