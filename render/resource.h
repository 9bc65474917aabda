#pragma once
// Kinds of things that the passes of a frame hand to each other, and what a pass says that it does with them.
#include <string_view>

namespace cuticle::render {

/// The name of a resource: each has, beside its declaration, `constexpr std::string_view resource_name(const R*)`.
template <class R>
constexpr std::string_view name_of() {
  return resource_name(static_cast<const R*>(nullptr));
}

enum class Access {
  reads,     ///< cannot run where no pass writes it
  may_read,  ///< asks for it, and runs without it where no pass can write it
  takes,     ///< reads it where another pass or the scene asks for it
  writes,    ///< makes it anew
  changes    ///< adds to what is there: runs after who writes it, before who reads it
};
struct Use {
  std::string_view resource;
  Access access;
  std::string_view for_resource = {};  ///< only where this one is asked for; empty: always
  std::string_view where_fact = {};    ///< only where this fact of the scene holds; empty: always

  template <class R>
  constexpr Use only_for() const {
    return {resource, access, name_of<R>(), where_fact};
  }
  constexpr Use only_where(std::string_view fact) const { return {resource, access, for_resource, fact}; }
};
template <class R>
constexpr Use reads() {
  return {name_of<R>(), Access::reads};
}
template <class R>
constexpr Use may_read() {
  return {name_of<R>(), Access::may_read};
}
template <class R>
constexpr Use takes() {
  return {name_of<R>(), Access::takes};
}
template <class R>
constexpr Use writes() {
  return {name_of<R>(), Access::writes};
}
template <class R>
constexpr Use changes() {
  return {name_of<R>(), Access::changes};
}

}  // namespace cuticle::render
