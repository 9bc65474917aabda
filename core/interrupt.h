#pragma once
// Work that can stop between two steps and keep what it has.

namespace cuticle {

/// While one is alive, an interrupt asks the work to stop between two steps; without one it ends the program at once.
class StopsBetweenSteps {
 public:
  StopsBetweenSteps();
  ~StopsBetweenSteps();
  StopsBetweenSteps(const StopsBetweenSteps&) = delete;
  StopsBetweenSteps& operator=(const StopsBetweenSteps&) = delete;
  /// Whether an interrupt has come.
  bool is_asked() const;
};

/// For whoever receives the signals: asks the work to stop. False where none can, or where it was asked before.
bool ask_to_stop();

/// Whether work was asked to stop: what it then reports is no fault of its own.
bool was_asked_to_stop();

}  // namespace cuticle
