#include <algorithm>
#include <cmath>

#include <cuticle/lut/evaluate.h>

namespace cuticle::lut {

AxisMap axis_map(const Axis& axis, int size) {
  const double range = axis.upper - axis.lower;
  if (!axis.corner_aligned) return {1 / range, -axis.lower / range};
  const double scale = (size - 1) / (size * range);
  return {scale, 0.5 / size - axis.lower * scale};
}

double axis_value(const Axis& axis, int size, double coordinate) {
  const AxisMap map = axis_map(axis, size);
  return std::clamp((coordinate - map.bias) / map.scale, axis.lower, axis.upper);
}

namespace {

void set_quantity(bsdf::Point& point, AxisQuantity quantity, double value) {
  switch (quantity) {
    case AxisQuantity::sin_theta_i:
      point.theta_i = std::asin(value);
      break;
    case AxisQuantity::sin_theta_o:
      point.theta_o = std::asin(value);
      break;
    case AxisQuantity::cos_phi:
      point.phi = std::acos(value);
      break;
    case AxisQuantity::cos_theta_d:
      point.theta_d = std::acos(value);
      break;
  }
}

}  // namespace

bsdf::Point make_point(const TableLayout& table, double u_value, double v_value) {
  bsdf::Point point;
  set_quantity(point, table.u.quantity, u_value);
  set_quantity(point, table.v.quantity, v_value);
  if (table.u.quantity == AxisQuantity::sin_theta_i) point.theta_d = (point.theta_o - point.theta_i) / 2;
  return point;
}

}  // namespace cuticle::lut
