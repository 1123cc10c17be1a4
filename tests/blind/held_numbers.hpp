#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

/// Numbers of whole runs, held where they are: a fault anywhere on the way from the data to the answer moves some of them, also
/// where the answer stays right.
namespace twindeck::blind {

struct HeldNumber {
  std::uint64_t seed = 0;  ///< of the trial
  std::string name;        ///< "cause 1 fric@damper:C1 F_slip low"
  double value = 0.0;
};

/// Numbers of one trial. What is no number is left out: it is missed or new where that changes.
class HeldNumbers {
 public:
  explicit HeldNumbers(std::uint64_t seed) : seed_(seed) {}
  void add(const std::string& name, double value);
  /// A vector by its length and its direction: the sum of its squares, and its product with 1, 2, 3 …
  void add(const std::string& name, const Eigen::Ref<const Eigen::VectorXd>& v);
  [[nodiscard]] const std::vector<HeldNumber>& all() const { return all_; }

 private:
  std::uint64_t seed_;
  std::vector<HeldNumber> all_;
};

/// Where numbers are held. With a file and without `write` they are compared.
struct Holding {
  std::filesystem::path file;  ///< (seed, name, value); empty: nothing is held
  bool write = false;
  /// Compares the numbers with the file and prints what differs, or writes it anew. Seeds that did not run are not compared.
  /// @return false if a number moved, came or went, or if the file has none of these seeds
  /// @throws InputError if the file cannot be read
  [[nodiscard]] bool done(const std::vector<HeldNumber>& numbers) const;
};
/// Takes the last two words of a command away: `--held FILE` compares, `--hold FILE` writes.
[[nodiscard]] Holding holding_of(int& argc, char** argv);

}  // namespace twindeck::blind
