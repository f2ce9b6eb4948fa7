/* What a bearing says where its laws end, as results/limits.py has it: once when it begins, and again when it comes back
   after LB_CALM seconds without it. */
#include "image.h"

#define DEGREES (180.0 / 3.14159265358979323846)
enum { PRESSURE, FILM, HIGH, LOW = HIGH + 2, RIDGE = LOW + 2, SHORT = RIDGE + 2 }; /* events; HIGH, LOW and RIDGE one for each ring */

static const char *const rings[] = {"inner", "outer"};

typedef struct {
  double margin, end, edge; /* along the groove from the ellipse's end to the edge [m], both angles [rad] */
  unsigned ball;
} nearest;

static int begins(lb_bearing *b, const lb_part *p, unsigned event) {
  double now = lb_time(b), *seen = b->seen + LB_EVENTS * (p - lb_parts) + event, before = *seen;
  *seen = now;
  return before != b->looked && fabs(now - before) > LB_CALM;
}

static void take(nearest *found, double end, double edge, double radius, unsigned ball) {
  double margin = (edge - end) * radius;
  if (margin < found->margin) *found = (nearest){margin, end, edge, ball};
}

static void tell_shoulders(lb_bearing *b, const lb_part *p, double most) {
  double thrust = 0.0;
  nearest found[3][2];
  for (int i = 0; i < 6; i++) found[i / 2][i % 2] = (nearest){INFINITY, 0.0, 0.0, 0};
  for (unsigned j = p->first_ball; j < p->first_ball + p->balls; j++)
    for (unsigned k = 0; k < p->contacts; k++) thrust += SAMPLE(j, k, LOAD) * SAMPLE(j, k, CONTACT_ANGLE);
  for (unsigned j = p->first_ball; j < p->first_ball + p->balls; j++)
    for (unsigned k = 0; k < p->contacts; k++) {
      double load = SAMPLE(j, k, LOAD), angle = SAMPLE(j, k, CONTACT_ANGLE);
      unsigned ring = p->ring[k];
      const double *groove = p->grooves[ring]; /* radius, edge, edge between two arcs */
      double half = SAMPLE(j, k, SEMI_AXIS_A) / groove[0], side = thrust > 0.0 ? -1.0 : 1.0;
      if (load > p->least_share * most) take(&found[0][ring], fabs(angle) + half, groove[1], groove[0], j - p->first_ball);
      if (p->one_sided && load > LB_CARRYING * most) take(&found[1][ring], side * angle + half, 0.0, groove[0], j - p->first_ball);
      if (p->ridge && load > LB_CARRYING * most) take(&found[2][ring], half - fabs(angle), -groove[2], groove[0], j - p->first_ball);
    }
  for (unsigned i = 0; i < 2; i++) {
    const nearest *high = &found[0][i], *low = &found[1][i], *ridge = &found[2][i];
    if (high->margin < 0.0 && begins(b, p, HIGH + i))
      lb_say(b, LB_WARNING,
             "%sat t = %.9g s the contact of ball %u runs %.0f um over the %s ring's shoulder (ellipse to %.1f deg, edge at "
             "%.1f deg): computed as if the groove went on",
             p->label, lb_time(b), high->ball + 1, -1e6 * high->margin, rings[i], DEGREES * high->end, DEGREES * high->edge);
    if (low->margin < 0.0 && begins(b, p, LOW + i))
      lb_say(b, LB_WARNING,
             "%sat t = %.9g s the contact of ball %u runs over the low shoulder of the %s ring (ellipse to %.1f deg, where the "
             "groove ends at 0): more axial load holds an angular contact bearing together; computed as if the groove went on",
             p->label, lb_time(b), low->ball + 1, rings[i], DEGREES * low->end);
    if (ridge->margin < 0.0 && begins(b, p, RIDGE + i))
      lb_say(b, LB_WARNING,
             "%sat t = %.9g s the contact of ball %u runs %.0f um over the edge between the arcs of the %s ring (ellipse to "
             "%.1f deg): computed as if each arc went on",
             p->label, lb_time(b), ridge->ball + 1, -1e6 * ridge->margin, rings[i], -DEGREES * ridge->end);
  }
}

static void tell_part(lb_bearing *b, const lb_part *p) {
  double most = 0.0, pressure = 0.0, film = INFINITY, share = 0.0;
  unsigned ball = 0, ring = 0;
  for (unsigned j = p->first_ball; j < p->first_ball + p->balls; j++)
    for (unsigned k = 0; k < p->contacts; k++) {
      if (p->rib[k]) continue; /* the limits are those of raceways */
      double thin = SAMPLE(j, k, FILM_PARAMETER);
      most = fmax(most, SAMPLE(j, k, LOAD)), pressure = fmax(pressure, SAMPLE(j, k, MAX_PRESSURE));
      if (thin > 0.0 && thin < film) film = thin, share = SAMPLE(j, k, ASPERITY_SHARE), ball = j - p->first_ball, ring = p->ring[k];
    }
  if (pressure > p->highest_pressure && begins(b, p, PRESSURE))
    lb_say(b, LB_WARNING,
           "%sat t = %.9g s the contact pressure of %.3g GPa is beyond %g GPa, where steel yields (ISO 76): the contact laws "
           "are elastic",
           p->label, lb_time(b), 1e-9 * pressure, 1e-9 * p->highest_pressure);
  unsigned shorted;
  lb_capacitance(b, p, &shorted);
  if (shorted && begins(b, p, SHORT))
    lb_say(b, LB_WARNING,
           "%sat t = %.9g s metal touches metal on both rings of %u %s%s (Lambda below %g): the rings are connected there, and "
           "bearing.capacitance is that of the others",
           p->label, lb_time(b), shorted, p->element, shorted > 1 ? "s" : "", LB_SHORTED_BELOW);
  if (film < LB_THINNEST_FILM && begins(b, p, FILM))
    lb_say(b, LB_WARNING,
           "%sat t = %.9g s the film parameter Lambda of %.2g at %s %u on the %s ring is below %g: the film is thinner than "
           "the roughness, asperities carry a share of %.2g of the load there",
           p->label, lb_time(b), film, p->element, ball + 1, rings[ring], LB_THINNEST_FILM, share);
  if (p->grooved) tell_shoulders(b, p, most);
}

void lb_tell_limits(lb_bearing *b) {
  for (unsigned i = 0; i < LB_PARTS; i++) tell_part(b, lb_parts + i);
  b->looked = lb_time(b);
}
