// One value of a model of the module `bsdf`.
#include <cstdio>

#include <cuticle/bsdf/model.h>

int main() {
  namespace bsdf = cuticle::bsdf;
  const auto model = bsdf::find_model("marschner");
  if (!model) return 1;
  const auto values = cuticle::registry::default_values((*model)->entry.parameters);
  const bsdf::Point point{.theta_i = 0.1, .theta_o = -0.1, .phi = 1.0};
  glm::dvec3 scattered{0};
  if (!bsdf::evaluate(**model, values, bsdf::Precision::f64, {bsdf::Quantity::S, -1, {&point, 1}}, {&scattered, 1}))
    return 1;
  std::printf("S = %.6f\n", scattered.x);
  return scattered.x > 0 ? 0 : 1;
}
