// What reading strand files costs: bench_strands. Files of a million strands are written to the temporary folder, read
// from the page cache and removed; memory is that of a process of its own which reads one of them.
#include <filesystem>
#include <map>

#include <benchmark/benchmark.h>
#include <fmt/core.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/file.h"
#include "strands/formats/formats.h"

namespace {

using namespace cuticle;
using namespace cuticle::strands;
namespace fs = std::filesystem;

constexpr std::size_t k_strands = 1000000, k_points = 16;

/// Strands of 0.15 m on a square of 0.2 m.
Groom lawn() {
  Groom groom;
  groom.positions.reserve(k_strands * k_points);
  for (std::size_t s = 0; s < k_strands; ++s) {
    for (std::size_t i = 0; i < k_points; ++i)
      groom.positions.emplace_back(0.0002f * float(s % 1000), 0.01f * float(i), 0.0002f * float(s / 1000));
    groom.offsets.push_back(std::uint32_t(groom.positions.size()));
  }
  groom.radii.assign(groom.positions.size(), 4e-5f);
  return groom;
}

/// The file of so many strands under a name; written at its first use, removed at the end.
class Files {
 public:
  ~Files() {
    for (const auto& [name, path] : paths_) fs::remove(path);
  }
  const std::string& path(const std::string& extension) {
    std::string& path = paths_[extension];
    if (!path.empty()) return path;
    path = (fs::temp_directory_path() / fmt::format("bench_strands_{}.{}", ::getpid(), extension)).string();
    (void)write_groom(path, lawn()).value();
    return path;
  }

 private:
  std::map<std::string, std::string> paths_;
};
Files& files() {
  static Files all;
  return all;
}

std::size_t bytes_of(const Groom& groom) {
  return groom.offsets.size() * sizeof(groom.offsets[0]) + groom.positions.size() * sizeof(groom.positions[0]) +
         groom.radii.size() * sizeof(groom.radii[0]);
}

/// The largest resident memory of a process that reads the file.
double peak_bytes(const std::string& path) {
  const pid_t child = fork();
  if (child == 0) {
    execl("/proc/self/exe", "bench_strands", "--load", path.c_str(), nullptr);
    _exit(127);
  }
  rusage usage{};
  int status = 0;
  wait4(child, &status, 0, &usage);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? 1024.0 * double(usage.ru_maxrss) : 0;
}

void set_bytes(benchmark::State& state, const std::string& path) {
  state.SetBytesProcessed(std::int64_t(state.iterations()) * std::int64_t(fs::file_size(path)));
}

/// read_groom: parsing, units, radius, validation.
void read_whole(benchmark::State& state, const char* extension) {
  const std::string& path = files().path(extension);
  std::size_t in_memory = 0;
  for (auto _ : state) in_memory = bytes_of(read_groom(path).value().groom);
  set_bytes(state, path);
  const double peak = peak_bytes(path);
  state.counters["peak_over_groom"] = peak / double(in_memory);
  state.counters["peak_over_file"] = peak / double(fs::file_size(path));
}

/// The file into memory and nothing else: the disk's speed from the page cache.
void read_bytes(benchmark::State& state, const char* extension) {
  const std::string& path = files().path(extension);
  for (auto _ : state) benchmark::DoNotOptimize(read_file(path).value().data());
  set_bytes(state, path);
}

}  // namespace

int main(int count, char** arguments) {
  if (count == 3 && std::string(arguments[1]) == "--load") return read_groom(arguments[2]).ok() ? 0 : 1;
  for (const char* extension : {"hair", "tfx"}) {
    benchmark::RegisterBenchmark(fmt::format("read_groom/{}", extension).c_str(), read_whole, extension)
        ->Unit(benchmark::kMillisecond);
    benchmark::RegisterBenchmark(fmt::format("read_file/{}", extension).c_str(), read_bytes, extension)
        ->Unit(benchmark::kMillisecond);
  }
  benchmark::Initialize(&count, arguments);
  benchmark::RunSpecifiedBenchmarks();
}
