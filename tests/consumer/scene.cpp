// A scene that the module `scene` refuses.
#include <cstdio>

#include <cuticle/scene/scene.h>

int main() {
  const auto scene = cuticle::scene::parse_scene("{}", ".", "consumer", {});
  if (scene) return 1;
  std::printf("%s\n", scene.error().message.c_str());
}
