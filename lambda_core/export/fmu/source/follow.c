/* Constants that follow options of the case: curves.py made the curves. */
#include "image.h"

/* Polynomial through values at the points of Chebyshev: barycentric formula of the second kind. */
static double curve(const lb_curve *c, double at) {
  const lb_option *o = &lb_options[c->option];
  double above = 0.0, below = 0.0;
  for (unsigned i = 0; i <= c->order; i++) {
    double where = 0.5 * (o->lowest + o->highest) + 0.5 * (o->highest - o->lowest) * cos(3.14159265358979323846 * i / c->order);
    double far = at - where, share = i == 0 || i == c->order ? 0.5 : 1.0;
    if (far == 0.0) return lb_values[c->first + i];
    share = (i % 2 ? -share : share) / far;
    above += share * lb_values[c->first + i];
    below += share;
  }
  return above / below;
}

void lb_follow(lb_bearing *b) {
  for (unsigned i = 0; i < LB_CONSTANTS; i++) {
    const lb_constant *k = &lb_constants[i];
    double found = k->base;
    for (unsigned j = k->first; j < k->first + k->count; j++) {
      double at = REAL(b, LB_VALUES + 8 * lb_curves[j].option);
      if (at == lb_options[lb_curves[j].option].start) continue; /* the case itself, to the last bit */
      double alone = curve(&lb_curves[j], at);
      found = k->scales ? found * (alone / k->base) : found + (alone - k->base);
    }
    REAL(b, k->place) = found;
  }
  WORD(b, LB_STALE) = 1; /* the Jacobian is another one */
}
