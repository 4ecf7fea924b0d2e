#include "io/cli/mpi/mpi_worker.h"

#include "io/flow/sweep/run_study.h"
#include "models/maths/failure_text.h"
#include "models/maths/leading_number.h"

#include <chrono>
#include <future>
#include <limits>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace viscard {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point then) {
  return std::chrono::duration<double>(Clock::now() - then).count();
}

// Rank 0 as a worker sees it: who is silent for too long is lost.
class Dispatcher0 {
 public:
  explicit Dispatcher0(MpiRanks& ranks) : ranks_(ranks) {}

  void set_lost_after(double seconds) {
    lost_after_s_ = seconds;
    heard_ = told_ = Clock::now();
  }
  void send(RankTag tag, const std::string& text = "") {
    told_ = Clock::now();
    ranks_.send(0, tag, text);
  }
  // Waits for a message other than a sign of life. Sends signs of life in the meantime, and ends
  // this process if rank 0 orders it or is lost.
  std::optional<RankMessage> receive() {
    constexpr double kSignsUntilLost = 6.0;
    if (seconds_since(told_) > lost_after_s_ / kSignsUntilLost) send(RankTag::kAlive);
    if (seconds_since(heard_) > lost_after_s_) MpiRanks::quit(1);
    auto message = ranks_.receive();
    if (!message) return message;
    heard_ = Clock::now();
    if (message->tag == RankTag::kQuit) MpiRanks::quit(0);
    return message->tag == RankTag::kAlive ? std::nullopt : message;
  }
  // Waits for a message without taking the core from others.
  RankMessage wait() {
    constexpr auto kShort = std::chrono::microseconds(20), kLong = std::chrono::microseconds(1000);
    for (auto pause = kShort;; pause = std::min(2 * pause, kLong)) {
      if (auto message = receive()) return *message;
      std::this_thread::sleep_for(pause);
    }
  }

 private:
  MpiRanks& ranks_;
  double lost_after_s_ = std::numeric_limits<double>::infinity();
  Clock::time_point heard_ = Clock::now(), told_ = heard_;
};

// The study as this machine sees it.
Study study_of(const WorkerStart& start) {
  Study study = read_study(start.study_path);
  if (fingerprint_with_inputs(study) != start.fingerprint) {
    throw std::runtime_error(
        start.study_path +
        ": this machine sees another study, scene, material or version of viscard than "
        "rank 0; use a folder that all machines share");
  }
  return study;
}

// Answers a point in a second thread, while this one gives signs of life.
std::string answer_of(const Study& study, std::int64_t number, Dispatcher0& rank_0) {
  auto answer = std::async(std::launch::async, [&] { return answer_point(study, number); });
  while (answer.wait_for(std::chrono::milliseconds(50)) != std::future_status::ready) {
    rank_0.receive();
  }
  return bytes_from_point(answer.get());
}

}  // namespace

std::string text_from(const WorkerStart& start) {
  std::ostringstream text;
  text << start.lost_after_s << '\n' << start.fingerprint << '\n' << start.study_path;
  return text.str();
}

WorkerStart start_from(const std::string& text) {
  WorkerStart start;
  const std::size_t first = text.find('\n'), second = text.find('\n', first + 1);
  start.lost_after_s = leading_number(text.substr(0, first));
  start.fingerprint = text.substr(first + 1, second - first - 1);
  start.study_path = text.substr(second + 1);
  return start;
}

int run_worker(MpiRanks& ranks) {
  Dispatcher0 rank_0(ranks);
  std::optional<Study> study;
  for (;;) {
    const RankMessage message = rank_0.wait();
    if (message.tag == RankTag::kEnd) return 0;
    if (message.tag == RankTag::kStandBy) {
      rank_0.set_lost_after(600.0);  // rank 0 may have a long table to write
    } else if (message.tag == RankTag::kStart) {
      const WorkerStart start = start_from(message.text);
      rank_0.set_lost_after(start.lost_after_s);
      try {
        study = study_of(start);
        rank_0.send(RankTag::kAsk);
      } catch (const std::exception& error) {
        rank_0.send(RankTag::kRefuse, ranks.machine() + ": " + failure_text(error, "this study"));
      }
    } else if (message.tag == RankTag::kPoint && study) {
      rank_0.send(RankTag::kAnswer, answer_of(*study, std::stoll(message.text), rank_0));
    }
  }
}

}  // namespace viscard
