#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

/// Fuzz targets: each source fuzz_NAME.cpp gives bytes to one reader by LLVMFuzzerTestOneInput. Built with clang and its
/// libFuzzer they look for new inputs (`make fuzz`); built with any compiler, fuzz_corpus gives them the inputs kept in
/// corpus/NAME.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace twindeck::fuzz {

/// A folder of this process for the files that readers want; it goes with the process.
[[nodiscard]] const std::filesystem::path& scratch();

/// The bytes as a file of the scratch folder. @return its path
std::filesystem::path write_file(const std::string& name, const std::uint8_t* data, std::size_t size);

/// Runs the reader. That it refuses bad input is what it is for; anything else that it throws is a fault and ends the process.
/// @return 0, as libFuzzer wants it
int read_input(const std::function<void()>& reader);

/// The same on a folder in which the bytes stand in the place of one file: a copy of `folder` below tests/broken_inputs/bases,
/// made once, whose own file is put back afterwards.
int read_folder(const std::string& folder, const std::string& file, const std::uint8_t* data, std::size_t size,
                const std::function<void(const std::filesystem::path& folder)>& reader);

}  // namespace twindeck::fuzz
