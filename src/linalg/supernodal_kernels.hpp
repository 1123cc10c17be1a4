// Kernels of lane_kernels.hpp. Included by one file for each instruction set, inside a namespace of its own, after the file
// has named the set to the compiler, how many numbers a register holds (kLanes) and how many registers may hold sums (kAtOnce);
// so there is no include guard, and nothing else may be included from here.

/// The entries of one row, `Width` numbers side by side, in as many registers as that takes.
template <int Width>
struct Entries {
  static constexpr int lanes = Width < kLanes ? Width : kLanes, count = Width / lanes;
  typedef double Register __attribute__((vector_size(8 * lanes), aligned(8), may_alias));
  Register part[count];

  inline __attribute__((always_inline)) void load(const double* y, long row) {
    for (int p = 0; p < count; ++p) part[p] = *reinterpret_cast<const Register*>(y + Width * row + lanes * p);
  }
  inline __attribute__((always_inline)) void store(double* y, long row) const {
    for (int p = 0; p < count; ++p) *reinterpret_cast<Register*>(y + Width * row + lanes * p) = part[p];
  }
  inline __attribute__((always_inline)) void subtract(double factor, const Entries& other) {
    for (int p = 0; p < count; ++p) part[p] -= factor * other.part[p];
  }
  inline __attribute__((always_inline)) void add(double factor, const Entries& other) {
    for (int p = 0; p < count; ++p) part[p] += factor * other.part[p];
  }
  inline __attribute__((always_inline)) void divide(double divisor) {
    for (int p = 0; p < count; ++p) part[p] /= divisor;
  }
};

/// Rows i … i + Rows - 1 of a block, y_i -= sum_j L_ij y_j over the block's first `columns` columns; where the rows are the
/// block's own (`own`), also their triangle, so that they are solved.
/// @param l  L_i0 of the block  @param stride  the block's height  @param first  its first column  @param row  numbers of the
/// rows
template <int Width, int Rows, bool own>
inline void forward_rows(const double* l, long stride, long first, long columns, const int* row, double* y) {
  Entries<Width> sum[Rows], x;
  for (int r = 0; r < Rows; ++r) sum[r].load(y, row[r]);
  for (long j = 0; j < columns; ++j) {
    x.load(y, first + j);
    const double* column = l + j * stride;
    for (int r = 0; r < Rows; ++r) sum[r].subtract(column[r], x);
  }
  if (own) {
    for (int r = 0; r < Rows; ++r) {
      for (int q = 0; q < r; ++q) sum[r].subtract(l[(columns + q) * stride + r], sum[q]);
      sum[r].divide(l[(columns + r) * stride + r]);
    }
  }
  for (int r = 0; r < Rows; ++r) sum[r].store(y, row[r]);
}

/// All rows from `from` to `to`, by eights where registers suffice, by fours, then what is left.
template <int Width, bool own>
inline void forward_range(const double* l, long stride, long first, long n_own, long from, long to, const int* row, double* y) {
  long i = from;
  const auto columns = [&] { return own ? i : n_own; };
  if constexpr (kAtOnce >= 8 * Entries<Width>::count) {
    for (; i + 8 <= to; i += 8) forward_rows<Width, 8, own>(l + i, stride, first, columns(), row + i, y);
  }
  for (; i + 4 <= to; i += 4) forward_rows<Width, 4, own>(l + i, stride, first, columns(), row + i, y);
  if (i + 2 <= to) forward_rows<Width, 2, own>(l + i, stride, first, columns(), row + i, y), i += 2;
  if (i < to) forward_rows<Width, 1, own>(l + i, stride, first, columns(), row + i, y);
}

/// Columns j … j + Columns - 1 of a block: y_j = (y_j - sum_i L_ij y_i) / L_jj, from the last row upwards.
template <int Width, int Columns>
inline void backward_columns(const double* block, long stride, long first, long j, const int* row, double* y) {
  Entries<Width> sum[Columns], x;
  const double* l = block + j * stride;
  for (int c = 0; c < Columns; ++c) sum[c].load(y, first + j + c);
  for (long i = stride - 1; i >= j + Columns; --i) {
    x.load(y, row[i]);
    for (int c = 0; c < Columns; ++c) sum[c].subtract(l[c * stride + i], x);
  }
  for (int c = Columns - 1; c >= 0; --c) {
    for (int q = Columns - 1; q > c; --q) sum[c].subtract(l[c * stride + j + q], sum[q]);
    sum[c].divide(l[c * stride + j + c]);
  }
  for (int c = 0; c < Columns; ++c) sum[c].store(y, first + j + c);
}

template <int Width>
void sweep(const SupernodalFactor& factor, double* y) {
  for (std::size_t s = 0; s < factor.blocks; ++s) {
    const long first = factor.first_column[s], n_own = factor.first_column[s + 1] - first;
    const long height = factor.row_start[s + 1] - factor.row_start[s];
    const double* l = factor.value + factor.value_start[s];
    const int* row = factor.row + factor.row_start[s];
    forward_range<Width, true>(l, height, first, n_own, 0, n_own, row, y);
    forward_range<Width, false>(l, height, first, n_own, n_own, height, row, y);
  }
  for (std::size_t s = factor.blocks; s-- > 0;) {
    const long first = factor.first_column[s];
    const long height = factor.row_start[s + 1] - factor.row_start[s];
    const double* l = factor.value + factor.value_start[s];
    const int* row = factor.row + factor.row_start[s];
    long j = factor.first_column[s + 1] - first;
    if constexpr (kAtOnce >= 8 * Entries<Width>::count) {
      for (; j >= 8; j -= 8) backward_columns<Width, 8>(l, height, first, j - 8, row, y);
    }
    for (; j >= 4; j -= 4) backward_columns<Width, 4>(l, height, first, j - 4, row, y);
    if (j >= 2) backward_columns<Width, 2>(l, height, first, j - 2, row, y), j -= 2;
    if (j >= 1) backward_columns<Width, 1>(l, height, first, j - 1, row, y);
  }
}
