#pragma once

#include <filesystem>

namespace viscard {

// The capture that a new one replaces. It stays beside the new one until drop() is called, and is
// restored by the destructor if that never happens: a cable that is not plugged in, or a punch that
// presses already, must not destroy yesterday's record.
class PreviousCapture {
 public:
  // Puts the file aside if there is one to replace. Throws std::runtime_error if an earlier capture
  // is still aside.
  PreviousCapture(std::filesystem::path path, bool is_replaced);
  ~PreviousCapture();
  PreviousCapture(const PreviousCapture&) = delete;
  PreviousCapture& operator=(const PreviousCapture&) = delete;

  bool is_aside() const { return is_aside_; }
  // Removes the old capture for good.
  void drop();

 private:
  std::filesystem::path part(const char* suffix) const;
  std::filesystem::path aside(const char* suffix) const;

  std::filesystem::path path_;
  bool is_aside_ = false;
};

}  // namespace viscard
