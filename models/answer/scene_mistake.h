#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace viscard {

// A scene that contradicts itself or is incomplete. `key` is the entry of a scene file that must be
// changed, such as "geometry.electrode.radius", so that the scene reader can report its line.
class SceneMistake : public std::invalid_argument {
 public:
  SceneMistake(std::string key, const std::string& text)
      : std::invalid_argument(text), key_(std::move(key)) {}
  const std::string& key() const { return key_; }

 private:
  std::string key_;
};

// Runs a check of one part of the scene and adds to its error the key of that part in a file.
template <typename Check>
void at_key(const char* key, const Check& check) {
  try {
    check();
  } catch (const SceneMistake&) {
    throw;
  } catch (const std::invalid_argument& error) {
    throw SceneMistake(key, error.what());
  }
}

}  // namespace viscard
