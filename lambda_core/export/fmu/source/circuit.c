/* The circuit: contacts as electric parts as electric/contacts.py has them, and the integration from one end of a step to the
   other. Order and grouping of the arithmetic are those of Python: a run has the same bits. */
#include "image.h"

#if LB_CIRCUIT
#define PI 3.14159265358979323846
#define CONTACTS (2 * LB_BALLS)
#define CONTACT(k, name) REAL(b, LB_CONTACTS + LB_CONTACT_##name + LB_CONTACT_SIZE * (k))
#define TABLE(name, end, k) REAL(b, LB_TABLE_##name + 8 * (CONTACTS * (end) + (k)))
#define PATCHES(end, k) REAL(b, LB_CIRCUIT_PATCHES + 8 * (CONTACTS * (end) + (k)))
#define ANSWER(i, name) REAL(b, LB_CIRCUIT_ANSWERS + 8 * (LB_CIRCUIT_OF_A_BEARING * (i) + LB_CIRCUIT_A_##name))
#define NUMBER(name) REAL(b, LB_CIRCUIT_##name)
#define TOTAL(name) REAL(b, LB_CIRCUIT_TOTAL + 8 * LB_CIRCUIT_T_##name)
#define EVENT(row, name) REAL(b, LB_CIRCUIT_EVENTS + 8 * (LB_CIRCUIT_N_EVENT * (row) + LB_CIRCUIT_E_##name))
#define EACH(k, f) (unsigned k = 2 * (f)->first_ball; k < 2 * ((f)->first_ball + (f)->balls); k++)
#define AT(name, k) REAL(b, LB_CIRCUIT_##name + 8 * (k))

static int loaded(lb_bearing *b, unsigned k) { return CONTACT(k, LOAD) > 0.0; }
static int shorted(lb_bearing *b, unsigned k) { return !isfinite(CONTACT(k, CAPACITANCE)); }
static double area(lb_bearing *b, unsigned k) { return PI * CONTACT(k, SEMI_AXIS_A) * CONTACT(k, SEMI_AXIS_B); }

/* Permittivity of the oil in a film; its mean is that of contacts without one. */
static double oil(lb_bearing *b, unsigned k) { return CONTACT(k, CAPACITANCE_HERTZ) * CONTACT(k, FILM_CENTRAL) / area(b, k); }

static double mean_of_films(lb_bearing *b, const lb_film *f) {
  double total = 0.0, count = 0.0;
  for EACH(k, f)
    if (loaded(b, k) && !shorted(b, k)) total += oil(b, k), count += 1.0;
  return count > 0.0 ? total / count : LB_VACUUM_PERMITTIVITY;
}

/* Size of the ellipse that flux enters an insulating ball through: a/K(m), K by the arithmetic-geometric mean. */
static double entrance(lb_bearing *b, unsigned k) {
  double a = fmax(CONTACT(k, SEMI_AXIS_A), CONTACT(k, SEMI_AXIS_B)), s = fmin(CONTACT(k, SEMI_AXIS_A), CONTACT(k, SEMI_AXIS_B));
  double mean = 1.0, other = s / a;
  for (int i = 0; i < 8; i++) {
    double next = 0.5 * (mean + other);
    other = sqrt(mean * other), mean = next;
  }
  return a * mean / (0.5 * PI);
}

static double mean_of_entrances(lb_bearing *b, const lb_film *f) {
  double total = 0.0, count = 0.0;
  for EACH(k, f)
    if (loaded(b, k)) total += entrance(b, k), count += 1.0;
  return count > 0.0 ? total / count : 1e-6;
}

static void part(lb_bearing *b, const lb_film *f, unsigned k, double between, double through) {
  int metal = shorted(b, k), carried = loaded(b, k) && !metal;
  double squared = CONTACT(k, FILM_PARAMETER) * CONTACT(k, FILM_PARAMETER);
  double rough = f->rough && carried && squared > 1.0 ? CONTACT(k, CAPACITANCE_HERTZ) / (squared - 1.0) : 0.0;
  double capacitance = (metal ? CONTACT(k, CAPACITANCE_HERTZ) : CONTACT(k, CAPACITANCE)) + rough;
  double conductance = metal ? 1.0 / f->metal : f->conductivity * capacitance / (carried ? oil(b, k) : between);
  double film = carried ? CONTACT(k, FILM_CENTRAL) : 0.0;
  if (f->ball_permittivity > 0.0) {
    double size = loaded(b, k) ? entrance(b, k) : through;
    double ball = 2.0 * PI * LB_VACUUM_PERMITTIVITY * f->ball_permittivity * size;
    capacitance = capacitance * ball / (capacitance + ball), conductance = film = 0.0;
  }
  TABLE(CAPACITANCE, 1, k) = capacitance, TABLE(CONDUCTANCE, 1, k) = conductance;
  TABLE(FILM, 1, k) = film, TABLE(THINNEST, 1, k) = CONTACT(k, FILM_MINIMUM), TABLE(AREA, 1, k) = area(b, k);
  PATCHES(1, k) = loaded(b, k) ? fabs(CONTACT(k, ENTRAINMENT)) / (2.0 * CONTACT(k, SEMI_AXIS_B)) : 0.0;
}

