#pragma once

#include <optional>
#include <string>

namespace viscard {

// What a message between ranks means.
enum class RankTag : int {
  kStart = 1,  // to a worker: the study
  kAsk,        // to the dispatcher: nothing to do
  kAnswer,     // to the dispatcher: an answer, and nothing to do now
  kRefuse,     // to the dispatcher: why this worker cannot answer the study
  kAlive,      // either way
  kPoint,      // to a worker: the number of a point
  kStandBy,    // to a worker: no more points; kQuit follows
  kEnd,        // to a worker: no more points, end with all others
  kQuit        // to a worker: end at once, without the others
};

struct RankMessage {
  int rank = 0;  // of the sender
  RankTag tag = RankTag::kAlive;
  std::string text;
};

// The processes that mpirun has started. One thread of each uses it. A message to a rank that is no more
// is lost without an error: whoever waits for an answer decides how long.
class MpiRanks {
 public:
  MpiRanks(int& argc, char**& argv);
  // Waits for all other ranks (MPI_Finalize).
  ~MpiRanks();
  MpiRanks(const MpiRanks&) = delete;
  MpiRanks& operator=(const MpiRanks&) = delete;

  int rank() const { return rank_; }
  int size() const { return size_; }
  std::string machine() const;

  void send(int rank, RankTag tag, const std::string& text = "");
  void send_to_all_others(RankTag tag, const std::string& text = "");
  // A message that has arrived.
  std::optional<RankMessage> receive();
  // Ends this process at once, without the others.
  [[noreturn]] static void quit(int status);

 private:
  int rank_ = 0, size_ = 1;
};

}  // namespace viscard
