#include "aeolian_twin/ranks/ranks.hpp"

#include <cstdlib>
#include <numeric>

#define OMPI_SKIP_MPICXX 1
#include <mpi.h>

namespace aeolian {
namespace {

/// MPI itself is started only then: alone it would cost time and need a network.
bool started_by_mpirun() {
  return std::getenv("OMPI_COMM_WORLD_SIZE") != nullptr || std::getenv("PMI_SIZE") != nullptr;
}

/// Where each text begins among all, and where the last ends.
std::vector<int> begins_of(const std::vector<int>& lengths) {
  std::vector<int> begins(lengths.size() + 1, 0);
  std::partial_sum(lengths.begin(), lengths.end(), begins.begin() + 1);
  return begins;
}

std::vector<std::string> parts_of(const std::string& all, const std::vector<int>& begins) {
  std::vector<std::string> texts;
  for (std::size_t i = 0; i + 1 < begins.size(); ++i)
    texts.push_back(
        all.substr(static_cast<std::size_t>(begins[i]), static_cast<std::size_t>(begins[i + 1] - begins[i])));
  return texts;
}

}  // namespace

Ranks::Ranks() : together_(started_by_mpirun()) {
  if (!together_) return;
  int granted = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &granted);
  int rank = 0;
  int count = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &count);
  rank_ = static_cast<std::size_t>(rank);
  count_ = static_cast<std::size_t>(count);
}

Ranks::~Ranks() {
  if (together_) MPI_Finalize();
}

std::vector<std::string> Ranks::gather(const std::string& text) const {
  if (!together_) return {text};
  const int length = static_cast<int>(text.size());
  std::vector<int> lengths(count_);
  MPI_Gather(&length, 1, MPI_INT, lengths.data(), 1, MPI_INT, 0, MPI_COMM_WORLD);
  const std::vector<int> begins = begins_of(lengths);
  std::string all(static_cast<std::size_t>(begins.back()), ' ');
  MPI_Gatherv(text.data(), length, MPI_CHAR, all.data(), lengths.data(), begins.data(), MPI_CHAR, 0,
              MPI_COMM_WORLD);
  return rank_ == 0 ? parts_of(all, begins) : std::vector<std::string>();
}

std::vector<std::string> Ranks::share(const std::string& text) const {
  if (!together_) return {text};
  const int length = static_cast<int>(text.size());
  std::vector<int> lengths(count_);
  MPI_Allgather(&length, 1, MPI_INT, lengths.data(), 1, MPI_INT, MPI_COMM_WORLD);
  const std::vector<int> begins = begins_of(lengths);
  std::string all(static_cast<std::size_t>(begins.back()), ' ');
  MPI_Allgatherv(text.data(), length, MPI_CHAR, all.data(), lengths.data(), begins.data(), MPI_CHAR,
                 MPI_COMM_WORLD);
  return parts_of(all, begins);
}

}  // namespace aeolian
