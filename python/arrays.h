#pragma once
// Between numpy arrays and our containers. Errors become ValueError with the message and the hint.
#include <array>
#include <memory>
#include <stdexcept>
#include <vector>

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include "core/result.h"

namespace cuticle::python {

namespace nb = nanobind;

/// A number or an array of any shape.
using Numbers = nb::ndarray<const double, nb::c_contig, nb::device::cpu>;
using OutputArray = nb::ndarray<nb::numpy, double>;

[[noreturn]] void raise(const Error& error);
template <class T>
T value_or_raise(Result<T> result) {
  if (!result) raise(result.error());
  return std::move(result).value();
}

/// The shape that numpy's broadcasting gives. Error: usage, naming the two shapes.
std::vector<std::size_t> broadcast_shape(const std::vector<Numbers>& arrays);
/// Index into `array` of element `flat` of the broadcast shape.
std::size_t broadcast_index(const Numbers& array, const std::vector<std::size_t>& shape, std::size_t flat);

/// A numpy array that owns the vector's memory.
template <class T>
nb::ndarray<nb::numpy, T> take(std::vector<T> values, const std::vector<std::size_t>& shape) {
  auto* kept = new std::vector<T>(std::move(values));
  nb::capsule owner(kept, [](void* pointer) noexcept { delete static_cast<std::vector<T>*>(pointer); });
  return nb::ndarray<nb::numpy, T>(kept->data(), shape.size(), shape.data(), owner);
}

void add_check(nb::module_& module);
void add_evaluate(nb::module_& module);
void add_tables(nb::module_& module);
void add_groom(nb::module_& module);

}  // namespace cuticle::python
