#include "python/arrays.h"

#include <fmt/format.h>

namespace cuticle::python {

namespace {

const char* kind_name(ErrorKind kind) {
  constexpr const char* names[] = {"usage", "bad_input", "no_device", "out_of_memory", "internal"};
  return names[std::size_t(kind)];
}

void set_error(const Error& error) {
  const std::string text = error.hint.empty() ? error.message : fmt::format("{} (try: {})", error.message, error.hint);
  const nb::object type = nb::module_::import_("cuticle._errors").attr("Error");
  const nb::object value = type(text, kind_name(error.kind), error.hint);
  PyErr_SetObject(type.ptr(), value.ptr());
}

}  // namespace

void raise(const Error& error) { throw Failure(error); }

void add_errors(nb::module_&) {
  nb::register_exception_translator([](const std::exception_ptr& thrown, void*) {
    try {
      std::rethrow_exception(thrown);
    } catch (const Failure& failure) {
      set_error(failure.error);
    }
  });
}

std::vector<std::size_t> broadcast_shape(const std::vector<Numbers>& arrays) {
  std::vector<std::size_t> shape;
  for (const Numbers& array : arrays) {
    if (array.ndim() > shape.size()) shape.insert(shape.begin(), array.ndim() - shape.size(), 1);
    const std::size_t lead = shape.size() - array.ndim();
    for (std::size_t axis = 0; axis < array.ndim(); ++axis) {
      std::size_t& length = shape[lead + axis];
      if (length != array.shape(axis) && length != 1 && array.shape(axis) != 1)
        raise(usage_error(
            fmt::format("angles of lengths {} and {} cannot be broadcast together", length, array.shape(axis))));
      if (length == 1) length = array.shape(axis);
    }
  }
  return shape;
}

std::size_t broadcast_index(const Numbers& array, const std::vector<std::size_t>& shape, std::size_t flat) {
  std::size_t index = 0, stride = 1;
  for (std::size_t back = 0; back < shape.size(); ++back) {
    const std::size_t length = shape[shape.size() - 1 - back], position = flat % length;
    flat /= length;
    if (back >= array.ndim()) continue;
    const std::size_t own = array.shape(array.ndim() - 1 - back);
    index += (own == 1 ? 0 : position) * stride;
    stride *= own;
  }
  return index;
}

}  // namespace cuticle::python
