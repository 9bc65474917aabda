#include "cli/command.h"

namespace cuticle::cli {
void add_all_commands(CLI::App& app, Context& context);
int run(int argc, char** argv);
}  // namespace cuticle::cli

int main(int argc, char** argv) { return cuticle::cli::run(argc, argv); }
