// The length of a strand by the module `strands`.
#include <cstdio>

#include <cuticle/strands/groom.h>

int main() {
  cuticle::strands::Groom groom;
  groom.positions = {{0, 0, 0}, {0, 0.1f, 0}, {0.1f, 0.1f, 0}};
  groom.offsets = {0, 3};
  const double length = cuticle::strands::strand_length(groom, 0);
  std::printf("%.3f m\n", length);
  return length > 0.19 && length < 0.21 ? 0 : 1;
}
