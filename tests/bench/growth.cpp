/// Generated models and records for `make growth`, and the product's modes of such a model. Each call is a process of its own,
/// so that its peak memory is its own; seconds are processor time of one thread.
///
///     bench_growth model deck|building DOFS FOLDER     K and M as arrays; prints size and time of the assembly
///     bench_growth modes FOLDER                        15 modes of K and M
///     bench_growth record FILE.npy CHANNELS SAMPLES    the structure of identification_record.hpp, single precision, written
///     in blocks
///
/// prints `name value` lines, as table.py reads them.
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include "bench/cost.hpp"
#include "bench/identification_record.hpp"
#include "fe/structure.hpp"
#include "io/npy.hpp"
#include "linalg/cholesky.hpp"
#include "linalg/generalized_eigen.hpp"
#include "linalg/one_thread.hpp"
#include "npy_double.hpp"

namespace {

using namespace twindeck;
using bench::peak_MB;
using bench::seconds;
using Eigen::Index;
constexpr int kModes = 15;

fe::Model empty_model() {
  fe::Model model;
  model.formulation = {};
  model.materials.push_back({"concrete", 33e9, 33e9 / 2.4, 0.2, 2500.0});
  fe::Section slab{"slab"};
  slab.thickness_m = 0.25;
  fe::Section beam{"beam", 0.18, 5.4e-3, 1.35e-3, 0.0, 3.7e-3};
  model.sections = {slab, beam};
  return model;
}

void add(fe::Model& model, fe::ElementType type, int section, const std::vector<int>& nodes) {
  fe::Element element;
  element.id = static_cast<long>(model.elements.size()) + 1;
  element.type = type;
  element.group = type == fe::ElementType::shell ? "slab" : "beams";
  element.material = 0;
  element.section = section;
  element.nodes = nodes;
  model.elements.push_back(element);
}

/// A slab on girders, eight times as long as wide, on ten lines of bearings: a plane mesh, refined.
fe::Model deck(double dofs) {
  const int wide = std::max(4, static_cast<int>(std::lround(std::sqrt(dofs / 48.0)))), along = 8 * wide;
  const double length_m = 200.0, width_m = 25.0;
  fe::Model model = empty_model();
  const auto node = [&](int i, int j) { return i * (wide + 1) + j; };
  for (int i = 0; i <= along; ++i) {
    for (int j = 0; j <= wide; ++j) model.nodes.push_back({node(i, j) + 1L, {length_m * i / along, width_m * j / wide, 0.0}});
  }
  for (int i = 0; i < along; ++i) {
    for (int j = 0; j < wide; ++j)
      add(model, fe::ElementType::shell, 0, {node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)});
    for (int girder = 0; girder <= 4; ++girder)
      add(model, fe::ElementType::beam, 1, {node(i, girder * wide / 4), node(i + 1, girder * wide / 4)});
  }
  for (int line = 0; line <= 9; ++line) {
    for (int j = 0; j <= wide; ++j) {
      const int at = node(line * along / 9, j);
      model.supports.push_back({"bearing", at, {line == 0, j == 0, true, false, false, false}});
    }
  }
  return model;
}

/// A frame of as many bays either way as storeys, bays of 6 m and 5 m: a mesh in three dimensions, the most that fills in.
fe::Model building(double dofs) {
  const int n = std::max(2, static_cast<int>(std::lround(std::cbrt(dofs / 6.0))) - 1);
  fe::Model model = empty_model();
  const auto node = [&](int i, int j, int k) { return (k * (n + 1) + i) * (n + 1) + j; };
  for (int k = 0; k <= n; ++k) {
    for (int i = 0; i <= n; ++i) {
      for (int j = 0; j <= n; ++j) model.nodes.push_back({node(i, j, k) + 1L, {6.0 * i, 5.0 * j, 3.5 * k}});
    }
  }
  for (int k = 0; k <= n; ++k) {
    for (int i = 0; i <= n; ++i) {
      for (int j = 0; j <= n; ++j) {
        if (k < n) add(model, fe::ElementType::beam, 1, {node(i, j, k), node(i, j, k + 1)});
        if (k > 0 && i < n) add(model, fe::ElementType::beam, 1, {node(i, j, k), node(i + 1, j, k)});
        if (k > 0 && j < n) add(model, fe::ElementType::beam, 1, {node(i, j, k), node(i, j + 1, k)});
      }
    }
  }
  for (int i = 0; i < (n + 1) * (n + 1); ++i) model.supports.push_back({"base", i, {true, true, true, true, true, true}});
  return model;
}

template <typename T>
Eigen::VectorXd column(const T* values, Index n) {
  return Eigen::Map<const Eigen::Matrix<T, Eigen::Dynamic, 1>>(values, n).template cast<double>();
}

/// Columns of the lower triangle: values, rows and where each column begins.
void write_matrix(const linalg::SparseMatrix& a, const std::string& name) {
  io::write_npy(column(a.valuePtr(), a.nonZeros()), name + "_values.npy");
  io::write_npy(column(a.innerIndexPtr(), a.nonZeros()), name + "_rows.npy");
  io::write_npy(column(a.outerIndexPtr(), a.cols() + 1), name + "_begins.npy");
}

linalg::SparseMatrix read_matrix(const std::string& name) {
  const Eigen::VectorXi begins = io::read_npy(name + "_begins.npy").col(0).cast<int>();
  linalg::SparseMatrix a(begins.size() - 1, begins.size() - 1);
  a.resizeNonZeros(begins[begins.size() - 1]);
  std::copy(begins.begin(), begins.end(), a.outerIndexPtr());
  io::visit_npy(name + "_rows.npy", [&](Index row, Index, const Eigen::MatrixXd& block) {
    for (Index i = 0; i < block.rows(); ++i) a.innerIndexPtr()[row + i] = static_cast<int>(block(i, 0));
  });
  io::visit_npy(name + "_values.npy", [&](Index row, Index, const Eigen::MatrixXd& block) {
    for (Index i = 0; i < block.rows(); ++i) a.valuePtr()[row + i] = block(i, 0);
  });
  return a;
}

