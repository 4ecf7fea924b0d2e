#pragma once

namespace viscard {

// When the records of a capture must be synced so that a power cut loses at most `interval_s`.
// Times are in s on any clock that does not jump.
// A sync protects the records appended before it began, and only once it has ended. At worst the
// records between the begin of one sync and the end of the next are lost. A slow disk must
// therefore be synced earlier, by the duration of its last sync. If one sync takes more than half
// of the interval, syncs follow each other without a pause, and twice that time may be lost.
class SyncSchedule {
 public:
  // poll_s: how often is_due() is asked.
  SyncSchedule(double interval_s, double poll_s, double now_s)
      : interval_s_(interval_s), poll_s_(poll_s), begun_s_(now_s) {}

  bool is_due(double now_s) const {
    return now_s - begun_s_ >= interval_s_ - poll_s_ - duration_s_;
  }
  void synced(double begun_s, double ended_s) {
    begun_s_ = begun_s;
    duration_s_ = ended_s - begun_s;
  }

 private:
  double interval_s_, poll_s_;
  double begun_s_;           // of the last sync
  double duration_s_ = 0.0;  // of the last sync
};

}  // namespace viscard
