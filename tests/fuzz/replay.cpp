/// fuzz_corpus FOLDER [TARGET …]: gives every fuzz target its kept inputs, FOLDER/TARGET/*, with whatever compiler this was
/// built by. A target that crashes, throws or takes longer than ten seconds ends the program; what it was given stands on the
/// last line.
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "fuzz/targets.hpp"

namespace {

namespace fs = std::filesystem;

constexpr unsigned kMostSeconds = 10;  // as -timeout of `make fuzz`

std::vector<fs::path> inputs_of(const fs::path& folder) {
  std::vector<fs::path> files;
  if (!fs::is_directory(folder)) return files;
  for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

std::size_t replay(const Target& target, const fs::path& folder) {
  const std::vector<fs::path> files = inputs_of(folder / target.name);
  for (const fs::path& file : files) {
    std::ifstream in(file, std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    std::printf("%s\n", file.c_str());
    std::fflush(stdout);
    ::alarm(kMostSeconds);
    target.run(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
    ::alarm(0);
  }
  return files.size();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "fuzz_corpus: give the folder of the kept inputs\n");
    return 2;
  }
  const std::vector<std::string> asked(argv + 2, argv + argc);
  bool complete = true;
  std::string summary;
  for (const Target& target : targets()) {
    if (!asked.empty() && std::find(asked.begin(), asked.end(), target.name) == asked.end()) continue;
    const std::size_t count = replay(target, argv[1]);
    summary += std::string(target.name) + ": " + std::to_string(count) + " inputs\n";
    complete = complete && count > 0;
  }
  std::fputs(summary.c_str(), stdout);
  if (!complete) std::fprintf(stderr, "fuzz_corpus: a target has no inputs\n");
  return complete ? 0 : 1;
}
