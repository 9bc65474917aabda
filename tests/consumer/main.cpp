// A user's project: evaluates one value of the marschner model through the installed package.
#include <cstdio>

#include <cuticle/bsdf/model.h>
#include <cuticle/lut/table_set.h>

int main() {
  const auto model = cuticle::bsdf::find_model("marschner");
  if (!model) return 1;
  const auto values = cuticle::registry::default_values((*model)->entry.parameters);
  const cuticle::bsdf::Point point{.theta_i = 0.1, .theta_o = -0.1, .phi = 1.0};
  glm::dvec3 scattered{0};
  const cuticle::bsdf::Request request{cuticle::bsdf::Quantity::S, -1, {&point, 1}};
  if (!cuticle::bsdf::evaluate(**model, values, cuticle::bsdf::Precision::f64, request, {&scattered, 1})) return 1;
  std::printf("%zu layouts, S = %.6f\n", cuticle::lut::layouts().size(), scattered.x);
  return scattered.x > 0 ? 0 : 1;
}
