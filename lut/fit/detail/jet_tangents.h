#pragma once
// Numbers with their derivatives, as plain arrays, between the units that know ceres::Jet and the others.
#include "bsdf/shared/prepared.glslh"

namespace cuticle::lut {

/// Parameters that one evaluation differentiates by.
inline constexpr int k_jet_width = 8;

/// The numbers that a model prepares and their derivatives by up to k_jet_width parameters: tangents[k_jet_width * i +
/// j].
struct PackedTangents {
  double value[CUTICLE_PREPARED_MOST];
  double tangents[CUTICLE_PREPARED_MOST * k_jet_width];
};
/// rgb and its derivatives, gradients[k_jet_width * component + j].
struct RgbTangents {
  double value[3];
  double gradients[3 * k_jet_width];
};

}  // namespace cuticle::lut
