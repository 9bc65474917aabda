#pragma once
// What a manifest.json says about a folder of tables, for everything that reads such a folder or writes for an engine.
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>

#include "core/result.h"

namespace cuticle::lut {

/// Texture coordinate = value * scale + bias.
struct ManifestAxis {
  std::string quantity;  ///< an AxisInfo's name, "cos_phi"
  double scale = 1, bias = 0;
  double eta = 0, gap = 0;  ///< of an axis from_caustic
};
struct ManifestChannel {
  std::string name;
  double scale = 1;      ///< value = stored * scale
  double maximum = 0;    ///< the table's largest value
  double tolerance = 0;  ///< how far a filtered reading may lie from a probe's value
};
/// A value that a correctly bound texture gives at a coordinate (u, v): at a texel's centre, or between texels.
struct Probe {
  double u = 0, v = 0;
  bool interpolated = false;
  std::vector<double> values;  ///< one a channel
};
struct ManifestTable {
  std::string name, file;
  std::string sha256;  ///< of the file as written; empty before it was
  glm::ivec2 size{0};
  ManifestAxis u, v;
  std::vector<ManifestChannel> channels;
  std::vector<Probe> probes;
};
struct Manifest {
  std::string tool_version, model, layout, format, composition;
  std::vector<ManifestTable> tables;
  std::vector<std::vector<std::string>> terms;  ///< factors of the products whose sum is S; empty: not made of them
  bool over_cos2_theta_d = false;               ///< the sum is divided by cos^2 theta_d
};

/// The parts of a manifest's text that readers need. Keys that it does not know are left alone; a key that it needs
/// must be there, of its type and within its range (schema: docs/lut_manifest.schema.json). `file` is the name used in
/// messages. Error: bad_input naming the key.
Result<Manifest> parse_manifest(std::string_view text, const std::string& file);
/// The same from a folder's manifest.json. Error: bad_input naming the file.
Result<Manifest> read_manifest(const std::string& folder);

}  // namespace cuticle::lut
