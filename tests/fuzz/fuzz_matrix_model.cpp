/// A matrix model with one file replaced: the first byte says which, the rest is the file.
#include <array>

#include "fuzz/target.hpp"
#include "model_io/any_model_folder.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace twindeck;
  static constexpr std::array names = {"dofs.csv", "model.toml", "K0.mtx", "M0.mtx", "K_base.mtx"};
  if (size == 0) return 0;
  return fuzz::read_folder("matrix/matrix", names[data[0] % names.size()], data + 1, size - 1, [](const auto& folder) {
    static_cast<void>(dynamics::solvable(model_io::read_model_folder(folder)));
  });
}