int write_model(const std::string& family, double dofs, const std::string& folder) {
  const fe::Model model = family == "deck" ? deck(dofs) : building(dofs);
  fe::ParametricSystem system;
  std::printf("assemble_s %.6f\n", seconds([&] {
                const fe::Structure structure(model);
                system = structure.system(structure.prestress(fe::initial_parameters(structure.model())));
              }));
  std::printf("assemble_peak_MB %.1f\ndegrees_of_freedom %ld\n", peak_MB(), static_cast<long>(system.size()));
  const linalg::SparseMatrix stiffness = system.stiffness(system.initial()), mass = system.mass(system.initial());
  std::printf("entries %ld\n", static_cast<long>(stiffness.nonZeros()));
  write_matrix(stiffness, folder + "/K");
  write_matrix(mass, folder + "/M");
  return 0;
}

int modes(const std::string& folder) {
  const linalg::SparseMatrix stiffness = read_matrix(folder + "/K"), mass = read_matrix(folder + "/M");
  linalg::Cholesky factor;
  linalg::EigenPairs pairs;
  std::printf("modes_s %.6f\n", seconds([&] { pairs = linalg::lowest_eigenpairs(stiffness, mass, kModes, 0.0, factor); }));
  if (!pairs.status.converged) return 1;
  std::printf("peak_MB %.1f\nsolves %d\n", peak_MB(), pairs.operations);
  for (int i = 0; i < kModes; ++i)
    std::printf("frequency_%d_Hz %.15g\n", i + 1, std::sqrt(pairs.values[i]) / (2.0 * std::numbers::pi));
  return 0;
}

/// Nearly normal numbers of unit variance at the cost of one draw: four uniform ones of 16 bits, summed.
class QuickNoise {
 public:
  explicit QuickNoise(std::uint64_t seed) : state_(seed) {}
  float operator()() {
    state_ += 0x9E3779B97F4A7C15ULL;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
    z ^= z >> 31;
    const auto sum = static_cast<float>((z & 0xFFFF) + ((z >> 16) & 0xFFFF) + ((z >> 32) & 0xFFFF) + (z >> 48));
    return (sum - 131070.0F) * (1.7320508F / 65536.0F);
  }

 private:
  std::uint64_t state_;
};

std::string npy_header(Index samples, Index channels) {
  std::string text = "{'descr': '<f4', 'fortran_order': False, 'shape': (" + std::to_string(samples) + ", " +
                     std::to_string(channels) + "), }";
  text.append(63 - (10 + text.size()) % 64, ' ');
  text += '\n';
  return std::string("\x93NUMPY\x01\x00", 8) + static_cast<char>(text.size() % 256) + static_cast<char>(text.size() / 256) +
         text;
}

int write_record(const std::string& file, Index channels, Index samples) {
  constexpr Index block = 4096, before = 4000;
  constexpr auto n = static_cast<Index>(bench::kRecordFrequencies_Hz.size());
  QuickNoise random(20261125);
  Eigen::MatrixXf shapes = Eigen::MatrixXf::NullaryExpr(n, channels, [&] { return random(); });
  shapes.array().rowwise() /= shapes.colwise().norm().array();
  std::vector<std::complex<float>> pole(n), state(n);
  std::vector<float> gain(n);
  for (Index m = 0; m < n; ++m) {
    const auto at = static_cast<std::size_t>(m);
    const double omega = 2.0 * std::numbers::pi * bench::kRecordFrequencies_Hz[at], zeta = bench::record_damping(at);
    pole[at] = std::exp(std::complex<double>(-zeta, std::sqrt(1.0 - zeta * zeta)) * omega / bench::kRecordRate_Hz);
    gain[at] = std::sqrt(1.0F - std::norm(pole[at]));
  }
  Eigen::MatrixXf q(block, n);
  const auto step = [&](Index row) {
    for (std::size_t m = 0; m < pole.size(); ++m) {
      const float imaginary = random(), real = random();  // compilers choose the order of a call's arguments
      state[m] = pole[m] * state[m] + std::complex<float>(real, imaginary);
      q(row, static_cast<Index>(m)) = gain[m] * state[m].real();
    }
  };
  for (Index t = 0; t < before; ++t) step(0);
  std::ofstream out(file, std::ios::binary);
  out << npy_header(samples, channels);
  Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rows(block, channels);
  for (Index at = 0; at < samples; at += block) {
    const Index count = std::min(block, samples - at);
    for (Index t = 0; t < count; ++t) step(t);
    rows.noalias() = q * shapes;
    for (Index i = 0; i < rows.size(); ++i) rows.data()[i] += 0.05F * random();
    out.write(reinterpret_cast<const char*>(rows.data()), count * channels * static_cast<Index>(sizeof(float)));
  }
  return out.good() ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string task = argc > 1 ? argv[1] : "";
  linalg::use_one_thread();
  if (task == "model" && argc == 5) return write_model(argv[2], std::atof(argv[3]), argv[4]);
  if (task == "modes" && argc == 3) return modes(argv[2]);
  if (task == "record" && argc == 5) return write_record(argv[2], std::atol(argv[3]), std::atol(argv[4]));
  std::fprintf(stderr,
               "usage: bench_growth model deck|building DOFS FOLDER | modes FOLDER | record FILE.npy CHANNELS SAMPLES\n");
  return 2;
}
