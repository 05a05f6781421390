// SPDX-License-Identifier: GPL-3.0-or-later
// Transforms of many columns side by side; compiled once per instruction set (see
// cmake/MortiseIsa.cmake for what that forbids here).
//
// A vector holds the same element of several columns, so that no arithmetic crosses lanes but the
// exchange of real and imaginary part.
#include "fourier/lane_fft_isa.hpp"

#include "core/isa_vector.hpp"

namespace mortise::MORTISE_ISA {
extern const LaneFftTable kLaneFftTable;

namespace {

constexpr int kLanes = kVectorBytes / 4;

using Lanes __attribute__((vector_size(kVectorBytes))) = float;
using Doubles __attribute__((vector_size(kVectorBytes))) = double;

// Real and imaginary parts exchanged.
[[gnu::always_inline]] inline Lanes swapped(const Lanes& v) {
#if defined(__AVX512F__)
  return __builtin_shufflevector(v, v, 1, 0, 3, 2, 5, 4, 7, 6, 9, 8, 11, 10, 13, 12, 15, 14);
#elif defined(__AVX2__)
  return __builtin_shufflevector(v, v, 1, 0, 3, 2, 5, 4, 7, 6);
#else
  return __builtin_shufflevector(v, v, 1, 0, 3, 2);
#endif
}
// (a, b, a, b, ...)
[[gnu::always_inline]] inline Lanes pairs(float a, float b) {
  Lanes v;
  for (int l = 0; l < kLanes; ++l) v[l] = l % 2 == 0 ? a : b;
  return v;
}
[[gnu::always_inline]] inline Lanes pairs_at(const float* p) {
  double both;
  __builtin_memcpy(&both, p, sizeof both);
  Doubles all;
  for (int l = 0; l < kLanes / 2; ++l) all[l] = both;
  Lanes v;
  __builtin_memcpy(&v, &all, sizeof v);
  return v;
}

// cos and sin of 2 pi i / n, by their series within an eighth of a turn.
struct Turn {
  double cos, sin;
};
constexpr Turn turn(int i, int n) {
  constexpr double kPi = 3.14159265358979323846264338327950288;
  double x = 2.0 * kPi * ((i % n + n) % n) / n;
  int quarter = 0;
  for (; x > kPi / 4.0; x -= kPi / 2.0) ++quarter;
  double c = 0.0, s = 0.0, term = 1.0;
  for (int k = 0; k < 24; k += 2) {
    c += term;
    term *= x / (k + 1);
    s += term;
    term *= -x / (k + 2);
  }
  const Turn turns[4] = {{c, s}, {-s, c}, {-c, -s}, {s, -c}};
  return turns[quarter % 4];
}

template <int I>
struct Int {
  static constexpr int value = I;
};

// Calls use(Int<First>{}), ... use(Int<Last>{}).
template <int First, int Last, class Use>
[[gnu::always_inline]] inline void each(const Use& use) {
  if constexpr (First <= Last) {
    use(Int<First>{});
    each<First + 1, Last>(use);
  }
}

// a exp(-+ 2 pi i k / n): - forward.
template <bool Forward, int K, int N>
[[gnu::always_inline]] inline Lanes turned(const Lanes& a) {
  if constexpr (K % N == 0) {
    return a;
  } else {
    constexpr Turn t = turn(Forward ? -K : K, N);
    constexpr auto re = static_cast<float>(t.cos), im = static_cast<float>(t.sin);
    if constexpr (2 * K % N == 0)
      return -a;
    else if constexpr (4 * K % N == 0)
      return swapped(a) * pairs(-im, im);
    else
      return a * re + swapped(a) * pairs(-im, im);
  }
}

// Odd primes: elements mirrored about 0 share their cosines and sines.
template <bool Forward, int N>
[[gnu::always_inline]] inline void dft_prime(Lanes* a) {
  constexpr int kHalf = N / 2;
  Lanes plus[kHalf], minus[kHalf];
  const Lanes first = a[0];
  Lanes sum = first;
  each<0, kHalf - 1>([&](auto j) __attribute__((always_inline)) {
    constexpr int kJ = decltype(j)::value;
    plus[kJ] = a[kJ + 1] + a[N - 1 - kJ];
    minus[kJ] =
        swapped(a[kJ + 1] - a[N - 1 - kJ]) * (Forward ? pairs(1.0F, -1.0F) : pairs(-1.0F, 1.0F));
    sum += plus[kJ];
  });
  a[0] = sum;
  each<1, kHalf>([&](auto k) __attribute__((always_inline)) {
    constexpr int kK = decltype(k)::value;
    Lanes even = first, odd = {};
    each<1, kHalf>([&](auto j) __attribute__((always_inline)) {
      constexpr Turn t = turn(decltype(j)::value * kK, N);
      constexpr auto re = static_cast<float>(t.cos), im = static_cast<float>(t.sin);
      even += re * plus[decltype(j)::value - 1];
      odd += im * minus[decltype(j)::value - 1];
    });
    a[kK] = even + odd;
    a[N - kK] = even - odd;
  });
}

constexpr int first_factor(int n) {
  return n % 4 == 0 && n > 4 ? 4 : n % 2 == 0 ? 2 : n % 3 == 0 ? 3 : n % 5 == 0 ? 5 : n;
}

// In place, in the order of frequencies.
template <bool Forward, int N>
[[gnu::always_inline]] inline void dft(Lanes* a) {
  if constexpr (N == 2) {
    const Lanes sum = a[0] + a[1];
    a[1] = a[0] - a[1];
    a[0] = sum;
  } else if constexpr (first_factor(N) == N) {
    dft_prime<Forward, N>(a);
  } else {
    constexpr int kA = first_factor(N), kB = N / kA;  // element j + B i, frequency k + A m
    Lanes part[kA][kB];
    each<0, kB - 1>([&](auto j) __attribute__((always_inline)) {
      constexpr int kJ = decltype(j)::value;
      Lanes column[kA];
      each<0, kA - 1>([&](auto i) __attribute__((always_inline)) {
        column[decltype(i)::value] = a[kJ + kB * decltype(i)::value];
      });
      dft<Forward, kA>(column);
      each<0, kA - 1>([&](auto k) __attribute__((always_inline)) {
        constexpr int kK = decltype(k)::value;
        part[kK][kJ] = turned<Forward, kJ * kK, N>(column[kK]);
      });
    });
    each<0, kA - 1>([&](auto k) __attribute__((always_inline)) {
      constexpr int kK = decltype(k)::value;
      dft<Forward, kB>(part[kK]);
      each<0, kB - 1>([&](auto m) __attribute__((always_inline)) {
        a[kK + kA * decltype(m)::value] = part[kK][decltype(m)::value];
      });
    });
  }
}

// What one pass needs of a vector of columns. Of the n points, `left` are left to transform,
// `before` = n / left passes' products lie behind.
struct Pass {
  const float* in;
  std::ptrdiff_t in_stride, in_count;
  float* out;
  std::ptrdiff_t out_stride;
  int left, before;
  const float* twiddles;
};

template <bool Forward, int R, bool Last>
void pass(const Pass& w) {
  const std::ptrdiff_t m = w.left / R, s = w.before;
  for (std::ptrdiff_t p = 0; p < m; ++p) {
    const float* const factors = w.twiddles + 4 * (R - 1) * p;
    for (std::ptrdiff_t q = 0; q < s; ++q) {
      Lanes a[R];
      each<0, R - 1>([&](auto t) __attribute__((always_inline)) {
        const std::ptrdiff_t at = q + s * (p + m * decltype(t)::value);
        a[decltype(t)::value] = at < w.in_count ? load<Lanes>(w.in + at * w.in_stride) : Lanes{};
      });
      dft<Forward, R>(a);
      each<0, R - 1>([&](auto u) __attribute__((always_inline)) {
        constexpr int kU = decltype(u)::value;
        Lanes b = a[kU];
        if constexpr (!Last && kU > 0) {
          const float* const f = factors + 4 * (kU - 1);
          b = b * pairs_at(f) + swapped(b) * pairs_at(f + 2);
        }
        store(w.out + (q + s * (R * p + kU)) * w.out_stride, b);
      });
    }
  }
}

template <bool Forward, bool Last>
void run_pass(int radix, const Pass& w) {
  switch (radix) {
    case 2:
      return pass<Forward, 2, Last>(w);
    case 3:
      return pass<Forward, 3, Last>(w);
    case 4:
      return pass<Forward, 4, Last>(w);
    case 5:
      return pass<Forward, 5, Last>(w);
    case 6:
      return pass<Forward, 6, Last>(w);
    case 7:
      return pass<Forward, 7, Last>(w);
    case 8:
      return pass<Forward, 8, Last>(w);
    case 9:
      return pass<Forward, 9, Last>(w);
    case 10:
      return pass<Forward, 10, Last>(w);
    case 12:
      return pass<Forward, 12, Last>(w);
    case 14:
      return pass<Forward, 14, Last>(w);
    case 15:
      return pass<Forward, 15, Last>(w);
    default:
      return pass<Forward, 16, Last>(w);
  }
}

template <bool Forward>
void run_columns(const LaneFftPasses& f, const float* in, std::ptrdiff_t in_stride,
                 std::ptrdiff_t in_count, float* out, std::ptrdiff_t out_stride,
                 std::ptrdiff_t columns, float* work) {
  float* const buffers[2] = {work, work + static_cast<std::ptrdiff_t>(f.n) * kLanes};
  for (std::ptrdiff_t c = 0; c < 2 * columns; c += kLanes) {
    Pass w = {in + c, in_stride, in_count, buffers[0], kLanes, f.n, 1, nullptr};
    for (int i = 0; i + 1 < f.count; ++i) {
      w.out = buffers[i % 2];
      w.out_stride = kLanes;
      w.twiddles = f.twiddles[i];
      run_pass<Forward, false>(f.radix[i], w);
      w.in = w.out;
      w.in_stride = kLanes;
      w.in_count = f.n;
      w.left /= f.radix[i];
      w.before *= f.radix[i];
    }
    w.out = out + c;
    w.out_stride = out_stride;
    run_pass<Forward, true>(f.radix[f.count - 1], w);
  }
}

void run(const LaneFftPasses& passes, bool forward, const float* in, std::ptrdiff_t in_stride,
         std::ptrdiff_t in_count, float* out, std::ptrdiff_t out_stride, std::ptrdiff_t columns,
         float* work) {
  if (forward)
    run_columns<true>(passes, in, in_stride, in_count, out, out_stride, columns, work);
  else
    run_columns<false>(passes, in, in_stride, in_count, out, out_stride, columns, work);
}

template <int... L>
struct Numbers {};
template <int N, int... L>
struct NumbersBelow : NumbersBelow<N - 1, N - 1, L...> {};
template <int... L>
struct NumbersBelow<0, L...> {
  using Type = Numbers<L...>;
};

// Of two vectors whose numbers differ by S the halves that belong together once lanes and vectors
// have changed places in this bit.
template <int N, int S, class V, int... L>
[[gnu::always_inline]] inline void exchange(V& a, V& b, Numbers<L...>) {
  const V low = __builtin_shufflevector(a, b, ((L & S) == 0 ? L : N + L - S)...);
  const V high = __builtin_shufflevector(a, b, ((L & S) == 0 ? L + S : N + L)...);
  a = low;
  b = high;
}

// Lane l of vector i becomes lane i of vector l.
template <int N, int S = 1, class V>
[[gnu::always_inline]] inline void transpose(V* a) {
  if constexpr (S < N) {
    each<0, N - 1>([&](auto i) __attribute__((always_inline)) {
      constexpr int kI = decltype(i)::value;
      if constexpr ((kI & S) == 0)
        exchange<N, S>(a[kI], a[kI + S], typename NumbersBelow<N>::Type{});
    });
    transpose<N, 2 * S>(a);
  }
}

// Up to kLanes rows of n floats, one vector for each column of them.
void gather_rows(const float* in, std::ptrdiff_t stride, std::ptrdiff_t rows, std::ptrdiff_t n,
                 float* out) {
  std::ptrdiff_t z = 0;
  for (; z + kLanes <= n; z += kLanes) {
    Lanes a[kLanes];
    each<0, kLanes - 1>([&](auto i) __attribute__((always_inline)) {
      constexpr int kI = decltype(i)::value;
      a[kI] = kI < rows ? load<Lanes>(in + kI * stride + z) : Lanes{};
    });
    transpose<kLanes>(a);
    each<0, kLanes - 1>([&](auto i) __attribute__((always_inline)) {
      store(out + (z + decltype(i)::value) * kLanes, a[decltype(i)::value]);
    });
  }
  for (; z < n; ++z)
    for (std::ptrdiff_t i = 0; i < kLanes; ++i)
      out[z * kLanes + i] = i < rows ? in[i * stride + z] : 0.0F;
}

void scatter_rows(const float* in, std::ptrdiff_t rows, std::ptrdiff_t n, float* out,
                  std::ptrdiff_t stride) {
  std::ptrdiff_t z = 0;
  for (; z + kLanes <= n; z += kLanes) {
    Lanes a[kLanes];
    each<0, kLanes - 1>([&](auto i) __attribute__((always_inline)) {
      a[decltype(i)::value] = load<Lanes>(in + (z + decltype(i)::value) * kLanes);
    });
    transpose<kLanes>(a);
    each<0, kLanes - 1>([&](auto i) __attribute__((always_inline)) {
      constexpr int kI = decltype(i)::value;
      if (kI < rows) store(out + kI * stride + z, a[kI]);
    });
  }
  for (; z < n; ++z)
    for (std::ptrdiff_t i = 0; i < rows; ++i) out[i * stride + z] = in[z * kLanes + i];
}

constexpr int kPairs = kLanes / 2;  // complex numbers in a vector

[[gnu::always_inline]] inline Doubles as_doubles(const Lanes& v) {
  Doubles d;
  __builtin_memcpy(&d, &v, sizeof d);
  return d;
}
[[gnu::always_inline]] inline Lanes as_lanes(const Doubles& d) {
  Lanes v;
  __builtin_memcpy(&v, &d, sizeof v);
  return v;
}

// Two real rows, 2 c and 2 c + 1, are the real and imaginary parts of column c: with Z its
// transform, their spectra are (Z(k) + Z*(-k)) / 2 and (Z(k) - Z*(-k)) / 2i.
void forward_rows(const LaneFftPasses& f, const float* in, std::ptrdiff_t in_stride,
                  std::ptrdiff_t rows, float* out, std::ptrdiff_t out_stride, float* work) {
  float* const spectra = work + static_cast<std::ptrdiff_t>(f.n) * kLanes;
  float* const more = spectra + static_cast<std::ptrdiff_t>(f.n) * kLanes;
  const Lanes conjugate = pairs(1.0F, -1.0F);
  for (std::ptrdiff_t r = 0; r < rows; r += kLanes) {
    const std::ptrdiff_t count = rows - r < kLanes ? rows - r : kLanes;
    gather_rows(in + r * in_stride, in_stride, count, f.n, work);
    run_columns<true>(f, work, kLanes, f.n, spectra, kLanes, kPairs, more);
    for (std::ptrdiff_t k = 0; k <= f.n / 2; k += kPairs) {
      Doubles even[kPairs], odd[kPairs];
      each<0, kPairs - 1>([&](auto i) __attribute__((always_inline)) {
        constexpr int kI = decltype(i)::value;
        const std::ptrdiff_t at = k + kI;
        Lanes sum = {}, difference = {};
        if (at <= f.n / 2) {
          const Lanes here = load<Lanes>(spectra + at * kLanes);
          const Lanes mirrored =
              load<Lanes>(spectra + (at == 0 ? 0 : f.n - at) * kLanes) * conjugate;
          sum = 0.5F * (here + mirrored);
          difference = 0.5F * swapped(here - mirrored) * conjugate;
        }
        even[kI] = as_doubles(sum);
        odd[kI] = as_doubles(difference);
      });
      transpose<kPairs>(even);
      transpose<kPairs>(odd);
      each<0, kPairs - 1>([&](auto i) __attribute__((always_inline)) {
        constexpr int kI = decltype(i)::value;
        if (2 * kI < count) store(out + (r + 2 * kI) * out_stride + 2 * k, as_lanes(even[kI]));
        if (2 * kI + 1 < count)
          store(out + (r + 2 * kI + 1) * out_stride + 2 * k, as_lanes(odd[kI]));
      });
    }
  }
}

void backward_rows(const LaneFftPasses& f, const float* in, std::ptrdiff_t in_stride,
                   std::ptrdiff_t rows, float* out, std::ptrdiff_t out_stride, float* work) {
  float* const spectra = work + static_cast<std::ptrdiff_t>(f.n) * kLanes;
  float* const more = spectra + static_cast<std::ptrdiff_t>(f.n) * kLanes;
  const Lanes conjugate = pairs(1.0F, -1.0F);
  for (std::ptrdiff_t r = 0; r < rows; r += kLanes) {
    const std::ptrdiff_t count = rows - r < kLanes ? rows - r : kLanes;
    for (std::ptrdiff_t k = 0; k <= f.n / 2; k += kPairs) {
      Doubles even[kPairs], odd[kPairs];
      each<0, kPairs - 1>([&](auto i) __attribute__((always_inline)) {
        constexpr int kI = decltype(i)::value;
        const float* const row = in + (r + 2 * kI) * in_stride + 2 * k;
        even[kI] = 2 * kI < count ? as_doubles(load<Lanes>(row)) : Doubles{};
        odd[kI] = 2 * kI + 1 < count ? as_doubles(load<Lanes>(row + in_stride)) : Doubles{};
      });
      transpose<kPairs>(even);
      transpose<kPairs>(odd);
      each<0, kPairs - 1>([&](auto i) __attribute__((always_inline)) {
        const std::ptrdiff_t at = k + decltype(i)::value;
        if (at > f.n / 2) return;
        Lanes a = as_lanes(even[decltype(i)::value]), b = as_lanes(odd[decltype(i)::value]);
        if (at == 0 || 2 * at == f.n) {
          a *= pairs(1.0F, 0.0F);
          b *= pairs(1.0F, 0.0F);
        }
        // i b = -swapped(b*), i b* = swapped(b).
        store(spectra + at * kLanes, a - swapped(b) * conjugate);
        if (at > 0 && 2 * at < f.n)
          store(spectra + (f.n - at) * kLanes, a * conjugate + swapped(b));
      });
    }
    run_columns<false>(f, spectra, kLanes, f.n, work, kLanes, kPairs, more);
    scatter_rows(work, count, f.n, out + r * out_stride, out_stride);
  }
}

}  // namespace

const LaneFftTable kLaneFftTable = {run, forward_rows, backward_rows};

}  // namespace mortise::MORTISE_ISA
