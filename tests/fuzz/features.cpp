#include "fuzz/features.hpp"

#include "diagnosis/files/feature_files.hpp"
#include "fuzz/target.hpp"
#include "records/measured_features.hpp"

namespace twindeck::fuzz {

int read_features(const std::string& name, const std::uint8_t* data, std::size_t size) {
  const std::string folder = "features/features";
  read_folder(folder, name, data, size, [](const auto& at) { static_cast<void>(records::read_measured_features(at, {})); });
  return read_folder(folder, name, data, size, [](const auto& at) { static_cast<void>(diagnosis::read_all_features(at)); });
}

}  // namespace twindeck::fuzz
