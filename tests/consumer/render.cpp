// The passes of the module `render`.
#include <cstdio>

#include <cuticle/render/pass.h>

int main() {
  std::printf("%zu passes\n", cuticle::render::passes().size());
  return cuticle::render::passes().empty() ? 1 : 0;
}
