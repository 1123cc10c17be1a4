/// A model folder with one file replaced: the first byte says which, the rest is the file. Read, and made into a structure.
#include <array>

#include "fuzz/target.hpp"
#include "model_io/any_model_folder.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace twindeck;
  static constexpr std::array names = {"nodes.csv",    "elements.csv", "materials.csv",  "sections.csv",
                                       "supports.csv", "springs.csv",  "links.csv",      "masses.csv",
                                       "points.csv",   "model.toml",   "constraints.csv"};
  if (size == 0) return 0;
  return fuzz::read_folder("model/model", names[data[0] % names.size()], data + 1, size - 1, [](const auto& folder) {
    static_cast<void>(dynamics::solvable(model_io::read_model_folder(folder)));
  });
}
