#pragma once

#include <optional>
#include <vector>

namespace viscard {

// Notices that the force stops rising while the stage presses on: its motor stands, or the load cell
// has gone blind. In a press from the contact at constant speed v the force on a linear specimen
// rises at v k(t), with its relaxation modulus k, which is never negative and changes gradually. So
// the rise over a tenth of the way is compared with the one two tenths before: it must stay below a
// tenth of that over two stretches that have no reading in common. Only a fluid whose relaxation time
// is below a fifth of the ramp looks like that, too.
class RiseWatch {
 public:
  struct Stretch {
    double from_m = 0.0, to_m = 0.0;
    double rise_N = 0.0;
  };

  // A press from the contact over way_m (0: nothing is judged). least_N: smallest rise of a stretch
  // that others are compared with, many times the noise.
  void begin(double contact_m, double way_m, double step_m, double least_N);
  // The force when the stage was at that position. Returns the stretch without a rise, if there is.
  std::optional<Stretch> take(double position_m, double force_N);

 private:
  struct Point {
    double position_m = 0.0, force_N = 0.0;
  };
  const Point* last_until(double position_m) const;

  double contact_m_ = 0.0;
  double stretch_m_ = 0.0;  // 0: nothing is judged
  double least_N_ = 0.0;
  std::vector<Point> points_;  // ascending
  // Since the rise has stopped: how steep it was, where it stopped, where that was noticed.
  struct Suspicion {
    double usual_N_m = 0.0;
    Point from;
    double noticed_m = 0.0;
  };
  std::optional<Suspicion> suspicion_;
};

}  // namespace viscard
