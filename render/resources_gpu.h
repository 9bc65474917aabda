#pragma once
// The resources of one frame, each kept by its type.
#include <map>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <string_view>

#include "core/expect.h"
#include "core/progress.h"
#include "render/pass.h"
#include "render/resource.h"

namespace cuticle::render {

class Resources {
 public:
  /// With what a scene always gives, at its defaults.
  Resources();
  /// Replaces what is there of this type.
  template <class R>
  void put(R value) {
    held_[name_of<R>()] = std::make_shared<R>(std::move(value));
  }
  /// Where it is owned by a pass, which outlives the resources.
  template <class R>
  void put_reference(const R& value) {
    held_[name_of<R>()] = std::shared_ptr<void>(std::shared_ptr<void>(), const_cast<R*>(&value));
  }
  template <class R>
  void take_out() {
    held_.erase(name_of<R>());
  }
  /// Null: no pass writes it.
  template <class R>
  const R* find() const {
    note_use(name_of<R>());
    const auto found = held_.find(name_of<R>());
    return found == held_.end() ? nullptr : static_cast<const R*>(found->second.get());
  }
  /// One that the plan promises.
  template <class R>
  const R& get() const {
    const R* const found = find<R>();
    CUTICLE_EXPECT(found, "a resource is read that no pass of the plan writes");
    return *found;
  }
  /// To be changed between passes; made with its defaults where it is not there. Not of one that a pass owns.
  template <class R>
  R& edit() {
    if (!held_.contains(name_of<R>())) put(R{});
    return *static_cast<R*>(held_[name_of<R>()].get());
  }

  /// Whether a pass of the plan, or the scene, reads a resource: its writer may leave it out otherwise.
  template <class R>
  bool wants() const {
    return wanted_.contains(name_of<R>());
  }
  template <class R>
  void want() {
    want(name_of<R>());
  }
  void want(std::string_view resource) { wanted_.emplace(resource); }

  /// From here on only the resources that `pass` declares are expected to be read.
  void begin_uses(std::string_view pass, std::span<const Use> uses) {
    user_ = pass;
    uses_ = uses;
  }
  void end_uses() { user_ = {}; }
  /// What passes used without having declared it, one sentence each.
  const std::set<std::string>& undeclared() const { return undeclared_; }

  PassParameters parameters;
  Progress* progress = nullptr;  ///< of what passes make once; null: silent

 private:
  void note_use(std::string_view resource) const;

  std::map<std::string_view, std::shared_ptr<void>, std::less<>> held_;
  std::set<std::string, std::less<>> wanted_;
  std::string_view user_;  ///< empty: anything may be read
  std::span<const Use> uses_;
  mutable std::set<std::string> undeclared_;
};

/// The parameters of a pass in this frame.
template <class Parameters>
Parameters parameters_of(const Resources& resources) {
  return parameters_of<Parameters>(resources.parameters);
}

}  // namespace cuticle::render
