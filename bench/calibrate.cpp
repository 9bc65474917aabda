// A fixed exp loop and a fixed copy: what this machine is worth beside the reference machine of bench/reference.json.
// Prints JSON: the times in ms (best of seven) and, when the reference file is given, the scale for bounds in ms.
#include <chrono>
#include <cmath>
#include <cstring>
#include <fstream>
#include <vector>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

namespace {

template <class Work>
double best_ms(Work work) {
  double best = 1e30;
  for (int run = 0; run < 7; ++run) {
    const auto start = std::chrono::steady_clock::now();
    work();
    best = std::min(best, std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
  }
  return best;
}

double exp_ms() {
  volatile double sink = 0;
  return best_ms([&] {
    double sum = 0;
    for (int i = 0; i < 2'000'000; ++i) sum += std::exp(-1e-6 * i);
    sink = sum;
  });
}

double copy_ms() {
  std::vector<char> from(64 << 20, 1), to(64 << 20);
  return best_ms([&] { std::memcpy(to.data(), from.data(), from.size()); });
}

}  // namespace

int main(int argc, char** argv) {
  nlohmann::json result = {{"exp_ms", exp_ms()}, {"copy_ms", copy_ms()}};
  if (argc > 1) {
    const auto reference = nlohmann::json::parse(std::ifstream(argv[1]));
    result["scale"] = std::max(result["exp_ms"].get<double>() / reference["exp_ms"].get<double>(),
                               result["copy_ms"].get<double>() / reference["copy_ms"].get<double>());
  }
  fmt::print("{}\n", result.dump());
}
