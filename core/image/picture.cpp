#include <algorithm>

#include <dlfcn.h>
#include <fmt/core.h>

#include "core/file.h"
#include "core/image/detail/picture_library.h"

namespace cuticle {
namespace {

using detail::PictureLibrary;

/// Found by the run path that a program gets from linking cuticle::core_image; stays loaded.
Result<const PictureLibrary*> load_library() {
  constexpr const char* name = "libcuticle_pictures.so";
  void* const library = dlopen(name, RTLD_NOW | RTLD_LOCAL);
  if (!library)
    return bad_input(fmt::format("{}: cannot be loaded ({})", name, dlerror()),
                     "install it, or name its folder in LD_LIBRARY_PATH");
  const auto entry = reinterpret_cast<const PictureLibrary* (*)()>(dlsym(library, "cuticle_picture_library"));
  if (!entry) return internal_error(fmt::format("{}: {}", name, dlerror()));
  return entry();
}
const Result<const PictureLibrary*>& picture_library() {
  static const Result<const PictureLibrary*> library = load_library();
  return library;
}

template <class Sample>
std::vector<Sample> quantised(const std::vector<float>& pixels, float largest) {
  std::vector<Sample> samples(pixels.size());
  std::transform(pixels.begin(), pixels.end(), samples.begin(), [largest](float value) {
    const float clamped = value > 0.0f ? std::min(value, 1.0f) : 0.0f;
    return Sample(clamped * largest + 0.5f);
  });
  return samples;
}

}  // namespace

Result<void> write_png(const std::string& path, const Image& image, int bits) {
  if (bits != 8 && bits != 16) return usage_error(fmt::format("{}: PNG of {} bits; allowed: 8, 16", path, bits));
  if (image.width < 1 || image.height < 1 || image.channels() < 1 || image.channels() > 4)
    return bad_input(fmt::format("{}: a picture of {}x{} and {} channels cannot be written as PNG (1 .. 4 channels)",
                                 path, image.width, image.height, image.channels()));
  CUTICLE_ASSIGN(const PictureLibrary* library, picture_library());
  return write_through_temporary(path, [&](const std::string& name) -> Result<void> {
    const auto write = [&](const auto& samples) {
      return library->write(name, {image.width, image.height, image.channels(), bits, samples.data()});
    };
    if (bits == 8) return write(quantised<std::uint8_t>(image.pixels, 255.0f));
    return write(quantised<std::uint16_t>(image.pixels, 65535.0f));
  });
}

Result<Image> read_image(const std::string& path) {
  CUTICLE_ASSIGN(const PictureLibrary* library, picture_library());
  return library->read(path, detail::check_picture);
}

Result<int> mip_levels(const std::string& path) {
  CUTICLE_ASSIGN(const PictureLibrary* library, picture_library());
  return library->mip_levels(path);
}

}  // namespace cuticle
