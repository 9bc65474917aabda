#include "lut/check/mistakes.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include <fmt/format.h>

#include "lut/check/blocks.h"
#include "lut/check/readings.h"

namespace cuticle::lut::check {
namespace {

constexpr double k_explained = 1;  ///< tolerances within which an undone mistake explains every probe
constexpr double k_much_closer =
    0.35;  ///< of the typical misfit: undoing a mistake that rounded in between explains that much

constexpr double k_share_of_compressed = 0.3;

/// A cause that a picture of the right size can be cleared of: reading it so gives the right values.
struct Undo {
  Mistake mistake;
  Reading reading;
  bool exact;  ///< undone without loss
};

double srgb_decoded(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

double srgb_encoded(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

/// The same picture with every number changed.
template <class Change>
Image changed(const Image& image, Change change) {
  Image result = image;
  for (float& value : result.pixels) value = float(change(double(value)));
  return result;
}

/// The same picture with every number of the first three channels changed.
template <class Change>
Image colors_changed(const Image& image, Change change) {
  Image result = image;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < std::min(image.channels(), 3); ++c)
        result.at(x, y, c) = float(change(double(image.at(x, y, c))));
  return result;
}

Reading kept(Image image) {
  return [image = std::move(image)](int channel, double u, double v) { return reading_of(image)(channel, u, v); };
}

/// The ratio wanted / found of the probe where a channel is largest.
std::optional<double> ratio_at_peak(const ManifestTable& table, const Image& image) {
  double largest = 0, ratio = 0;
  for (const Probe& probe : table.probes)
    for (std::size_t c = 0; c < table.channels.size(); ++c) {
      const double wanted = probe.values[c] / table.channels[c].scale;
      const double share = probe.values[c] / std::max(table.channels[c].tolerance, 1e-12);
      const double found = reading_of(image)(int(c), probe.u, probe.v);
      if (share <= largest || !(found > 0) || !std::isfinite(found)) continue;
      largest = share;
      ratio = wanted / found;
    }
  if (largest == 0) return {};
  return ratio;
}

void add_turned(const Image& image, std::vector<Undo>& undos) {
  const Reading at = reading_of(image);
  undos.push_back({{"flipped in v", "with the rows in reverse order every probe reads right",
                    "Import without a vertical flip (flipY = false), or sample at 1 - v: row 0 of the file is v = 0."},
                   [at](int c, double u, double v) { return at(c, u, 1 - v); },
                   true});
  undos.push_back({{"flipped in u", "with the columns in reverse order every probe reads right",
                    "Import without a horizontal flip: column 0 of the file is u = 0."},
                   [at](int c, double u, double v) { return at(c, 1 - u, v); },
                   true});
  undos.push_back({{"turned by 180 degrees", "with rows and columns in reverse order every probe reads right",
                    "Import without turning the picture: the file's top left corner is u = v = 0."},
                   [at](int c, double u, double v) { return at(c, 1 - u, 1 - v); },
                   true});
  undos.push_back({{"u and v swapped", "with rows and columns exchanged every probe reads right",
                    "Address the table by (u, v) as the manifest names the axes: u runs along a row."},
                   [at](int c, double u, double v) { return at(c, v, u); },
                   true});
}

void add_numbers(const ManifestTable& table, const Image& image, std::vector<Undo>& undos) {
  const std::optional<double> ratio = ratio_at_peak(table, image);
  if (!ratio || !(*ratio > 0)) return;
  undos.push_back({{"wrong scale", fmt::format("multiplied by {:.6g}, every probe reads right", *ratio),
                    "Multiply by the manifest's scale of each channel, once; its values are per radian."},
                   kept(changed(image, [ratio](double value) { return value * *ratio; })),
                   true});
}

/// A transfer curve over all channels or over colours alone. Undone exactly where numbers kept their bits, else nearly.
void add_colors(const Image& image, bool exact, std::vector<Undo>& undos) {
  const Mistake decoded{
      "sRGB decoded", "encoded as sRGB again, every probe reads right",
      "Import as data: Unity sRGBTexture off, Unreal sRGB off, three.js NoColorSpace, no source_color."};
  const Mistake encoded{"sRGB encoded", "decoded from sRGB, every probe reads right",
                        "Write the numbers as they are: no gamma, no colour management on export."};
  Mistake linear_alpha = decoded;
  linear_alpha.evidence = "with its colours encoded as sRGB again, and alpha as it is, every probe reads right";
  undos.push_back({decoded, kept(changed(image, srgb_encoded)), exact});
  undos.push_back({encoded, kept(changed(image, srgb_decoded)), exact});
  if (image.channels() < 4) return;
  undos.push_back({linear_alpha, kept(colors_changed(image, srgb_encoded)), exact});
  undos.push_back({encoded, kept(colors_changed(image, srgb_decoded)), exact});
}

/// All other orders of so many channels; those that leave most channels in their place first, since channels alike to
/// within the tolerance fit several.
std::vector<std::vector<int>> other_orders(int channels) {
  std::vector<int> order(static_cast<std::size_t>(channels));
  std::iota(order.begin(), order.end(), 0);
  std::vector<std::vector<int>> orders;
  while (std::next_permutation(order.begin(), order.end())) orders.push_back(order);
  std::ranges::stable_sort(orders, {}, [](const std::vector<int>& one) {
    int moved = 0;
    for (std::size_t c = 0; c < one.size(); ++c) moved += one[c] != int(c);
    return moved;
  });
  return orders;
}

/// Channels in another order.
void add_swapped(const Image& image, std::vector<Undo>& undos) {
  const Reading at = reading_of(image);
  for (const std::vector<int>& order : other_orders(image.channels())) {
    std::string names;
    for (const int c : order) names += std::string(names.empty() ? "" : ", ") + "RGBA"[std::min(c, 3)];
    undos.push_back({{"channels swapped", fmt::format("with the channels read as {} every probe reads right", names),
                      "Keep the file's order R, G, B, A: no BGRA export, no swizzle on import."},
                     [at, order](int c, double u, double v) { return at(order[std::size_t(c)], u, v); },
                     true});
  }
}

/// The picture whose means of neighbours along u (or v) the picture holds. Filtering half a texel beyond the last texel
/// gives that texel itself, so the line is found from there back; `step` is the direction of the filter, 1 or -1.
Image unmixed(const Image& image, int step, bool along_u) {
  Image result = image;
  const int count = along_u ? image.width : image.height, lines = along_u ? image.height : image.width;
  const auto at = [&](Image& picture, int i, int line, int c) -> float& {
    const int along = step > 0 ? count - 1 - i : i;
    return along_u ? picture.at(along, line, c) : picture.at(line, along, c);
  };
  for (int line = 0; line < lines; ++line)
    for (int i = 1; i < count; ++i)
      for (int c = 0; c < image.channels(); ++c)
        at(result, i, line, c) = 2 * at(result, i, line, c) - at(result, i - 1, line, c);
  return result;
}

void add_shifts(const Image& image, std::vector<Undo>& undos) {
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y) {
      if (x == 0 && y == 0) continue;
      Image picture = x == 0 ? image : unmixed(image, x, true);
      if (y != 0) picture = unmixed(picture, y, false);
      undos.push_back({{"half-texel shifted",
                        fmt::format("every texel is filtered {} texel further in u and {} in v", 0.5 * x, 0.5 * y),
                        "Sample at value * scale + bias of the manifest; do not resize or resample the file."},
                       kept(std::move(picture)),
                       false});
    }
}

/// Colours multiplied by alpha: at texel centres, where no filter mixes, they read as the wanted value times alpha. (The
/// product cannot be undone where alpha is 0.)
std::optional<Mistake> premultiplied(const ManifestTable& table, const Image& image) {
  if (table.channels.size() < 4 || image.channels() < 4) return {};
  const Reading at = reading_of(image);
  bool changed = false;
  for (const Probe& probe : table.probes) {
    if (probe.interpolated) continue;
    const double alpha = at(3, probe.u, probe.v);
    for (int c = 0; c < 3; ++c) {
      const ManifestChannel& channel = table.channels[std::size_t(c)];
      const double wanted = probe.values[std::size_t(c)] / channel.scale, tolerance = channel.tolerance / channel.scale;
      if (std::abs(at(c, probe.u, probe.v) - wanted * alpha) > tolerance) return {};
      changed |= std::abs(wanted - wanted * alpha) > tolerance;
    }
  }
  if (!changed) return {};
  return Mistake{"premultiplied alpha", "at every texel centre the colours are the wanted ones times alpha",
                 "Alpha is data: Unity alphaIsTransparency off, three.js premultiplyAlpha = false, Godot "
                 "process/premult_alpha=false, and no export that multiplies by alpha."};
}

/// Whether two channels hold the same numbers.
bool are_equal(const Image& image, int first, int second) {
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (image.at(x, y, first) != image.at(x, y, second)) return false;
  return true;
}

/// A channel that another one was copied over, where the manifest wants different values.
std::optional<Mistake> copied_channel(const ManifestTable& table, const Image& image) {
  for (std::size_t c = 1; c < table.channels.size(); ++c) {
    const auto differs = [c](const Probe& probe) { return probe.values[c] != probe.values[0]; };
    if (std::ranges::any_of(table.probes, differs) && are_equal(image, 0, int(c)))
      return Mistake{"channel dropped",
                     fmt::format("{} holds what {} holds", table.channels[c].name, table.channels[0].name),
                     "Keep all channels: a format of one or two channels, or a grey picture, has no room for them."};
  }
  return {};
}

std::optional<Mistake> missing_channel(const ManifestTable& table, const Image& image) {
  for (std::size_t c = 0; c < table.channels.size(); ++c) {
    const ManifestChannel& channel = table.channels[c];
    const std::string remedy = "Keep all four channels: import alpha as data and choose a format that has it.";
    if (int(c) >= image.channels())
      return Mistake{"channel dropped", fmt::format("the file has no channel for {}", channel.name), remedy};
    const float first = image.at(0, 0, int(c));
    bool constant = true;
    for (int y = 0; y < image.height && constant; ++y)
      for (int x = 0; x < image.width && constant; ++x) constant = image.at(x, y, int(c)) == first;
    if (constant && channel.maximum > 0)
      return Mistake{"channel dropped", fmt::format("{} is {:.6g} everywhere", channel.name, double(first)), remedy};
  }
  return {};
}

std::optional<Mistake> wrong_size(const ManifestTable& table, const Image& image) {
  if (image.width == table.size.x && image.height == table.size.y) return {};
  const std::string evidence =
      fmt::format("the file is {} x {}, the table {} x {}", image.width, image.height, table.size.x, table.size.y);
  return Mistake{"resized", evidence,
                 "Import at the original size: no limit (Unity maxTextureSize), no rounding to a power of two, no "
                 "smaller mip level in place of the first."};
}

/// Probes within 1 read right, and where the manifest wants more the file holds 1.
std::optional<Mistake> clipped(const ManifestTable& table, const Image& image) {
  double largest = 0;
  for (const float value : image.pixels) largest = std::max(largest, double(value));
  bool beyond = false;
  for (const ManifestChannel& channel : table.channels) beyond |= channel.maximum / channel.scale > 1.001;
  if (std::abs(largest - 1) > 1e-3 || !beyond) return {};
  return Mistake{
      "clipped at 1", "nothing in the file is above 1, and the table goes higher",
      "Import as half floats, not as an 8-bit or normalised format; or bake --format png8, which has scales."};
}

/// Whether every number is one that 8 bits hold, in a table that was written with more (whose probes bear 0.2 %, not
/// 0.8 %, of the largest value).
std::optional<Mistake> rounded_to_bytes(const ManifestTable& table, const Image& image) {
  for (const ManifestChannel& channel : table.channels)
    if (channel.tolerance > 0.004 * channel.maximum && channel.maximum > 0) return {};
  const auto is_byte = [](float value) {
    const float bytes = value * 255.F, half_rounding = std::abs(bytes) / 2000.F;
    return std::abs(bytes - std::round(bytes)) < 1e-3F + half_rounding;
  };
  if (!std::ranges::all_of(image.pixels, is_byte)) return {};
  return Mistake{"half precision lost", "every number is a multiple of 1 / 255: 8 bits",
                 "Import as half floats: Unity RGBAHalf, Unreal TC_HDR, Godot and three.js from the EXR itself; or bake "
                 "--format png8."};
}

/// Whether both ends of every row (or column) hold the same numbers.
bool ends_meet(const Image& image, bool rows) {
  const int lines = rows ? image.height : image.width, last = (rows ? image.width : image.height) - 1;
  for (int i = 0; i < lines; ++i)
    for (int c = 0; c < image.channels(); ++c)
      if (rows ? image.at(0, i, c) != image.at(last, i, c) : image.at(i, 0, c) != image.at(i, last, c)) return false;
  return true;
}

std::optional<Mistake> wrapped(const Image& image) {
  const bool rows = image.width > 1 && ends_meet(image, true), columns = image.height > 1 && ends_meet(image, false);
  if (!rows && !columns) return {};
  return Mistake{"wrapped",
                 fmt::format("the first and the last {} hold the same numbers: each mixed with the other",
                             rows ? "column" : "row"),
                 "Clamp to the edge in u and v: Unity wrapMode Clamp, Unreal TA_CLAMP, Godot repeat_disable."};
}

std::optional<Mistake> block_compressed(const Image& image) {
  const double share = share_of_stepped_blocks(image);
  if (share < k_share_of_compressed) return {};
  return Mistake{"block-compressed",
                 fmt::format("{:.0f} % of the 4 x 4 blocks hold equal steps between two ends", 100 * share),
                 "Switch compression off: Unity Compression None, Unreal TC_HDR, Godot VRAM uncompressed."};
}

std::optional<Mistake> enlarged(const Image& image) {
  for (int side = 16; side > 1; side /= 2)
    if (side < std::max(image.width, image.height) && made_of_squares(image, side))
      return Mistake{"mip-mapped", fmt::format("every {0} x {0} square holds one number: a smaller level", side),
                     "Import without mip maps and sample level 0 (textureLod, SampleLevel)."};
  return {};
}

/// The first mistake that leaves a mark of its own.
std::optional<Mistake> marked(const ManifestTable& table, const Image& image) {
  if (auto found = wrapped(image)) return found;
  if (auto found = clipped(table, image)) return found;
  if (auto found = rounded_to_bytes(table, image)) return found;
  if (auto found = enlarged(image)) return found;
  return block_compressed(image);
}

std::optional<Mistake> undone(const ManifestTable& table, const std::vector<Undo>& undos, double typical_before) {
  const Undo* best = nullptr;
  double closest = k_much_closer * typical_before;
  for (const Undo& undo : undos) {
    const Misfit misfit = misfit_of(table, undo.reading);
    if (undo.exact ? misfit.largest > k_explained : misfit.typical >= closest) continue;
    best = &undo;
    closest = misfit.typical;
    if (undo.exact) break;
  }
  if (best == nullptr) return {};
  return best->mistake;
}

}  // namespace

Mistake find_mistake(const ManifestTable& table, const Image& image) {
  if (auto found = wrong_size(table, image)) return *found;
  if (auto found = missing_channel(table, image)) return *found;
  const double before = misfit_of(table, reading_of(image)).typical;
  std::vector<Undo> exact, rounded, shifts;
  add_turned(image, exact);
  add_colors(image, true, exact);
  add_swapped(image, exact);
  add_numbers(table, image, exact);
  add_colors(image, false, rounded);
  add_shifts(image, shifts);
  if (auto found = undone(table, exact, before)) return *found;
  if (auto found = copied_channel(table, image)) return *found;
  if (auto found = premultiplied(table, image)) return *found;
  if (auto found = undone(table, rounded, before)) return *found;
  if (auto found = marked(table, image)) return *found;
  if (auto found = undone(table, shifts, before)) return *found;
  return {"unknown", "no known mistake explains the readings",
          "Bake again and compare; check that manifest and textures belong together."};
}

}  // namespace cuticle::lut::check
