#pragma once
#include <string>
#include <vector>

#include "lut/format.h"
#include "lut/manifest.h"
#include "lut/table_set.h"

namespace cuticle::lut {

/// Ten values of a table as an engine must read it: five at texel centres (the corners and one inside) and five between
/// texels, two of them on the texture's borders, where only clamping gives them. None lies on another's mirror image.
std::vector<Probe> probes_of(const Table& table);
/// How far a reading of a channel may lie from a probe: what 8 bits of filter weight and half floats cost, and a step
/// and a half of a format of whole numbers, as a share of the largest value.
double probe_tolerance(const Format& format, double maximum);
/// The largest value of a channel.
double channel_maximum(const Table& table, int channel);
/// SHA-256 of a file, 64 hexadecimal digits. Error: bad_input naming the file.
Result<std::string> sha256_of_file(const std::string& path);
/// SHA-256 of a text.
std::string sha256_of(std::string_view text);
/// A manifest's text with the digests of its files in a folder, which a manifest embedded in them cannot have.
Result<std::string> with_digests(const std::string& manifest, const std::string& folder);

}  // namespace cuticle::lut
