/* Elementary functions with the same bits on every system, where the C library's differ.

   Written from textbook formulas: reduction of the argument, Taylor and Gregory series until they are below rounding, and
   sums and products of two doubles where one is not enough (Muller, Elementary Functions, 3rd ed. 2016, ch. 4, 9 and
   11; Dekker 1971, Numer. Math. 18, 224). No product and sum may be fused here but those that say so, which are in all
   libraries of a file or in none: compile with -ffp-contract=off, and with -DLB_FUSED where processors have it.
   Errors are below one unit in the last place of exp, log, sin, cos and atan2, two of the others; the test says so. */
#include <stdint.h>

static const double LN2 = 0x1.62e42fefa39efp-1, LN2_REST = 0x1.abc9e3b39803fp-56, LOG2_E = 0x1.71547652b82fep+0;
static const double LN2_SHORT = 0x1.62e42p-1, LN2_BEHIND = 0x1.fdf473de6af28p-22; /* products with exponents are exact */
static const double HALF_PI[] = {0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54, -0x1.f1976b7ed8fbcp-110};
static const double PI = 0x1.921fb54442d18p+1, PI_REST = 0x1.1a62633145c07p-53, TWO_OVER_PI = 0x1.45f306dc9c883p-1;
static const double ARC[9][2] = {/* atan(i/8) */
    {0.0, 0.0}, {0x1.fd5ba9aac2f6ep-4, -0x1.cd37686760c17p-59}, {0x1.f5b75f92c80ddp-3, 0x1.8ab6e3cf7afbdp-57},
    {0x1.6f61941e4def1p-2, -0x1.c63aae6f6e918p-56}, {0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56},
    {0x1.1e00babdefeb4p-1, -0x1.928df287a668fp-58}, {0x1.4978fa3269ee1p-1, 0x1.2419a87f2a458p-56},
    {0x1.700a7c5784634p-1, -0x1.8c34d25aadef6p-56}, {0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55}};

#define INFINITY __builtin_inf()
#define NAN __builtin_nan("")

#if defined(LB_FUSED) && defined(__clang__) && defined(__x86_64__)
#pragma clang attribute push(__attribute__((target("fma"))), apply_to = function)
#elif defined(LB_FUSED) && defined(__x86_64__)
#pragma GCC target("fma")
#endif
#ifdef LB_FUSED
#define FUSED(a, b, c) __builtin_fma(a, b, c)
#else
#define FUSED(a, b, c) ((a) * (b) + (c))
#endif

typedef struct {
  double high, low;
} two; /* their sum */

static uint64_t bits(double x) {
  uint64_t found;
  __builtin_memcpy(&found, &x, 8);
  return found;
}
static double real(uint64_t x) {
  double found;
  __builtin_memcpy(&found, &x, 8);
  return found;
}
static double power_of_two(int k) { return real((uint64_t)(k + 1023) << 52); } /* -1022 to 1023 */
static double nearest(double x) { return (x + 0x1.8p52) - 0x1.8p52; }          /* below 2^51 */
static double copy_sign(double x, double sign) { return real((bits(x) & ~(1ull << 63)) | (bits(sign) & 1ull << 63)); }
static double size(double x) { return real(bits(x) & ~(1ull << 63)); }
static double root(double x) { return __builtin_sqrt(x); }

static two sum(double a, double b) { /* Knuth */
  double s = a + b, c = s - a;
  return (two){s, (a - (s - c)) + (b - c)};
}
#ifdef LB_FUSED
static two product(double a, double b) {
  double g = a * b;
  return (two){g, FUSED(a, b, -g)};
}
#else
static two product(double a, double b) { /* Dekker; below 2^995 */
  double p = 134217729.0 * a, q = 134217729.0 * b, c = p - (p - a), d = q - (q - b), e = a - c, f = b - d, g = a * b;
  return (two){g, ((c * d - g) + c * f + e * d) + e * f};
}
#endif
static two times(two a, two b) {
  two p = product(a.high, b.high);
  p.low += FUSED(a.high, b.low, a.low * b.high);
  return sum(p.high, p.low);
}
static two plus(two a, two b) {
  two s = sum(a.high, b.high);
  s.low += a.low + b.low;
  return sum(s.high, s.low);
}

