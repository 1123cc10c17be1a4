#include "core/samples.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdlib>
#include <new>
#include <string>
#include <utility>

#include "core/error.hpp"

namespace twindeck {

namespace {

/// A file without a name, of the given length; each of its blocks is on the disk, so that no later write finds the disk full.
class ScratchFile {
 public:
  explicit ScratchFile(std::size_t bytes) {
    const char* asked = std::getenv("TMPDIR");
    const std::string folder = asked != nullptr && *asked != '\0' ? asked : "/var/tmp";
    std::string name = folder + "/twindeck_samples_XXXXXX";
    file_ = mkstemp(name.data());
    if (file_ >= 0) unlink(name.c_str());
    if (file_ < 0 || posix_fallocate(file_, 0, static_cast<off_t>(bytes)) != 0) {
      if (file_ >= 0) close(file_);
      throw InputError({folder, 0, ""},
                       fmt::format("has no room for {:.1f} GB of a long record's samples", static_cast<double>(bytes) * 1e-9),
                       "name a folder with more room in the environment variable TMPDIR, or raise decimation");
    }
  }
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;
  ~ScratchFile() { close(file_); }
  [[nodiscard]] int descriptor() const { return file_; }

 private:
  int file_ = -1;
};

double* map_of_a_file(std::size_t bytes) {
  const ScratchFile file(bytes);
  void* memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, file.descriptor(), 0);
  if (memory == MAP_FAILED) throw std::bad_alloc();
  return static_cast<double*>(memory);
}

}  // namespace

void Samples::Release::operator()(double* values) const {
  if (mapped > 0) {
    munmap(values, mapped);
  } else {
    Eigen::aligned_allocator<double>().deallocate(values, 0);
  }
}

void Samples::look_at(Index rows, Index cols) { new (static_cast<Base*>(this)) Base(values_.get(), rows, cols); }

Samples::Samples(Index rows, Index cols, std::size_t most_in_memory) : Base(nullptr, 0, cols) {
  const auto count = static_cast<std::size_t>(rows) * static_cast<std::size_t>(cols), bytes = count * sizeof(double);
  if (bytes > most_in_memory) {
    values_ = {map_of_a_file(bytes), Release{bytes}};
  } else if (count > 0) {
    values_ = {Eigen::aligned_allocator<double>().allocate(count), Release{}};
  }
  look_at(rows, cols);
}

Samples::Samples(Samples&& other) noexcept : Base(nullptr, 0, 0), values_(std::move(other.values_)) {
  look_at(other.rows(), other.cols());
  other.look_at(0, 0);
}

Samples& Samples::operator=(Samples other) noexcept {
  const Index rows = other.rows(), cols = other.cols();
  values_ = std::move(other.values_);
  look_at(rows, cols);
  other.look_at(0, 0);
  return *this;
}

Samples scaled_channels(const Samples& samples, const Eigen::VectorXd& factor) {
  Samples scaled(samples.rows(), samples.cols());
  for (Eigen::Index c = 0; c < samples.cols(); ++c) scaled.col(c) = samples.col(c) * factor[c];
  return scaled;
}

}  // namespace twindeck
