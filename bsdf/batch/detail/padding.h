#pragma once
// The last few points of a batch, filled up to whole vectors: the compiler's loop for what is left over rounds
// otherwise than its vectors do, and a point's value must not depend on its place in the batch.
#include <algorithm>
#include <array>

#include "bsdf/batch/kernel.h"

namespace cuticle::bsdf::batch {

constexpr int whole_vectors = 16;  ///< a multiple of the lanes of every instruction set

/// Copies of `count` < 16 elements of each array, the last one repeated, and room for results.
class Padding {
 public:
  explicit Padding(int count) : count_(count) {}
  const float* in(const float* from) {
    auto& to = arrays_[std::size_t(used_++)];
    std::fill(std::copy_n(from, count_, to.begin()), to.end(), from[count_ - 1]);
    return to.data();
  }
  DirectionPointers in(const DirectionPointers& p) {
    return {in(p.light_x), in(p.light_y), in(p.light_z), in(p.viewer_x), in(p.viewer_y), in(p.viewer_z), in(p.h)};
  }
  QueryPointers in(const QueryPointers& p) {
    return {in(p.viewer_x),
            in(p.viewer_y),
            in(p.viewer_z),
            in(p.h),
            {in(p.u[0]), in(p.u[1]), in(p.u[2]), in(p.u[3]), in(p.u[4])}};
  }
  VaryingPointers in(const VaryingPointers& p) {
    VaryingPointers varying{{}, p.count};
    for (int k = 0; k < p.count; ++k) varying.value[k] = in(p.value[k]);
    return varying;
  }
  VaryingPointPointers in(const VaryingPointPointers& p) { return {in(p.varying), in(p.directions)}; }
  float* out() { return arrays_[std::size_t(used_++)].data(); }
  void give_back(const float* from, float* to) const { std::copy_n(from, count_, to); }

 private:
  int count_, used_ = 0;
  std::array<std::array<float, whole_vectors>, CUTICLE_VARYING_MOST + 10> arrays_{};  // parameters, directions, results
};

inline DirectionPointers moved(const DirectionPointers& p, int by) {
  return {p.light_x + by, p.light_y + by, p.light_z + by, p.viewer_x + by, p.viewer_y + by, p.viewer_z + by, p.h + by};
}
inline QueryPointers moved(const QueryPointers& p, int by) {
  return {p.viewer_x + by,
          p.viewer_y + by,
          p.viewer_z + by,
          p.h + by,
          {p.u[0] + by, p.u[1] + by, p.u[2] + by, p.u[3] + by, p.u[4] + by}};
}
inline VaryingPointers moved(const VaryingPointers& p, int by) {
  VaryingPointers varying{{}, p.count};
  for (int k = 0; k < p.count; ++k) varying.value[k] = p.value[k] + by;
  return varying;
}

inline VaryingPointPointers moved(const VaryingPointPointers& p, int by) {
  return {moved(p.varying, by), moved(p.directions, by)};
}

/// run(count, input, colour arrays) over whole vectors, then once more over the padded rest. `out`: three arrays.
template <class Input, class Run>
void in_whole_vectors(int count, const Input& input, std::array<float*, 3> out, const Run& run) {
  const int whole = count - count % whole_vectors, rest = count - whole;
  if (whole > 0) run(whole, input, out);
  if (rest == 0) return;
  Padding padding(rest);
  const std::array<float*, 3> room = {padding.out(), padding.out(), padding.out()};
  run(whole_vectors, padding.in(moved(input, whole)), room);
  for (std::size_t c = 0; c < 3; ++c) padding.give_back(room[c], out[c] + whole);
}

}  // namespace cuticle::bsdf::batch
