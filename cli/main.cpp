#include "cli/boundary.h"

namespace cuticle::cli {
int run(int argc, char** argv);
}  // namespace cuticle::cli

int main(int argc, char** argv) {
  return cuticle::cli::guarded([&] { return cuticle::cli::run(argc, argv); });
}
