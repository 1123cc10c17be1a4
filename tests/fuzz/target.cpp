#include "fuzz/target.hpp"

#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <stdexcept>

#include "core/error.hpp"

namespace twindeck::fuzz {
namespace fs = std::filesystem;
namespace {

fs::path g_scratch;

void remove_scratch() {
  std::error_code ignored;
  fs::remove_all(g_scratch, ignored);
}

}  // namespace

const fs::path& scratch() {
  if (g_scratch.empty()) {
    std::string name = (fs::temp_directory_path() / "twindeck_fuzz_XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder can be made");
    g_scratch = name;
    std::atexit(remove_scratch);
  }
  return g_scratch;
}

fs::path write_file(const std::string& name, const std::uint8_t* data, std::size_t size) {
  const fs::path file = scratch() / name;
  std::ofstream out(file, std::ios::binary | std::ios::trunc);
  out.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  if (!out) throw std::runtime_error("cannot write " + file.string());
  return file;
}

int read_input(const std::function<void()>& reader) {
  try {
    reader();
  } catch (const InputError&) {
  } catch (const fs::filesystem_error&) {  // a step ends with exit code 2 by it
  }
  return 0;
}

int read_folder(const std::string& folder, const std::string& file, const std::uint8_t* data, std::size_t size,
                const std::function<void(const fs::path&)>& reader) {
  const fs::path copy = scratch() / folder, aside = scratch() / "aside";
  if (!fs::exists(copy)) {
    fs::create_directories(copy.parent_path());
    fs::copy(fs::path(TWINDECK_SOURCE_DIR) / "tests/broken_inputs/bases" / folder, copy, fs::copy_options::recursive);
  }
  const bool was_there = fs::exists(copy / file);
  if (was_there) fs::rename(copy / file, aside);
  write_file(folder + "/" + file, data, size);
  const int done = read_input([&] { reader(copy); });
  if (was_there) {
    fs::rename(aside, copy / file);
  } else {
    fs::remove(copy / file);
  }
  return done;
}

}  // namespace twindeck::fuzz
