#pragma once
// Reading the coordinates of a place one after the other as numbers, directions, strands and settings.
#include <span>
#include <string>
#include <string_view>

#include "core/json/json.h"
#include "core/registry/parameter.h"
#include "tests/hard_cases/search/space.h"

namespace cuticle::hard_cases::search {

class Coordinates {
 public:
  explicit Coordinates(const Place& place) : left_(place) {}

  double next() {
    const double first = left_.front();
    left_ = left_.subspan(1);
    return first;
  }
  double between(double least, double most) { return least + (most - least) * next(); }
  /// By factors: the middle is the geometric mean.
  double by_factors(double least, double most);
  /// -most .. most, dense around 0: the eighth power; 0 below a millionth of a millionth.
  double around_zero(double most);
  std::size_t below(std::size_t count);
  /// True above the middle.
  bool flag() { return next() > 0.5; }
  /// Three numbers of -most .. most as a list.
  Json point(double most);
  /// A direction: any, the axes among them.
  Json direction();
  /// A groom of `strands` strands of `vertices` vertices within `most` metres of the origin, and its radius, a
  /// micrometre to a centimetre.
  Json groom(std::size_t strands, std::size_t vertices, double most);
  /// One coordinate a parameter: "name=value,..." of those that are not at their default; those `kept` stay there.
  std::string settings(registry::ParameterTable table, std::span<const std::string_view> kept = {});

 private:
  std::span<const double> left_;
};

constexpr std::size_t k_point = 3, k_direction = 2;
constexpr std::size_t groom_size(std::size_t strands, std::size_t vertices) { return strands * vertices * k_point + 1; }

}  // namespace cuticle::hard_cases::search
