#pragma once
// What one instruction set's unit of one model offers: loops over arrays. Included by units that no symbol may leave,
// so it holds types only.
#include "bsdf/shared/prepared.glslh"

namespace cuticle::bsdf {

/// A model's parameters that may vary from point to point, its leading ones; each model that has such defines its own.
template <class Real>
struct Varying;

namespace batch {

/// Points given as unit vectors (x along the fibre from root to tip) toward the light and the viewer, and offsets.
struct DirectionPointers {
  const float *light_x, *light_y, *light_z, *viewer_x, *viewer_y, *viewer_z, *h;
};
struct ColorPointers {
  float *red, *green, *blue;
};
/// Queries: the viewer's unit vector, the offset, and random numbers in [0, 1).
struct QueryPointers {
  const float *viewer_x, *viewer_y, *viewer_z, *h;
  const float* u[5];
};
struct VectorPointers {
  float *x, *y, *z;
};
/// One array for each number of the model's Varying; the first `count` are read.
struct VaryingPointers {
  const float* value[CUTICLE_VARYING_MOST];
  int count;
};

struct VaryingPointPointers {
  VaryingPointers varying;
  DirectionPointers directions;
};

/// One point of the same meaning, its vectors where the caller has them.
struct OnePoint {
  const float *light, *viewer;
  float h;
};

/// `numbers`: of the struct that the model prepares.
struct Kernels {
  bool (*holds)(const float* numbers) = nullptr;  ///< whether the loops hold for these parameters
  void (*evaluate)(const float* numbers, int count, const DirectionPointers&, const ColorPointers&) = nullptr;
  void (*pdf)(const float* numbers, int count, const DirectionPointers&, float* density) = nullptr;
  void (*sample)(const float* numbers, int count, const QueryPointers&,
                 const VectorPointers&) = nullptr;  ///< null: no sampler
  void (*evaluate_varying)(int count, const VaryingPointers&, const DirectionPointers&,
                           const ColorPointers&) = nullptr;  ///< null: none
  int (*varying_numbers)() = nullptr;                        ///< that it reads
  void (*evaluate_one)(const float* numbers, const OnePoint&, float color[3]) = nullptr;
  float (*pdf_of_one)(const float* numbers, const OnePoint&) = nullptr;
  void (*sample_one)(const float* numbers, const float viewer[3], float h, const float u[5],
                     float light[3]) = nullptr;  ///< null: no sampler
  /// Where `holds` says no: points one after the other, each an integral whose nodes are a vector; null: none.
  void (*evaluate_integral)(const float* numbers, int count, const DirectionPointers&, const ColorPointers&) = nullptr;
  void (*pdf_integral)(const float* numbers, int count, const DirectionPointers&, float* density) = nullptr;
};

/// A model's kernels, from the plainest instruction set to the widest; null where the build has none.
struct Entry {
  const char* model;
  const Kernels* kernels[3];
};

}  // namespace batch
}  // namespace cuticle::bsdf
