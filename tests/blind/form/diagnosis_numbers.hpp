#pragma once

#include <cstdint>
#include <vector>

#include "blind/held_numbers.hpp"
#include "diagnosis/diagnose.hpp"

namespace twindeck::blind::form {

/// What a diagnosis publishes and what it rests on: the odds and screens of its entries, its fits, tests, sizes, intervals,
/// scales and gains. Names carry the words (verdict, causes), so that another word is another number.
[[nodiscard]] std::vector<HeldNumber> numbers_of(std::uint64_t seed, const diagnosis::Diagnosis& result);

}  // namespace twindeck::blind::form
