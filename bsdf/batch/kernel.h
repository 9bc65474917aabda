#pragma once
// What one instruction set's unit of one model offers: loops over arrays. Included by units that no symbol may leave,
// so it holds types only.
#include "bsdf/shared/packing.glslh"

namespace cuticle::bsdf::batch {

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
/// One array for each number of ParameterRow; the first `count` are read.
struct RowPointers {
  const float* value[CUTICLE_ROW_COUNT];
  int count;
};

struct VaryingPointers {
  RowPointers rows;
  DirectionPointers directions;
};

/// One point of the same meaning, its vectors where the caller has them.
struct OnePoint {
  const float *light, *viewer;
  float h;
};

struct Kernels {
  bool (*holds)(const Packed<float>&) = nullptr;  ///< whether the loops hold for these parameters
  void (*evaluate)(const Packed<float>&, int count, const DirectionPointers&, const ColorPointers&) = nullptr;
  void (*pdf)(const Packed<float>&, int count, const DirectionPointers&, float* density) = nullptr;
  void (*sample)(const Packed<float>&, int count, const QueryPointers&,
                 const VectorPointers&) = nullptr;  ///< null: no sampler
  void (*evaluate_rows)(int count, const RowPointers&, const DirectionPointers&,
                        const ColorPointers&) = nullptr;  ///< null: none
  int (*numbers_in_row)() = nullptr;                      ///< that it reads
  void (*evaluate_one)(const Packed<float>&, const OnePoint&, float color[3]) = nullptr;
  float (*pdf_of_one)(const Packed<float>&, const OnePoint&) = nullptr;
  void (*sample_one)(const Packed<float>&, const float viewer[3], float h, const float u[5],
                     float light[3]) = nullptr;  ///< null: no sampler
  /// Where `holds` says no: points one after the other, each an integral whose nodes are a vector; null: none.
  void (*evaluate_integral)(const Packed<float>&, int count, const DirectionPointers&, const ColorPointers&) = nullptr;
  void (*pdf_integral)(const Packed<float>&, int count, const DirectionPointers&, float* density) = nullptr;
};

/// A model's kernels, from the plainest instruction set to the widest; null where the build has none.
struct Entry {
  const char* model;
  const Kernels* kernels[3];
};

}  // namespace cuticle::bsdf::batch
