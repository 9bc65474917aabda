#include "tests/hard_cases/model_points.h"

#include <numbers>

#include "tests/hard_cases/subject.h"

namespace cuticle::hard_cases {
namespace {

/// Every point so far, once for each number of the input.
void spread(std::vector<bsdf::Point>& points, const Json& inputs, const char* key, double bsdf::Point::*member,
            double unit) {
  if (!inputs.contains(key)) return;
  std::vector<bsdf::Point> all;
  for (const bsdf::Point& point : points)
    for (double value : numbers(inputs.at(key))) {
      all.push_back(point);
      all.back().*member = value * unit;
    }
  points = std::move(all);
}

}  // namespace

std::vector<bsdf::Point> points_from(const Json& inputs) {
  constexpr double degree = std::numbers::pi / 180;
  std::vector<bsdf::Point> points(1);
  spread(points, inputs, "theta_i_deg", &bsdf::Point::theta_i, degree);
  spread(points, inputs, "theta_o_deg", &bsdf::Point::theta_o, degree);
  spread(points, inputs, "theta_d_deg", &bsdf::Point::theta_d, degree);
  spread(points, inputs, "phi_deg", &bsdf::Point::phi, degree);
  spread(points, inputs, "h", &bsdf::Point::h, 1);
  spread(points, inputs, "phi_o_deg", &bsdf::Point::phi_o, degree);
  return points;
}

}  // namespace cuticle::hard_cases
