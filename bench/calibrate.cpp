// Prints the machine's times of bench/calibration.h as JSON, in ms, and, when the reference file is given, the scale
// for bounds in ms.
#include <fmt/core.h>

#include "bench/calibration.h"

using cuticle::Json;

int main(int argc, char** argv) {
  Json result = {{"exp_ms", cuticle::bench::exp_ms()}, {"copy_ms", cuticle::bench::copy_ms()}};
  if (argc > 1) {
    const Json reference = Json::parse(cuticle::read_text_file(argv[1]).value()).value();
    result["scale"] = std::max(result["exp_ms"].number() / reference["exp_ms"].number(),
                               result["copy_ms"].number() / reference["copy_ms"].number());
  }
  fmt::print("{}\n", result.dump());
}
