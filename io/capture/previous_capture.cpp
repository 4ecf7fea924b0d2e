#include "io/basics/atomic_file.h"
#include "io/capture/capture_lock.h"

#include <stdexcept>
#include <utility>

namespace viscard {
namespace {

template <class From, class To>
void move_parts(From from, To to) {
  for (const char* suffix : kCaptureParts) {
    if (std::filesystem::exists(from(suffix))) std::filesystem::rename(from(suffix), to(suffix));
  }
}

}  // namespace

PreviousCapture::PreviousCapture(std::filesystem::path path, bool is_replaced)
    : path_(std::move(path)) {
  if (!is_replaced || !std::filesystem::is_regular_file(path_) || is_being_captured(path_)) {
    return;  // the writer reports what is wrong
  }
  if (std::filesystem::exists(aside(""))) {
    throw std::runtime_error(aside("").string() +
                             " is a capture that an earlier --force has kept; move it away");
  }
  rights_ = rights_of_file(path_);
  move_parts([this](const char* suffix) { return part(suffix); },
             [this](const char* suffix) { return aside(suffix); });
  is_aside_ = true;
}

PreviousCapture::~PreviousCapture() {
  if (!is_aside_) return;
  try {
    for (const char* suffix : kCaptureParts) std::filesystem::remove(part(suffix));
    move_parts([this](const char* suffix) { return aside(suffix); },
               [this](const char* suffix) { return part(suffix); });
  } catch (const std::filesystem::filesystem_error&) {
    // The old capture is still there under its other name.
  }
}

void PreviousCapture::drop() {
  if (!is_aside_) return;
  for (const char* suffix : kCaptureParts) std::filesystem::remove(aside(suffix));
  is_aside_ = false;
}

std::filesystem::path PreviousCapture::part(const char* suffix) const {
  return path_.string() + suffix;
}

std::filesystem::path PreviousCapture::aside(const char* suffix) const {
  return path_.string() + ".previous" + suffix;
}

}  // namespace viscard
