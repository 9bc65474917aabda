// Prints the machine's times of bench/calibration.h as JSON, in ms, and, when the reference file is given, the scale
// for bounds in ms.
#include <fstream>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "calibration.h"

int main(int argc, char** argv) {
  nlohmann::json result = {{"exp_ms", cuticle::bench::exp_ms()}, {"copy_ms", cuticle::bench::copy_ms()}};
  if (argc > 1) {
    const auto reference = nlohmann::json::parse(std::ifstream(argv[1]));
    result["scale"] = std::max(result["exp_ms"].get<double>() / reference["exp_ms"].get<double>(),
                               result["copy_ms"].get<double>() / reference["copy_ms"].get<double>());
  }
  fmt::print("{}\n", result.dump());
}