/* Of series of atanh and atan: 1/3 + z/5 + ... */
static const double ODD[] = {1.0 / 3, 1.0 / 5, 1.0 / 7, 1.0 / 9, 1.0 / 11, 1.0 / 13, 1.0 / 15, 1.0 / 17, 1.0 / 19,
                             1.0 / 21, 1.0 / 23, 1.0 / 25, 1.0 / 27};
static double series(double z, const double *c) { /* twelve terms, in two chains that run beside each other */
  double w = z * z, even = c[10], odd = c[11];
  for (int i = 8; i >= 0; i -= 2) even = FUSED(even, w, c[i]), odd = FUSED(odd, w, c[i + 1]);
  return FUSED(z, odd, even);
}

/* exp(x) - 1 over |x| < 0.35, of a sum. */
static double grow(double x, double rest) {
  static const double c[] = {1.0 / 6, 1.0 / 24, 1.0 / 120, 1.0 / 720, 1.0 / 5040, 1.0 / 40320, 1.0 / 362880,
                             1.0 / 3628800, 1.0 / 39916800, 1.0 / 479001600, 1.0 / 6227020800.0, 1.0 / 87178291200.0};
  double p = series(x, c);
  double more = 0.5 * x * x + x * x * x * p;
  return x + (rest * (1.0 + x + more) + more);
}

static double exp_of(two x) {
  if (x.high != x.high) return x.high;
  if (x.high > 709.8) return INFINITY;
  if (x.high < -745.2) return 0.0;
  double k = nearest(x.high * LOG2_E), a = x.high - k * LN2_SHORT, b = k * LN2_BEHIND, r = a - b;
  double grown = 1.0 + grow(r, ((a - r) - b) + x.low);
  int half = (int)k / 2;
  return grown * power_of_two(half) * power_of_two((int)k - half);
}
double exp(double x) { return exp_of((two){x, 0.0}); }

/* x = 2^k m with m between sqrt(1/2) and sqrt(2). */
static double split(double x, int *k) {
  int shift = x < 0x1p-1022 ? 54 : 0;
  uint64_t b = bits(x * power_of_two(shift)), above = b - 0x3fe6a09e667f3bcdull;
  *k = (int)((int64_t)above >> 52) - shift;
  return real(b - ((above >> 52) << 52));
}

double log(double x) {
  int k;
  if (x < 0.0 || x != x) return x != x ? x : NAN;
  if (x == 0.0) return -INFINITY;
  if (x == INFINITY) return x;
  double f = split(x, &k) - 1.0, s = f / (2.0 + f), z = s * s, r = 2.0 * z * series(z, ODD), h = 0.5 * f * f;
  return k * LN2_SHORT - ((h - (s * (h + r) + k * LN2_BEHIND)) - f);
}

static two log_of(double x) {
  int k;
  double m = split(x, &k);
  two below = sum(m, 1.0);
  double s = (m - 1.0) / below.high;
  two q = product(s, below.high), t = sum(s, ((((m - 1.0) - q.high) - q.low) - s * below.low) / below.high);
  two z = times(t, t);
  two third = {0x1.5555555555555p-2, 0x1.5555555555555p-56};
  two tail = plus(times(z, third), times(z, (two){z.high * series(z.high, ODD + 1), 0.0}));
  two whole = plus(t, times(t, tail));
  two large = product(k, LN2);
  large.low += k * LN2_REST;
  return plus(sum(large.high, large.low), (two){2.0 * whole.high, 2.0 * whole.low});
}

