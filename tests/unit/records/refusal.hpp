#pragma once

#include <filesystem>
#include <string>

#include "core/error.hpp"
#include "records/record.hpp"

namespace twindeck::records {

/// What is said of a file that is refused as bad input; "" if it is read.
inline std::string refusal(const std::filesystem::path& file) {
  try {
    static_cast<void>(read(file));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace twindeck::records
