#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "diagnosis/diagnose.hpp"

/// Numbers of whole diagnoses, held where they are: a fault anywhere on the way from the rows to the answer moves some of them,
/// also where the answer stays right.
namespace twindeck::blind::form {

struct HeldNumber {
  std::uint64_t seed = 0;  ///< of the trial
  std::string name;        ///< "cause 1 fric@damper:C1 F_slip low"
  double value = 0.0;
};

/// What a diagnosis publishes and what it rests on: the odds and screens of its entries, its fits, tests, sizes, intervals,
/// scales and gains. Names carry the words (verdict, causes), so that another word is another number.
[[nodiscard]] std::vector<HeldNumber> numbers_of(std::uint64_t seed, const diagnosis::Diagnosis& result);

/// Holds the numbers against those of a file (seed, name, value) and prints what differs. Seeds that did not run are not
/// compared. @return false if one differs, or if the file lacks a seed's numbers @throws InputError if the file cannot be read
[[nodiscard]] bool are_held(const std::vector<HeldNumber>& numbers, const std::filesystem::path& file);

/// The last two words of a command: `--held FILE` compares the numbers of the run with the file, `--hold FILE` writes it anew.
struct Holding {
  std::filesystem::path file;  ///< empty: neither
  bool write = false;
  [[nodiscard]] bool done(const std::vector<HeldNumber>& numbers) const;  ///< false if a number moved
};
[[nodiscard]] Holding holding_of(int& argc, char** argv);  ///< takes the two words away

}  // namespace twindeck::blind::form
