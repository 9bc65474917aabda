#pragma once
// Between numpy arrays and our containers. Errors become cuticle.Error, a ValueError with the message, kind and hint.
#include <array>
#include <cstring>
#include <exception>
#include <memory>
#include <string>
#include <vector>

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include "core/result.h"

namespace cuticle::python {

namespace nb = nanobind;

/// A number or an array of any shape.
using Numbers = nb::ndarray<const double, nb::c_contig, nb::device::cpu>;
using OutputArray = nb::ndarray<nb::numpy, double>;
using Floats = nb::ndarray<const float, nb::c_contig, nb::device::cpu>;
using Indices = nb::ndarray<const std::uint32_t, nb::c_contig, nb::device::cpu>;

/// On its way to Python, where it is a cuticle.Error.
struct Failure : std::exception {
  explicit Failure(Error failed) : error(std::move(failed)) {}
  const char* what() const noexcept override { return error.message.c_str(); }
  Error error;
};
[[noreturn]] void raise(const Error& error);
void add_errors(nb::module_& module);
template <class T>
T value_or_raise(Result<T> result) {
  if (!result) raise(result.error());
  return std::move(result).value();
}

inline void require(const Result<void>& result) {
  if (!result) raise(result.error());
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

/// A read-only view of memory that `owner` holds, without its last axis where an item is one number.
template <class T, class Item>
nb::ndarray<nb::numpy, const T> view_of(nb::handle owner, const std::vector<Item>& items) {
  constexpr std::size_t components = sizeof(Item) / sizeof(T);
  const std::size_t shape[2] = {items.size(), components};
  return nb::ndarray<nb::numpy, const T>(reinterpret_cast<const T*>(items.data()), components == 1 ? 1 : 2, shape,
                                         owner);
}

/// Rows of as many numbers as an item has. Error: bad_input, with the shape.
template <class Item, class Array>
std::vector<Item> rows_of(const Array& array, const char* name) {
  using Number = std::remove_const_t<typename Array::Scalar>;
  constexpr std::size_t components = sizeof(Item) / sizeof(Number);
  const bool fits = components == 1 ? array.ndim() == 1 : array.ndim() == 2 && array.shape(1) == components;
  if (!fits)
    raise(bad_input(std::string(name) + ": an array of " + std::to_string(array.ndim()) + " axes and " +
                    std::to_string(array.size()) + " numbers, not of rows of " + std::to_string(components)));
  std::vector<Item> items(array.shape(0));
  if (!items.empty()) std::memcpy(static_cast<void*>(items.data()), array.data(), array.size() * sizeof(Number));
  return items;
}

void add_batch(nb::module_& module);
void add_cards(nb::module_& module);
void add_check(nb::module_& module);
void add_evaluate(nb::module_& module);
void add_fitting(nb::module_& module);
void add_gradients(nb::module_& module);
void add_groom(nb::module_& module);
void add_grooming(nb::module_& module);
void add_registries(nb::module_& module);
void add_render(nb::module_& module);
void add_sampling(nb::module_& module);
void add_shadows(nb::module_& module);
void add_simulation(nb::module_& module);
void add_studies(nb::module_& module);
void add_tables(nb::module_& module);
void add_views(nb::module_& module);

}  // namespace cuticle::python
