// The devices that the module `gpu` finds.
#include <cstdio>

#include <cuticle/gpu/device.h>

int main() {
  std::printf("%zu devices\n", cuticle::gpu::list_devices().size());
}
