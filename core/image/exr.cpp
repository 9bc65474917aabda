#include <exception>
#include <filesystem>

#include <fmt/core.h>
#include <Imath/half.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>

#include "core/file.h"
#include "core/image/detail/picture_library.h"
#include "core/image/image.h"

namespace cuticle {
namespace {

constexpr int k_largest_side = 65536;

Imf::Header make_header(const Image& image, Imf::PixelType type, const std::map<std::string, std::string>& attributes) {
  Imf::Header header(image.width, image.height);
  header.compression() = Imf::ZIP_COMPRESSION;
  for (const std::string& name : image.channel_names) header.channels().insert(name, Imf::Channel(type));
  for (const auto& [name, text] : attributes) header.insert(name, Imf::StringAttribute(text));
  return header;
}

/// Slices of interleaved samples; `base` is the sample of channel 0 at the data window's corner (origin_x, origin_y).
template <class Sample>
Imf::FrameBuffer interleaved(Sample* base, Imf::PixelType type, const std::vector<std::string>& names, int width,
                             Imath::V2i origin) {
  const std::size_t pixel = sizeof(Sample) * names.size();
  Imf::FrameBuffer buffer;
  for (std::size_t c = 0; c < names.size(); ++c) {
    char* first = reinterpret_cast<char*>(base + c);
    char* zero = first - std::ptrdiff_t(pixel) * (std::ptrdiff_t(origin.y) * width + origin.x);
    buffer.insert(names[c], Imf::Slice(type, zero, pixel, pixel * std::size_t(width)));
  }
  return buffer;
}

template <class Sample>
void write_samples(const std::string& path, const Image& image, Imf::PixelType type, std::vector<Sample> samples,
                   const std::map<std::string, std::string>& attributes) {
  Imf::OutputFile file(path.c_str(), make_header(image, type, attributes));
  file.setFrameBuffer(interleaved(samples.data(), type, image.channel_names, image.width, {0, 0}));
  file.writePixels(image.height);
}

std::vector<std::string> channels_of(const Imf::Header& header) {
  std::vector<std::string> names;
  for (auto c = header.channels().begin(); c != header.channels().end(); ++c) names.emplace_back(c.name());
  const bool is_rgb = header.channels().findChannel("R") && header.channels().findChannel("G") && header.channels().findChannel("B");
  if (!is_rgb || names.size() > 4 || names.size() < 3) return names;
  if (names.size() == 3) return {"R", "G", "B"};
  return header.channels().findChannel("A") ? std::vector<std::string>{"R", "G", "B", "A"} : names;
}

Result<Image> read_samples(const std::string& path) {
  Imf::Header::setMaxImageSize(k_largest_side, k_largest_side);
  Imf::InputFile file(path.c_str());
  const Imath::Box2i window = file.header().dataWindow();
  const std::int64_t width = std::int64_t(window.max.x) - window.min.x + 1, height = std::int64_t(window.max.y) - window.min.y + 1;
  const std::vector<std::string> channels = channels_of(file.header());
  CUTICLE_TRY(detail::check_picture(path, {width, height, 1, std::int64_t(channels.size())}));
  Image image = make_image(int(width), int(height), channels);
  file.setFrameBuffer(interleaved(image.pixels.data(), Imf::FLOAT, image.channel_names, image.width, window.min));
  file.readPixels(window.min.y, window.max.y);
  return image;
}

Error exr_error(const std::string& path, const std::exception& error) {
  return bad_input(fmt::format("{}: not a usable EXR file ({})", path, error.what()));
}

}  // namespace

Result<void> write_exr(const std::string& path, const Image& image, ExrType type,
                       const std::map<std::string, std::string>& attributes) {
  if (image.width < 1 || image.height < 1 || image.channels() < 1)
    return bad_input(fmt::format("{}: a picture of {}x{} and {} channels cannot be written", path, image.width, image.height,
                                 image.channels()));
  return write_through_temporary(path, [&](const std::string& name) -> Result<void> {
    try {
      if (type == ExrType::single) write_samples(name, image, Imf::FLOAT, image.pixels, attributes);
      else write_samples(name, image, Imf::HALF, std::vector<Imath::half>(image.pixels.begin(), image.pixels.end()), attributes);
      return {};
    } catch (const std::exception& error) {
      return bad_input(fmt::format("{}: cannot write ({})", path, error.what()), "check the folder and the free space");
    }
  });
}

Result<Image> read_exr(const std::string& path) {
  try {
    return read_samples(path);
  } catch (const std::exception& error) {
    return exr_error(path, error);
  }
}

Result<std::map<std::string, std::string>> read_exr_attributes(const std::string& path) {
  try {
    const Imf::InputFile file(path.c_str());
    std::map<std::string, std::string> attributes;
    for (auto a = file.header().begin(); a != file.header().end(); ++a)
      if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&a.attribute())) attributes[a.name()] = text->value();
    return attributes;
  } catch (const std::exception& error) {
    return exr_error(path, error);
  }
}

}  // namespace cuticle
