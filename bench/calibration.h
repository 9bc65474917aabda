#pragma once
// A fixed exp loop and a fixed copy: what this machine is worth beside the reference machine of bench/reference.json.
#include <chrono>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "core/file.h"
#include "core/json/json.h"

namespace cuticle::bench {

/// The shortest of `runs` runs [ms].
template <class Work>
double best_ms(int runs, const Work& work) {
  double best = 1e30;
  for (int run = 0; run < runs; ++run) {
    const auto start = std::chrono::steady_clock::now();
    work();
    best = std::min(best, std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
  }
  return best;
}

/// What 2,000,000 exp take, from the shortest of 300 runs over a hundredth of them: short runs find quiet moments on a
/// busy machine.
inline double exp_ms() {
  volatile double sink = 0;
  return 100 * best_ms(300, [&] {
           double sum = 0;
           for (int i = 0; i < 20'000; ++i) sum += std::exp(-1e-4 * i);
           sink = sum;
         });
}

inline double copy_ms() {
  std::vector<char> from(64 << 20, 1), to(64 << 20);
  return best_ms(7, [&] { std::memcpy(to.data(), from.data(), from.size()); });
}

/// How many times longer this machine takes than the one of a file like bench/reference.json.
inline double machine_scale(const std::string& reference) {
  return exp_ms() / Json::parse(read_text_file(reference).value()).value()["exp_ms"].number();
}

}  // namespace cuticle::bench
