#pragma once
// Result<T>: a value, or an Error that says what, where, the allowed range, and one thing to try.
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "core/expect.h"

namespace cuticle {

/// What went wrong; the command line turns it into its exit codes (docs/cli.md): usage 2, bad_input 3, no_device 4, internal 5.
enum class ErrorKind { usage, bad_input, no_device, out_of_memory, internal };

struct Error {
  ErrorKind kind = ErrorKind::internal;
  std::string message;  ///< one line: what, where (file, field, offset or key), its value, the allowed range
  std::string hint;     ///< one thing to try; may be empty
};

inline Error usage_error(std::string message, std::string hint = {}) {
  return {ErrorKind::usage, std::move(message), std::move(hint)};
}
inline Error bad_input(std::string message, std::string hint = {}) {
  return {ErrorKind::bad_input, std::move(message), std::move(hint)};
}
inline Error internal_error(std::string message) { return {ErrorKind::internal, std::move(message), {}}; }

/// Either a T or an Error. Test it before use; `value()` on an error is a broken promise.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::move(value)) {}
  Result(Error error) : state_(std::move(error)) {}
  explicit operator bool() const { return std::holds_alternative<T>(state_); }
  bool ok() const { return bool(*this); }
  T& value() & { CUTICLE_EXPECT(ok(), error().message.c_str()); return *std::get_if<T>(&state_); }
  const T& value() const& { CUTICLE_EXPECT(ok(), error().message.c_str()); return *std::get_if<T>(&state_); }
  T&& value() && { CUTICLE_EXPECT(ok(), error().message.c_str()); return std::move(*std::get_if<T>(&state_)); }
  T& operator*() & { return value(); }
  const T& operator*() const& { return value(); }
  T&& operator*() && { return std::move(*this).value(); }
  T* operator->() { return &value(); }
  const T* operator->() const { return &value(); }
  const Error& error() const { return *std::get_if<Error>(&state_); }

 private:
  std::variant<T, Error> state_;
};

/// Success, or an Error.
template <>
class [[nodiscard]] Result<void> {
 public:
  Result() = default;
  Result(Error error) : error_(std::move(error)) {}
  explicit operator bool() const { return !error_; }
  bool ok() const { return !error_; }
  const Error& error() const { return *error_; }

 private:
  std::optional<Error> error_;
};

}  // namespace cuticle

/// Leaves the function with the error of `expression`, if it is one (for Result<void>, or where the value is not needed).
#define CUTICLE_TRY(expression)                                       \
  do {                                                                \
    if (auto cuticle_try_ = (expression); !cuticle_try_) return cuticle_try_.error(); \
  } while (false)
/// `CUTICLE_ASSIGN(auto groom, read_groom(file));` declares groom, or leaves the function with the error.
#define CUTICLE_ASSIGN_CAT_(a, b) a##b
#define CUTICLE_ASSIGN_NAME_(line) CUTICLE_ASSIGN_CAT_(cuticle_result_, line)
#define CUTICLE_ASSIGN(declaration, expression)                                          \
  auto CUTICLE_ASSIGN_NAME_(__LINE__) = (expression);                                    \
  if (!CUTICLE_ASSIGN_NAME_(__LINE__)) return CUTICLE_ASSIGN_NAME_(__LINE__).error();     \
  declaration = std::move(CUTICLE_ASSIGN_NAME_(__LINE__)).value()
