#pragma once

#include "models/maths/failure_text.h"

#include <cstddef>
#include <functional>

namespace viscard {

// Thrown by a progress callback to end the work at a user's request.
class Interrupted : public StopsWork {
 public:
  Interrupted() : StopsWork("the work was interrupted") {}
};

// Calls work(i) for i = 0 ... n - 1 on all cores that this process may use and waits for all of them. If some calls throw,
// the exception of the smallest i is rethrown once all have ended. After StopsWork no further call
// begins.
void for_each_in_parallel(std::size_t n, const std::function<void(std::size_t)>& work);

}  // namespace viscard
