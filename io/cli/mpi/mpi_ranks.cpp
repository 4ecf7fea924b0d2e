#include "io/cli/mpi/mpi_ranks.h"

#include <mpi.h>

#include <array>
#include <cstdlib>
#include <stdexcept>

namespace viscard {

MpiRanks::MpiRanks(int& argc, char**& argv) {
  int level = 0;
  if (MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &level) != MPI_SUCCESS ||
      level < MPI_THREAD_FUNNELED) {
    throw std::runtime_error("MPI does not allow a second thread in a rank (MPI_THREAD_FUNNELED)");
  }
  // Otherwise a rank that is no more would take all others with it.
  MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &size_);
}

MpiRanks::~MpiRanks() {
  MPI_Finalize();
}

std::string MpiRanks::machine() const {
  std::array<char, MPI_MAX_PROCESSOR_NAME> name{};
  int length = 0;
  MPI_Get_processor_name(name.data(), &length);
  return {name.data(), static_cast<std::size_t>(length)};
}

void MpiRanks::send(int rank, RankTag tag, const std::string& text) {
  MPI_Send(text.data(), static_cast<int>(text.size()), MPI_CHAR, rank, static_cast<int>(tag),
           MPI_COMM_WORLD);
}

void MpiRanks::send_to_all_others(RankTag tag, const std::string& text) {
  for (int rank = 0; rank < size_; ++rank) {
    if (rank != rank_) send(rank, tag, text);
  }
}

std::optional<RankMessage> MpiRanks::receive() {
  int has_message = 0;
  MPI_Status status;
  const int found = MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &has_message, &status);
  if (found != MPI_SUCCESS || has_message == 0) return std::nullopt;
  int length = 0;
  MPI_Get_count(&status, MPI_CHAR, &length);
  RankMessage message{status.MPI_SOURCE, static_cast<RankTag>(status.MPI_TAG),
                      std::string(static_cast<std::size_t>(length), '\0')};
  const int received = MPI_Recv(message.text.data(), length, MPI_CHAR, message.rank, status.MPI_TAG,
                                MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  if (received != MPI_SUCCESS) return std::nullopt;
  return message;
}

void MpiRanks::quit(int status) {
  std::_Exit(status);
}

}  // namespace viscard
