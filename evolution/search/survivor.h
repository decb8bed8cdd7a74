#pragma once

#include "evolution/archive/run_archive.h"

namespace menger::evolution {

/// A survivor of a generation: the individual, and its entry in the pool now.
struct Survivor {
  Individual individual;
  PoolMember member;
};

}  // namespace menger::evolution
