#pragma once
// Numbers of a glTF accessor (glTF 2.0, section 3.6.2).
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace cuticle::strands {

/// Elements whose bytes are known to be there; `component_type` is one of glTF's six.
struct Elements {
  const unsigned char* data = nullptr;
  std::size_t stride = 0, count = 0;
  int component_type = 0;
  bool normalized = false;

  /// A number; of a normalized accessor of whole numbers -1 .. 1 or 0 .. 1.
  double number(std::size_t element, int component) const {
    const auto scaled = [&](double value, double largest) {
      return normalized ? std::max(value / largest, -1.0) : value;
    };
    switch (component_type) {
      case 5120:
        return scaled(raw<std::int8_t>(element, component), 127);
      case 5121:
        return scaled(raw<std::uint8_t>(element, component), 255);
      case 5122:
        return scaled(raw<std::int16_t>(element, component), 32767);
      case 5123:
        return scaled(raw<std::uint16_t>(element, component), 65535);
      case 5125:
        return double(raw<std::uint32_t>(element, component));
      default:
        return double(raw<float>(element, component));
    }
  }

 private:
  template <class T>
  T raw(std::size_t element, int component) const {
    T value;
    std::memcpy(&value, data + element * stride + std::size_t(component) * sizeof(T), sizeof(T));
    return value;
  }
};

}  // namespace cuticle::strands
