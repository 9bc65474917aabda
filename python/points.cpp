#include "python/points.h"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace cuticle::python {
namespace {

/// An argument of eval. An angle may pass a right one by its rounding.
struct Coordinate {
  double bsdf::Point::*member;
  const char* name;
  double limit, unit;
};
constexpr double k_degree = std::numbers::pi / 180, k_right = 90 * (1 + 1e-12), k_turns = 5.7e7;
constexpr Coordinate k_coordinates[] = {{&bsdf::Point::theta_i, "theta_i_deg", k_right, k_degree},
                                        {&bsdf::Point::theta_o, "theta_o_deg", k_right, k_degree},
                                        {&bsdf::Point::theta_d, "theta_d_deg", k_right, k_degree},
                                        {&bsdf::Point::phi, "phi_deg", k_turns, k_degree},
                                        {&bsdf::Point::h, "h", 1, 1},
                                        {&bsdf::Point::phi_o, "phi_o_deg", k_turns, k_degree}};

}  // namespace

PointReader::PointReader(const std::vector<Numbers>& coordinates, const std::vector<std::size_t>& shape)
    : shape_(shape) {
  for (const std::size_t length : shape) count_ *= length;
  for (const Numbers& array : coordinates) {
    Source source{.data = array.data(), .strides = std::vector<std::size_t>(shape.size(), 0)};
    std::size_t stride = 1;
    for (std::size_t back = 1; back <= array.ndim(); ++back) {
      const std::size_t own = array.shape(array.ndim() - back);
      if (own != 1) source.strides[shape.size() - back] = stride;
      stride *= own;
    }
    source.is_constant = array.size() == 1;
    source.is_whole = array.size() == count_;
    sources_.push_back(std::move(source));
  }
}

/// put(i, value) for point first + i.
template <class Put>
Result<void> PointReader::each(std::size_t coordinate, std::size_t first, std::size_t count, const Put& put) const {
  const Coordinate& what = k_coordinates[coordinate];
  const Source& source = sources_[coordinate];
  const auto refused = [&](double value) {
    return bad_input(fmt::format("{}: {} is outside -{:g} .. {:g}", what.name, value, what.limit, what.limit));
  };
  if (source.is_constant || source.is_whole) {
    const double* data = source.is_whole ? source.data + first : source.data;
    const std::size_t stride = source.is_whole ? 1 : 0;
    bool sound = true;
    for (std::size_t i = 0; i < count; ++i) {
      put(i, data[stride * i]);
      sound &= std::abs(data[stride * i]) <= what.limit;
    }
    for (std::size_t i = 0; !sound && i < count; ++i)
      if (const double value = data[stride * i]; !(std::abs(value) <= what.limit)) return refused(value);
    return {};
  }
  for (std::size_t i = 0; i < count; ++i) {
    std::size_t flat = first + i, index = 0;
    for (std::size_t axis = shape_.size(); axis-- > 0; flat /= shape_[axis])
      index += flat % shape_[axis] * source.strides[axis];
    if (!(std::abs(source.data[index]) <= what.limit)) return refused(source.data[index]);
    put(i, source.data[index]);
  }
  return {};
}

Result<void> PointReader::read_column(double bsdf::Point::*member, std::size_t first, std::span<double> out) const {
  for (std::size_t c = 0; c < sources_.size(); ++c)
    if (k_coordinates[c].member == member)
      return each(c, first, out.size(), [&](std::size_t i, double value) { out[i] = value; });
  return {};
}

Result<void> PointReader::read(std::size_t first, std::size_t count, std::vector<bsdf::Point>& out) const {
  out.resize(count);
  for (std::size_t c = 0; c < sources_.size(); ++c) {
    const Coordinate& what = k_coordinates[c];
    CUTICLE_TRY(each(c, first, count, [&](std::size_t i, double value) { out[i].*what.member = value * what.unit; }));
  }
  return {};
}

std::vector<bsdf::Point>& scratch_points() {
  thread_local std::vector<bsdf::Point> points;
  return points;
}

}  // namespace cuticle::python
