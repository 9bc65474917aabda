#pragma once
// Angles of a case as points of a model.
#include <vector>

#include "bsdf/model.h"
#include "core/json/json.h"

namespace cuticle::hard_cases {

/// Every combination of "theta_i_deg", "theta_o_deg", "theta_d_deg", "phi_deg", "h" and "phi_o_deg"; absent: 0.
std::vector<bsdf::Point> points_from(const Json& inputs);

}  // namespace cuticle::hard_cases