void lb_take(lb_bearing *b) {
  for (const lb_film *f = lb_films; f < lb_films + LB_CIRCUIT_BEARINGS; f++) {
    double between = mean_of_films(b, f), through = f->ball_permittivity > 0.0 ? mean_of_entrances(b, f) : 0.0;
    for EACH(k, f) part(b, f, k, between, through);
  }
  AT(TIMES, 1) = REAL(b, LB_CONTROL_TIME);
}

static void keep(lb_bearing *b) {
  for (unsigned k = 0; k < CONTACTS; k++) {
    TABLE(CAPACITANCE, 0, k) = TABLE(CAPACITANCE, 1, k), TABLE(CONDUCTANCE, 0, k) = TABLE(CONDUCTANCE, 1, k);
    TABLE(FILM, 0, k) = TABLE(FILM, 1, k), TABLE(THINNEST, 0, k) = TABLE(THINNEST, 1, k);
    TABLE(AREA, 0, k) = TABLE(AREA, 1, k), TABLE(ROLLED, 0, k) = TABLE(ROLLED, 1, k), PATCHES(0, k) = PATCHES(1, k);
  }
  AT(TIMES, 0) = AT(TIMES, 1);
}

static double source(lb_bearing *b, double time) { return NUMBER(GIVEN) + NUMBER(RATE) * (time - NUMBER(SINCE)); }

static double across(lb_bearing *b, const lb_film *f) {
  return f->node ? AT(POTENTIAL, 0) - AT(POTENTIAL, f->node) : AT(POTENTIAL, 0);
}

static int failed(lb_bearing *b, int64_t status) {
  if (status == LB_CIRCUIT_FULL)
    return lb_say(b, LB_ERROR, "up to t = %.9g s more films break down than there is room for: take shorter steps", lb_time(b));
  return lb_say(b, LB_ERROR, "up to t = %.9g s the circuit cannot be solved (status %lld, of a law %g): are its capacitances "
                "positive, and a law of discharges within its range?", lb_time(b), (long long)status, TOTAL(STATUS));
}

/* What a host asks for of a bearing, of the events of the step. */
static void tell_of(lb_bearing *b, unsigned i, double length) {
  const lb_film *f = lb_films + i;
  double charge = 0.0, peak = 0.0, now = across(b, f), low = AT(EXTREMES, 2 * i), high = AT(EXTREMES, 2 * i + 1);
  for (unsigned n = 0; n < (unsigned)TOTAL(EVENTS); n++)
    if (EVENT(n, BALL) >= f->first_ball && EVENT(n, BALL) < f->first_ball + f->balls)
      charge += fabs(EVENT(n, CHARGE)), peak = fmax(peak, EVENT(n, PEAK));
  ANSWER(i, VOLTAGE) = now, ANSWER(i, LOWEST) = isfinite(low) ? low : now, ANSWER(i, HIGHEST) = isfinite(high) ? high : now;
  ANSWER(i, ARC_CURRENT) = charge / length, ANSWER(i, PEAK) = peak;
}

static void tell(lb_bearing *b, double length, double before) {
  for (unsigned i = 0; i < LB_CIRCUIT_BEARINGS; i++) tell_of(b, i, length);
  NUMBER(SHAFT) = AT(POTENTIAL, 0);
  NUMBER(CURRENT) = NUMBER(WINDING) * (NUMBER(LAST) - AT(POTENTIAL, 0) - before) / length;
}

int lb_conduct(lb_bearing *b) {
  keep(b), lb_take(b);
  double begin = AT(TIMES, 0), end = AT(TIMES, 1), before = NUMBER(LAST) - AT(POTENTIAL, 0);
  for (unsigned k = 0; k < CONTACTS; k++)
    TABLE(ROLLED, 1, k) = TABLE(ROLLED, 0, k) + 0.5 * (PATCHES(1, k) + PATCHES(0, k)) * (end - begin);
  AT(SOURCE_T, 0) = begin, AT(SOURCE_T, 1) = end, AT(SOURCE_V, 0) = source(b, begin), AT(SOURCE_V, 1) = source(b, end);
  WORD(b, LB_CIRCUIT_PLACE) = 0, TOTAL(EVENTS) = TOTAL(TRACE) = 0.0;
  if (WORD(b, LB_CIRCUIT_FIRST)) {
    TOTAL(BEGAN) = begin;
  } else { /* where the source jumps, it puts a charge on the rotor */
    double reached = fmax(begin, TOTAL(TIME)), there = reached < end ? source(b, reached) : AT(SOURCE_V, 1);
    TOTAL(BEGAN) = TOTAL(TIME), AT(CHARGE, 0) += NUMBER(WINDING) * (there - NUMBER(LAST));
  }
  int64_t status = lb_integrate_circuit(b->image);
  if (status != LB_CIRCUIT_OK) return failed(b, status);
  WORD(b, LB_CIRCUIT_FIRST) = 0, NUMBER(LAST) = AT(SOURCE_V, 1);
  tell(b, end - begin, before);
  return LB_OK;
}
#endif
