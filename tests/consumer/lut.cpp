// The layouts of the module `lut`.
#include <cstdio>

#include <cuticle/lut/table_set.h>

int main() {
  std::printf("%zu layouts\n", cuticle::lut::layouts().size());
  return cuticle::lut::layouts().empty() ? 1 : 0;
}
