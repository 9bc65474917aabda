// What a strand leaves of a light behind it, by a method of the module `shadows`.
#include <cstdio>

#include <cuticle/shadows/method.h>

int main() {
  namespace shadows = cuticle::shadows;
  cuticle::strands::Groom groom;
  groom.positions = {{-1, 0, 0}, {1, 0, 0}};
  groom.offsets = {0, 2};
  groom.radii = {0.01f, 0.01f};
  const auto method = shadows::find_method("deep_opacity");
  if (!method) return 1;
  const glm::vec3 behind{0, -1, 0};
  const auto values = cuticle::registry::default_values((*method)->entry.parameters);
  const auto left = (*method)->evaluate({.groom = &groom}, {.points = {&behind, 1}}, values);
  if (!left) return 1;
  std::printf("%.3f\n", left->values[0]);
}
