#include "io/cli/mpi/mpi_dispatch.h"

#include "io/cli/mpi/mpi_worker.h"
#include "io/flow/sweep/point_dispatcher.h"

#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <future>
#include <ostream>
#include <stdexcept>
#include <thread>

namespace viscard {
namespace {

// With more ranks the dispatcher is busy enough.
constexpr int kFewRanks = 16;
// Answers that are kept in one transaction at most.
constexpr std::size_t kMostAnswers = 4096;

class MpiDispatch {
 public:
  MpiDispatch(const SweepJob& job, double lost_after_s, MpiRanks& ranks, Streams& streams)
      : job_(job),
        ranks_(ranks),
        streams_(streams),
        lost_after_s_(lost_after_s),
        open_(open_points(job.study, job.shard, job.store, outcome_)),
        dispatcher_(open_, lost_after_s) {}

  StudyOutcome run() {
    const WorkerStart start{std::filesystem::absolute(job_.study.path).string(),
                            fingerprint_with_inputs(job_.study), lost_after_s_};
    ranks_.send_to_all_others(RankTag::kStart, text_from(start));
    if (ranks_.size() <= kFewRanks) give(0, dispatcher_.ask(0, now_s()));
    while (!dispatcher_.is_done()) {
      const bool has_message = take_messages();
      const bool has_own_answer = take_own_answer();
      keep_answers();
      look_for_lost();
      if (!has_message && !has_own_answer) std::this_thread::sleep_for(pause());
    }
    return outcome_;
  }
  // Some ranks may be silent for ever.
  bool has_lost() const { return dispatcher_.n_lost() > 0; }
  void check_left() const {
    if (dispatcher_.given_up().empty()) return;
    std::string points;
    for (const std::int64_t point : dispatcher_.given_up()) {
      points += (points.empty() ? "" : ", ") + std::to_string(point);
    }
    throw std::runtime_error(fmt::format(
        "no answer to point {}: two ranks each were lost with it. Does it need more memory than a "
        "rank has? All other points are kept; the same command tries these again",
        points));
  }

 private:
  double now_s() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  }
  std::chrono::microseconds pause() const {
    return std::chrono::microseconds(ranks_.size() <= kFewRanks ? 200 : 10);
  }

  void give(int rank, const std::optional<std::int64_t>& point) {
    if (!point) return;
    if (rank != 0) {
      ranks_.send(rank, RankTag::kPoint, std::to_string(*point));
    } else {
      own_answer_ = std::async(std::launch::async,
                               [this, p = *point] { return answer_point(job_.study, p); });
    }
  }

  void take(int rank, StudyPoint point) {
    if (dispatcher_.take(rank, point.point, now_s())) answers_.push_back(std::move(point));
    give(rank, dispatcher_.ask(rank, now_s()));
  }

  bool take_messages() {
    bool has_any = false;
    while (answers_.size() < kMostAnswers) {
      const auto message = ranks_.receive();
      if (!message) break;
      has_any = true;
      const int rank = message->rank;
      if (message->tag == RankTag::kAnswer) {
        take(rank, point_from_bytes(message->text));
      } else if (message->tag == RankTag::kAsk) {
        give(rank, dispatcher_.ask(rank, now_s()));
      } else if (message->tag == RankTag::kAlive) {
        dispatcher_.hear(rank, now_s());
        ranks_.send(rank, RankTag::kAlive);
      } else if (message->tag == RankTag::kRefuse) {
        refuse(rank, message->text);
      }
    }
    return has_any;
  }

  void refuse(int rank, const std::string& why) {
    const std::string text = fmt::format("rank {} on {}", rank, why);
    if (++n_refused_ == ranks_.size() - 1 && ranks_.size() > kFewRanks) {
      throw std::runtime_error("no rank can answer the study: " + text);
    }
    streams_.err << "viscard-mpi: " << text << "; the others go on without it\n";
  }

  bool take_own_answer() {
    dispatcher_.hear(0, now_s());
    if (!own_answer_.valid() ||
        own_answer_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
      return false;
    }
    take(0, own_answer_.get());
    return true;
  }

  void keep_answers() {
    if (answers_.empty()) return;
    job_.store.add(answers_);
    for (const StudyPoint& point : answers_) {
      count_point(point, outcome_);
      ++n_tried_;
    }
    answers_.clear();
    job_.progress(static_cast<double>(n_tried_) / static_cast<double>(open_.size()));
  }

  void look_for_lost() {
    if (now_s() < next_look_s_) return;
    next_look_s_ = now_s() + 0.05 * lost_after_s_;
    for (const int rank : dispatcher_.find_lost(now_s())) {
      streams_.err << fmt::format(
          "viscard-mpi: rank {} has been silent for {:.3g} s and counts as lost; another one "
          "answers its point\n",
          rank, lost_after_s_);
    }
    for (const DispatchedPoint& work : dispatcher_.assign(now_s())) give(work.worker, work.point);
    if (dispatcher_.is_stuck(now_s())) {
      throw std::runtime_error(
          "all ranks that answer points are lost; the points that were answered are kept, and the "
          "same command goes on with the others");
    }
  }

  const SweepJob& job_;
  MpiRanks& ranks_;
  Streams& streams_;
  double lost_after_s_;
  StudyOutcome outcome_;
  std::vector<std::int64_t> open_;
  PointDispatcher dispatcher_;
  std::vector<StudyPoint> answers_;  // not kept yet
  std::future<StudyPoint> own_answer_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  double next_look_s_ = 0.0;
  int n_refused_ = 0;
  std::size_t n_tried_ = 0;
};

}  // namespace

StudyOutcome dispatch_study(const SweepJob& job, double lost_after_s, MpiRanks& ranks,
                            Streams& streams, RanksEnd& end) {
  MpiDispatch dispatch(job, lost_after_s, ranks, streams);
  end = RanksEnd::kStandingBy;  // until everything went well
  const StudyOutcome outcome = dispatch.run();
  ranks.send_to_all_others(dispatch.has_lost() ? RankTag::kStandBy : RankTag::kEnd);
  if (!dispatch.has_lost()) end = RanksEnd::kEnded;
  dispatch.check_left();
  return outcome;
}

}  // namespace viscard