double pow(double x, double y) {
  if (y == 0.0 || x == 1.0) return 1.0;
  if (x != x || y != y) return NAN;
  double a = size(x), sign = 1.0;
  int whole = size(y) >= 0x1p53 || (double)(int64_t)y == y;
  int odd = whole && size(y) < 0x1p53 && ((int64_t)y & 1);
  if (bits(x) >> 63 && odd) sign = -1.0;
  if (a == 0.0 || a == INFINITY) return sign * ((a == 0.0) == (y > 0.0) ? 0.0 : INFINITY);
  if (size(y) == INFINITY) return a == 1.0 ? 1.0 : (a > 1.0) == (y > 0.0) ? INFINITY : 0.0;
  if (x < 0.0 && !whole) return NAN;
  if (size(y) > 0x1p66) return a == 1.0 ? sign : sign * ((a > 1.0) == (y > 0.0) ? INFINITY : 0.0);
  two l = log_of(a), p = product(l.high, y);
  p.low += l.low * y;
  return sign * exp_of(sum(p.high, p.low));
}

/* What is left of x beside multiples of pi/2, and how many of them, below 2^49. */
static two turn(double x, int64_t *quarter) {
  double n = nearest(x * TWO_OVER_PI);
  two r = {x, 0.0};
  for (int i = 0; i < 3; i++) {
    two p = product(n, HALF_PI[i]);
    r = plus(r, (two){-p.high, -p.low});
  }
  *quarter = (int64_t)n;
  return r;
}
static double sine(two y) {
  static const double c[] = {1.0 / 355687428096000.0, -1.0 / 1307674368000.0, 1.0 / 6227020800.0, -1.0 / 39916800.0,
                             1.0 / 362880.0, -1.0 / 5040.0, 1.0 / 120.0};
  double x = y.high, z = x * x, p = -1.0 / 121645100408832000.0;
  for (int i = 0; i < 7; i++) p = FUSED(p, z, c[i]);
  return x + (x * z * (p * z - 1.0 / 6.0) + y.low * (1.0 - 0.5 * z));
}
static double cosine(two y) {
  static const double c[] = {-1.0 / 6402373705728000.0, 1.0 / 20922789888000.0, -1.0 / 87178291200.0,
                             1.0 / 479001600.0, -1.0 / 3628800.0, 1.0 / 40320.0, -1.0 / 720.0, 1.0 / 24.0};
  double z = y.high * y.high, h = 0.5 * z, w = 1.0 - h, p = 1.0 / 2432902008176640000.0;
  for (int i = 0; i < 8; i++) p = FUSED(p, z, c[i]);
  return w + (((1.0 - w) - h) + (z * z * p - y.high * y.low));
}
void sincos(double x, double *s, double *c) {
  int64_t quarter;
  if (!(size(x) < 0x1p49)) { /* an angle of which no digit behind the point is left */
    *s = *c = NAN;
    return;
  }
  two r = turn(x, &quarter);
  double a = sine(r), b = cosine(r);
  *s = quarter & 1 ? b : a, *c = quarter & 1 ? a : b;
  if (quarter & 2) *s = -*s;
  if ((quarter + 1) & 2) *c = -*c;
  if (x == 0.0) *s = x;
}
double sin(double x) {
  double s, c;
  sincos(x, &s, &c);
  return s;
}
double cos(double x) {
  double s, c;
  sincos(x, &s, &c);
  return c;
}
double tan(double x) {
  double s, c;
  sincos(x, &s, &c);
  return s / c;
}

