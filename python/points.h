#pragma once
// Points of evaluation from broadcast arrays of degrees.
#include <mutex>
#include <optional>

#include "bsdf/model.h"

#include "python/arrays.h"

namespace cuticle::python {

/// Reads points of the broadcast shape in any order, from any thread.
class PointReader {
 public:
  /// theta_i, theta_o, theta_d, phi, h, phi_o; angles in degrees.
  PointReader(const std::vector<Numbers>& coordinates, const std::vector<std::size_t>& shape);
  std::size_t count() const { return count_; }
  /// One coordinate of points from `first` on, in the caller's own unit (degrees). Error: bad_input, naming argument,
  /// value and range.
  Result<void> read_column(double bsdf::Point::*member, std::size_t first, std::span<double> out) const;
  /// Points first .. first + count - 1 into `out`. Error: bad_input, naming argument, value and range.
  Result<void> read(std::size_t first, std::size_t count, std::vector<bsdf::Point>& out) const;

 private:
  struct Source {
    const double* data = nullptr;
    std::vector<std::size_t> strides;  ///< of the shape's axes, in numbers; 0: the same all along
    bool is_constant = false, is_whole = false;
  };
  template <class Put>
  Result<void> each(std::size_t coordinate, std::size_t first, std::size_t count, const Put& put) const;

  std::vector<Source> sources_;
  std::vector<std::size_t> shape_;
  std::size_t count_ = 1;
};

/// A buffer of this thread that keeps its memory.
std::vector<bsdf::Point>& scratch_points();

/// What went wrong first in some thread.
class FirstError {
 public:
  void set(const Error& error) {
    const std::lock_guard lock(mutex_);
    if (!error_) error_ = error;
  }
  Result<void> result() const { return error_ ? Result<void>(*error_) : Result<void>(); }

 private:
  std::mutex mutex_;
  std::optional<Error> error_;
};

}  // namespace cuticle::python
