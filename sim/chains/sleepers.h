#pragma once
// Which strands of a solver of rigid links sleep. They are left bit for bit as they are; a block of which all strands
// sleep is not walked at all.
#include <tbb/enumerable_thread_specific.h>

#include "sim/chains/chains.h"

namespace cuticle::sim::chains {

template <class Real>
class Sleepers {
 public:
  explicit Sleepers(const sleep::Settings& settings) : settings_(settings) {}
  /// Before a frame of a block: whether it must be walked. `woken`: a bit for each lane that something acts on anew.
  /// `own`: the rows that a solver adds, own_rows to a vertex.
  bool begin(Chains<Real>& chains, std::size_t block, std::uint32_t woken, std::span<const Real> own);
  /// After it: sleeping strands as they were; those at rest for long enough, and not reset in it, fall asleep, without
  /// velocity.
  void end(Chains<Real>& chains, std::size_t block, double duration, std::span<Real> own);
  std::uint32_t count(const Chains<Real>& chains) const;

 private:
  /// What a thread keeps of a block of which some strands sleep.
  struct Kept {
    std::uint32_t woken = 0, asleep = 0;  ///< a bit for each lane
    Rows<Real> state, strand, own;
  };
  std::uint32_t asleep(const Chains<Real>& chains, std::size_t block) const;

  sleep::Settings settings_;
  tbb::enumerable_thread_specific<Kept> kept_;
};

}  // namespace cuticle::sim::chains