double atan2(double y, double x) {
  if (x != x || y != y) return NAN;
  double a = size(y), b = size(x), up = a > b;
  if (up) a = size(x), b = size(y);
  two r = {0.0, 0.0};
  if (b == INFINITY) {
    r.high = a == INFINITY ? ARC[8][0] : 0.0, r.low = a == INFINITY ? ARC[8][1] : 0.0;
  } else if (a > 0.0) {
    double scale = b > 0x1p500 ? 0x1p-500 : b < 0x1p-500 ? 0x1p500 : 1.0;
    a *= scale, b *= scale;
    double q = a / b;
    two p = product(q, b);
    double rest = ((a - p.high) - p.low) / b;
    int i = (int)(8.0 * q + 0.5);
    double c = 0.125 * i, below = 1.0 + q * c, t = ((q - c) + rest) / below, z = t * t;
    if (i == 0) t = q;
    double g = ODD[0] - z * (ODD[1] - z * (ODD[2] - z * (ODD[3] - z * (ODD[4] - z * (ODD[5] - z * ODD[6])))));
    double more = i == 0 ? rest / below : (((q - c) - t) - t * (q * c) + rest) / below;
    r = sum(ARC[i][0], t);
    r.low += ARC[i][1] + (more - t * z * g);
    r = sum(r.high, r.low);
  }
  if (up) r = plus((two){HALF_PI[0], HALF_PI[1]}, (two){-r.high, -r.low});
  if (bits(x) >> 63) r = plus((two){PI, PI_REST}, (two){-r.high, -r.low});
  return copy_sign(r.high + r.low, y);
}
double atan(double x) { return atan2(x, 1.0); }
double asin(double x) { return atan2(x, root((1.0 - x) * (1.0 + x))); }
double acos(double x) { return atan2(root((1.0 - x) * (1.0 + x)), x); }

double expm1(double x) { return size(x) < 0.34 ? grow(x, 0.0) : exp(x) - 1.0; }
double log1p(double x) {
  double u = 1.0 + x;
  if (u == 1.0 || u == INFINITY) return x;
  return log(u) * (x / (u - 1.0)); /* Kahan */
}
double sinh(double x) {
  double a = size(x), e = expm1(a);
  if (a > 709.0) return copy_sign(0.5 * exp(0.5 * a) * exp(0.5 * a), x);
  return copy_sign(0.5 * (e + e / (e + 1.0)), x);
}
double cosh(double x) {
  double a = size(x), e = exp(0.5 * a);
  return a > 709.0 ? 0.5 * e * e : 0.5 * (exp(a) + 1.0 / exp(a));
}
double tanh(double x) {
  double a = size(x), e = a < 20.0 ? expm1(2.0 * a) : 1e20;
  return x != x ? x : copy_sign(e / (e + 2.0), x);
}
double asinh(double x) {
  double a = size(x), found = a > 0x1p500 ? log(a) + LN2 : log1p(a + a * a / (1.0 + root(a * a + 1.0)));
  return copy_sign(found, x);
}
double acosh(double x) {
  double t = x - 1.0;
  return x > 0x1p500 ? log(x) + LN2 : log1p(t + root(2.0 * t + t * t));
}
double atanh(double x) { return copy_sign(0.5 * log1p(2.0 * size(x) / (1.0 - size(x))), x); }
double exp2(double x) {
  two p = product(x, LN2);
  p.low += x * LN2_REST;
  return size(x) < 1100.0 ? exp_of(p) : exp(x);
}
double log2(double x) { return log(x) * LOG2_E; }
double log10(double x) { return log(x) * 0x1.bcb7b1526e50ep-2; }
double cbrt(double x) { return x == 0.0 || x - x != 0.0 ? x : copy_sign(pow(size(x), 1.0 / 3.0), x); }
double hypot(double x, double y) {
  int longer = size(x) > size(y);
  double a = size(longer ? x : y), b = size(longer ? y : x);
  if (a == 0.0 || a == INFINITY) return a;
  if (a > 0x1p500 || b < 0x1p-500) return a * root(1.0 + (b / a) * (b / a));
  return root(a * a + b * b);
}
#if defined(LB_FUSED) && defined(__clang__) && defined(__x86_64__)
#pragma clang attribute pop
#endif
