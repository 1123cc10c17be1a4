// Kernels of lane_kernels.hpp for dense blocks, after those of supernodal_kernels.hpp in each of its files.

/// Rows by which memory is asked ahead: the machine does so by itself, but not across pages of 4 kB, which are 64 rows.
constexpr long kAhead = 32;

/// c += A Bᵀ for a, b (Width × n) and c (Width × Width).
template <int Width>
void inner(const double* a, const double* b, long n, double* c) {
  Entries<Width> sum[Width], x;
  for (int k = 0; k < Width; ++k) sum[k].load(c, k);
  for (long i = 0; i < n; ++i) {
    __builtin_prefetch(a + Width * (i + kAhead));
    x.load(a, i);
    for (int k = 0; k < Width; ++k) sum[k].add(b[Width * i + k], x);
  }
  for (int k = 0; k < Width; ++k) sum[k].store(c, k);
}

/// Y += C X for x, y (Width × n) and c (Width × Width); a few rows at a time, whose sums don't wait for each other.
template <int Width, int Rows>
inline void combine_rows(const Entries<Width>* c, const double* x, double* y) {
  Entries<Width> sum[Rows];
  for (int r = 0; r < Rows; ++r) sum[r].load(y, r);
  for (int k = 0; k < Width; ++k)
    for (int r = 0; r < Rows; ++r) sum[r].add(x[Width * r + k], c[k]);
  for (int r = 0; r < Rows; ++r) sum[r].store(y, r);
}

template <int Width>
void combine(const double* c, const double* x, long n, double* y) {
  Entries<Width> column[Width];
  for (int k = 0; k < Width; ++k) column[k].load(c, k);
  long i = 0;
  for (; i + 8 <= n; i += 8) {
    for (int r = 0; r < 8; ++r) __builtin_prefetch(x + Width * (i + r + kAhead));
    combine_rows<Width, 8>(column, x + Width * i, y + Width * i);
  }
  for (; i < n; ++i) combine_rows<Width, 1>(column, x + Width * i, y + Width * i);
}
