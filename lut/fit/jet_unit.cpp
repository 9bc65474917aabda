// One model's formulas with ceres::Jet, compiled once for each model: CUTICLE_JET_MODEL names it, model_of_jet.h
// includes it.
// glm keeps components in unions, which cannot hold a Jet, unless it is told to name them x, y, z, w only.
#define GLM_FORCE_XYZW_ONLY
#include <ceres/jet.h>

#include <model_of_jet.h>
#include "core/join.h"
#include "lut/fit/detail/jet_tangents.h"

namespace cuticle::lut {

void CUTICLE_JOIN(jet_of_, CUTICLE_JET_MODEL)(const PackedTangents& packed, int quantity, int lobe, const double at[6],
                                              RgbTangents& out) {
  using Jet = ceres::Jet<double, k_jet_width>;
  using Gradient = Eigen::Matrix<double, k_jet_width, 1>;
  using bsdf::CUTICLE_JET_MODEL::Prepared;
  std::array<Jet, bsdf::number_count<Prepared>> numbers;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    numbers[i].a = packed.value[i];
    numbers[i].v = Eigen::Map<const Gradient>(packed.tangents + k_jet_width * i);
  }
  const bsdf::EvaluationPoint<Jet> point{Jet(at[0]), Jet(at[1]), Jet(at[2]), Jet(at[3]), Jet(at[4]), Jet(at[5])};
  const auto prepared = bsdf::from_numbers<Prepared<Jet>>(numbers.data());
  const auto rgb = bsdf::CUTICLE_JET_MODEL::evaluate(prepared, quantity, lobe, point);
  for (int c = 0; c < 3; ++c) {
    out.value[c] = rgb[c].a;
    Eigen::Map<Gradient>(out.gradients + k_jet_width * c) = rgb[c].v;
  }
}

}  // namespace cuticle::lut
