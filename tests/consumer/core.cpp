// The area under a parabola by the module `core`.
#include <cstdio>

#include <cuticle/core/quadrature.h>

int main() {
  const double area = cuticle::integrate(cuticle::gauss_legendre(3), 0, 1, [](double x) { return x * x; });
  std::printf("1/3 = %.15f\n", area);
  return area > 0.3333 && area < 0.3334 ? 0 : 1;
}
