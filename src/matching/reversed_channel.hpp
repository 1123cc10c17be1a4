#pragma once

#include <optional>
#include <string>

#include "matching/comparison.hpp"

namespace twindeck::matching {

/// The channel whose shapes agree with the paired computed ones if its sign is turned, named in a sentence. Turning it has to
/// take away most of what the MACs lack, over all pairs together, and a part that counts. On a sound channel that moves,
/// turning makes things worse.
/// @return nothing where no channel does so, with fewer than two pairs, or with too few channels to tell one from the rest
[[nodiscard]] std::optional<std::string> reversed_channel(const Measured& measured, const Pairing& pairing);

}  // namespace twindeck::matching
