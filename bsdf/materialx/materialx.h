#pragma once
// MaterialX documents with hair: `chiang_hair_bsdf` and its helper nodes (MaterialX 1.39, PBR shading nodes) to and
// from the parameters of the model `chiang`.
#include <string>
#include <string_view>

#include "bsdf/fibre.h"
#include "core/registry/parameter.h"
#include "core/result.h"

namespace cuticle::bsdf {

/// The one chiang_hair_bsdf of a document as settings of the model `chiang`, with words for what the model cannot
/// express (tints, roughness of TT and TRT in other than Chiang's ratios). Inputs that are not given have MaterialX's
/// defaults. `file` names the document in errors. Errors (bad_input) name node, input, value and range: no or several
/// such nodes, a node or input that is not known (with the nearest), a wrong type, a value that is no number or out of
/// range, a connection that leads nowhere or has the wrong type.
Result<FibreMapping> parse_materialx(std::string_view xml, std::string_view file);
/// The same from a file of at most 16 MiB. Error: also bad_input where it cannot be read.
Result<FibreMapping> read_materialx(const std::string& path);

/// A document with a surfacematerial, its surface, chiang_hair_bsdf and chiang_hair_roughness for values of the model
/// `chiang`. Reading it gives eta, sigma_a, beta_m, beta_n and alpha back within 1e-15; MaterialX has no words for its
/// other parameters.
std::string write_materialx(const registry::ParameterValues& values);

}  // namespace cuticle::bsdf
