#pragma once
// A batch without vectors: points through the model's scalar float formulas, one block at a time.
#include "bsdf/batch/batch.h"

namespace cuticle::bsdf::batch {

/// `count` points from `first`, the quantity's red, green and blue into out.x, y, z, those that are not empty.
void evaluate_one_by_one(const Model& model, const registry::ParameterValues& values, Quantity quantity,
                         const BatchPoints& points, std::size_t first, int count, const OutputSpans& out);

/// The directions drawn, as unit vectors.
void sample_one_by_one(const Model& model, const registry::ParameterValues& values, const BatchQueries& queries,
                       std::size_t first, int count, const OutputSpans& out);

}  // namespace cuticle::bsdf::batch
