// Kernel of lane_kernels.hpp, after those of supernodal_kernels.hpp in each of its files.

/// y += A x: a column of the triangle is a column and a row of A.
template <int Width>
void multiply(const LowerTriangle& a, const double* x, double* y) {
  for (long j = 0; j < a.size; ++j) {
    Entries<Width> here, sum = {}, other, image;
    here.load(x, j);
    for (int k = a.outer[j]; k < a.outer[j + 1]; ++k) {
      const long i = a.inner[k];
      other.load(x, i);
      sum.add(a.value[k], other);
      if (i == j) continue;
      image.load(y, i);
      image.add(a.value[k], here);
      image.store(y, i);
    }
    image.load(y, j);
    image.add(1.0, sum);
    image.store(y, j);
  }
}
