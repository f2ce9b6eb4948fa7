#if defined(__x86_64__)
#include <cpuid.h>
#endif
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "image.h"

#define WORK_PER_CALL 500

int lb_say(lb_bearing *b, int status, const char *form, ...) {
  if (!b) return status;
  char sentence[1024];
  va_list rest;
  va_start(rest, form);
  vsnprintf(sentence, sizeof sentence, form, rest);
  va_end(rest);
  if (b->tell && (b->logging || status >= LB_WARNING))
    b->tell(b, status, status >= LB_DISCARD ? "logStatusError" : "logStatusWarning", sentence);
  return status;
}

/* Whether the processor has what the code needs, and the system keeps its wide registers. */
static int fits(void) {
#if defined(__x86_64__)
  unsigned found[4];
  for (size_t i = 0; i < sizeof lb_needs / sizeof *lb_needs; i++) {
    unsigned leaf = lb_needs[i][0], bit = lb_needs[i][2];
    if (!__get_cpuid_count(leaf, 0, &found[0], &found[1], &found[2], &found[3])) return 0;
    if (!(found[lb_needs[i][1]] >> bit & 1)) return 0;
  }
  if (!LB_REGISTERS) return 1;
  unsigned low, high;
  if (!__get_cpuid(1, &found[0], &found[1], &found[2], &found[3]) || !(found[2] >> 27 & 1)) return 0;
  __asm__("xgetbv" : "=a"(low), "=d"(high) : "c"(0));
  return (low & LB_REGISTERS) == LB_REGISTERS;
#else
  return 1; /* the least processor of its kind is enough */
#endif
}

lb_bearing *lb_create(const char *name, void *host, void *logger,
                      void (*tell)(lb_bearing *, int, const char *, const char *)) {
  lb_bearing *b = calloc(1, sizeof *b);
  if (!b) return NULL;
  b->host = host, b->logger = logger, b->tell = tell;
  b->name = malloc(strlen(name ? name : "") + 1);
  b->memory = malloc(LB_IMAGE_SIZE + 64);
  b->seen = malloc(LB_EVENTS * LB_PARTS * sizeof *b->seen);
  if (!b->name || !b->memory || !b->seen) {
    lb_free(b);
    return NULL;
  }
  strcpy(b->name, name ? name : "");
  b->image = (unsigned char *)(((uintptr_t)b->memory + 63) & ~(uintptr_t)63);
  if (!fits()) {
    lb_say(b, LB_ERROR, "this processor lacks what the bearing was exported for: " LB_PROCESSOR);
    lb_free(b);
    return NULL;
  }
  lb_reset(b);
  return b;
}

void lb_free(lb_bearing *b) {
  if (!b) return;
  free(b->memory);
  free(b->seen);
  free(b->name);
  free(b);
}

void lb_reset(lb_bearing *b) {
  memcpy(b->image, lb_image, LB_IMAGE_SIZE);
  lb_address(b->image);
  HOST(b, PHASE) = LB_CREATED;
  HOST(b, TORQUE) = NAN;
  b->stale = 1, b->looked = NAN;
  for (unsigned i = 0; i < LB_EVENTS * LB_PARTS; i++) b->seen[i] = -INFINITY;
}

double lb_time(lb_bearing *b) { return HOST(b, ORIGIN) + REAL(b, LB_CONTROL_TIME); }

int lb_plan(lb_bearing *b, double start) {
  if (!b) return LB_ERROR;
  if (HOST(b, PHASE) != LB_CREATED) return lb_say(b, LB_ERROR, "the start time is given before initialisation, not later");
  if (!isfinite(start)) return lb_say(b, LB_ERROR, "the start time %g is no time", start);
  HOST(b, ORIGIN) = start;
  return LB_OK;
}

int lb_enter(lb_bearing *b) {
  if (!b) return LB_ERROR;
  if (HOST(b, PHASE) != LB_CREATED)
    return lb_say(b, LB_ERROR, "initialisation begins right after instantiation or reset, not later");
  HOST(b, PHASE) = LB_INITIALISING;
  return LB_OK;
}

/* A start with other inputs than the case's has an equilibrium of its own. */
static int settle(lb_bearing *b) {
  if (HOST(b, UNSETTLED) == 0.0) return LB_OK;
  int status = lb_settle(b);
  if (status == LB_OK) HOST(b, UNSETTLED) = 0.0;
  return status;
}

int lb_end(lb_bearing *b) {
  if (!b) return LB_ERROR;
  HOST(b, PHASE) = LB_ENDED;
  return LB_OK;
}

int lb_refused(lb_bearing *b) {
  int64_t role = WORD(b, LB_FAULT_ROLE), ball = WORD(b, LB_FAULT_BALL);
  if (role < 0 || role >= (int64_t)(sizeof lb_roles / sizeof *lb_roles))
    return lb_say(b, LB_ERROR, "at t = %.9g s the forces of the bearing are not finite", lb_time(b));
  return lb_say(b, LB_ERROR,
                "at t = %.9g s the law of %s refuses its inputs (status %lld) at ball %lld: %g, %g, %g, %g", lb_time(b),
                lb_roles[role], (long long)WORD(b, LB_FAULT_STATUS), (long long)ball, REAL(b, LB_FAULT_INPUTS),
                REAL(b, LB_FAULT_INPUTS + 8), REAL(b, LB_FAULT_INPUTS + 16), REAL(b, LB_FAULT_INPUTS + 24));
}

static double sum(lb_bearing *b, unsigned place, unsigned count, unsigned stride) {
  double total = 0.0;
  for (unsigned i = 0; i < count; i++) total += REAL(b, place + i * stride);
  return total;
}

static double extreme(lb_bearing *b, const lb_variable *v) {
  double found = 0.0;
  for (unsigned i = 0; i < v->count; i++) {
    double x = REAL(b, v->place + i * v->stride);
    if (x > 0.0 && (found == 0.0 || (v->kind == LB_LEAST ? x < found : x > found))) found = x;
  }
  return found;
}

/* Contacts of a ball with one ring are side by side, its rings in a row (solver/sampling.py); metal that touches has no
   capacitance, which is infinite there. */
double lb_capacitance(lb_bearing *b, const lb_part *p, unsigned *shorted) {
  double total = 0.0;
  *shorted = 0;
  for (unsigned j = p->first_ball; j < p->first_ball + p->balls; j++) {
    double rings[2] = {0.0, 0.0};
    for (unsigned k = 0; k < p->contacts; k++) rings[p->ring[k]] += SAMPLE(j, k, CAPACITANCE);
    if (isinf(rings[0]) && isinf(rings[1]))
      ++*shorted;
    else
      total += 1.0 / (1.0 / rings[0] + 1.0 / rings[1]);
  }
  return total;
}

int lb_look(lb_bearing *b) {
  if (!b->stale) return LB_OK;
  if (settle(b) != LB_OK) return LB_ERROR;
  if (lb_observe(b->image) != LB_STATUS_OK) return lb_refused(b);
  b->stale = 0, b->sloped = 0;
  lb_tell_limits(b);
  return LB_OK;
}

int lb_leave(lb_bearing *b) {
  if (!b) return LB_ERROR;
  if (HOST(b, PHASE) != LB_INITIALISING)
    return lb_say(b, LB_ERROR, "initialisation has not begun: it cannot end");
  if (settle(b) != LB_OK) return LB_ERROR;
#if LB_CIRCUIT
  if (lb_look(b) != LB_OK) return LB_ERROR;
  lb_take(b);
#endif
  HOST(b, PHASE) = LB_STEPPING;
  return LB_OK;
}

static double weighted(lb_bearing *b, unsigned first, unsigned count) {
  double total = 0.0;
  for (unsigned i = first; i < first + count; i++) total += lb_terms[i].weight * REAL(b, lb_terms[i].place);
  return total;
}

static double torque(lb_bearing *b) {
  double mean = HOST(b, TORQUE), speed = fabs(REAL(b, LB_RELATIVE_SPEED));
  if (isfinite(mean)) return mean;
  return speed > 0.0 ? sum(b, LB_LOSSES, LB_LOSS_COUNT, 8) / speed : 0.0;
}

static double value(lb_bearing *b, const lb_variable *v) {
  unsigned shorted;
  switch (v->kind) {
    case LB_TIME: return lb_time(b);
    case LB_SUM: return v->scale * sum(b, v->place, v->count, v->stride);
    case LB_LEAST:
    case LB_GREATEST: return extreme(b, v);
    case LB_TORQUE: return torque(b);
    case LB_CAPACITANCE: return lb_capacitance(b, lb_parts + v->place, &shorted);
    case LB_SHORTED: return lb_capacitance(b, lb_parts + v->place, &shorted), shorted;
    case LB_WEIGHTED: return weighted(b, v->place, v->count);
    case LB_INPUT:
    case LB_SOURCE:
    case LB_VARIED: return REAL(b, v->place);
    default: return v->scale * REAL(b, v->place);
  }
}

int lb_unknown(lb_bearing *b, unsigned which, const char *kind) {
  return lb_say(b, LB_ERROR, "there is no %s variable with the value reference %u", kind, which);
}

const lb_variable *lb_real(lb_bearing *b, unsigned which) {
  int known = which < LB_VARIABLES && lb_variables[which].kind != LB_COUNT;
  if (!known) lb_unknown(b, which, "real");
  return known ? &lb_variables[which] : NULL;
}

int lb_given(const lb_variable *v) { return v->kind == LB_INPUT || v->kind == LB_SOURCE || v->kind == LB_VARIED; }

int lb_get(lb_bearing *b, const unsigned *which, size_t count, double *values) {
  if (!b) return LB_ERROR;
  for (size_t i = 0; i < count; i++) {
    const lb_variable *v = lb_real(b, which[i]);
    if (!v) return LB_ERROR;
    if (v->kind != LB_TIME && !lb_given(v)) {
      int status = lb_look(b);
      if (status != LB_OK) return status;
    }
    values[i] = value(b, v);
    if (!isfinite(values[i]))
      return lb_say(b, LB_ERROR, "at t = %.9g s %s is %g with these inputs; are loads in N, places in m, speeds in rad/s?",
                    lb_time(b), lb_names[which[i]], values[i]);
  }
  return LB_OK;
}

int lb_get_counts(lb_bearing *b, const unsigned *which, size_t count, int64_t *values) {
  if (!b) return LB_ERROR;
  for (size_t i = 0; i < count; i++) {
    if (which[i] >= LB_VARIABLES || lb_variables[which[i]].kind != LB_COUNT) return lb_unknown(b, which[i], "integer");
    values[i] = WORD(b, lb_variables[which[i]].place);
  }
  return LB_OK;
}

/* Bring what follows an input of a machine to it. */
static void pass_on(lb_bearing *b, unsigned place) {
  for (unsigned i = 0; i < LB_FOLLOWERS; i++) {
    const lb_follower *f = &lb_followers[i];
    double total = 0.0;
    int follows = 0;
    for (unsigned k = f->first; k < f->first + f->count; k++) {
      total += lb_shares[k].weight * REAL(b, lb_shares[k].place);
      follows |= lb_shares[k].place == place;
    }
    if (follows) REAL(b, f->place) = total, REAL(b, f->begin) = REAL(b, LB_CONTROL_TIME);
  }
}

/* Inputs say from when on they hold; what options mean is in curves. */
static void put(lb_bearing *b, const lb_variable *v, double value) {
  int moves = v->kind != LB_SOURCE;
  if (moves && HOST(b, PHASE) < LB_STEPPING && value != REAL(b, v->place)) HOST(b, UNSETTLED) = 1.0;
  REAL(b, v->place) = value;
  if (LB_FOLLOWERS && v->kind == LB_INPUT)
    pass_on(b, v->place);
  else if (v->kind != LB_VARIED)
    REAL(b, v->begin) = REAL(b, LB_CONTROL_TIME);
  if (moves) b->stale = 1;
}

int lb_set(lb_bearing *b, const unsigned *which, size_t count, const double *values) {
  int varies = 0;
  if (!b) return LB_ERROR;
  if (HOST(b, PHASE) == LB_ENDED) return lb_say(b, LB_ERROR, "the simulation has ended: nothing can be set any more");
  for (size_t i = 0; i < count; i++) {
    const lb_variable *v = lb_real(b, which[i]);
    if (!v) return LB_ERROR;
    const char *name = lb_names[which[i]], *unit = lb_units[which[i]];
    if (!lb_given(v)) return lb_say(b, LB_ERROR, "%s is no input: it cannot be set", name);
    if (!isfinite(values[i])) return lb_say(b, LB_ERROR, "%s is to be %g%s: must be finite", name, values[i], unit);
    if (values[i] < v->lowest || values[i] > v->highest)
      return lb_say(b, LB_ERROR, "%s is to be %g%s: it was exported for %g to %g%s", name, values[i], unit, v->lowest,
                    v->highest, unit);
    varies |= v->kind == LB_VARIED && values[i] != REAL(b, v->place);
  }
  for (size_t i = 0; i < count; i++) put(b, &lb_variables[which[i]], values[i]);
  if (varies) lb_follow(b);
  return LB_OK;
}

/* Iterations that lead nowhere: what a host gave was in other units, or its coupling runs away. */
static int astray(lb_bearing *b, double until, int64_t spent) {
  b->stale = 1;
  double pressure = lb_look(b) == LB_OK ? extreme(b, &lb_variables[LB_PRESSURE]) : NAN;
  return lb_say(b, LB_ERROR,
                "at t = %.9g s, on the way to %.9g s, %lld iterations are spent (contact pressure %.3g GPa): forces or motions "
                "that no bearing takes; are loads in N, places in m, speeds in rad/s?",
                lb_time(b), HOST(b, ORIGIN) + until, (long long)spent, 1e-9 * pressure);
}

static int arrive(lb_bearing *b, double until) {
  int64_t before = WORD(b, LB_ITERATIONS);
  double begin = REAL(b, LB_CONTROL_TIME);
  REAL(b, LB_CONTROL_STOP) = until;
  while (REAL(b, LB_CONTROL_TIME) < until) {
    int64_t status = lb_advance(b->image, until, WORK_PER_CALL);
    WORD(b, LB_SAMPLES_WAITING) = 0;
    if (status == LB_STATUS_REFUSED) return lb_refused(b);
    if (status == LB_STATUS_STEP_TOO_SMALL)
      return lb_say(b, LB_ERROR, "at t = %.9g s the integrator's step fell below the smallest one allowed", lb_time(b));
    int64_t spent = WORD(b, LB_ITERATIONS) - before;
    double most = LB_MOST_ITERATIONS + LB_MOST_ITERATIONS_PER_SECOND * (REAL(b, LB_CONTROL_TIME) - begin);
    if (REAL(b, LB_CONTROL_TIME) < until && (double)spent > most) return astray(b, until, spent);
  }
  REAL(b, LB_CONTROL_STOP) = INFINITY;
  return LB_OK;
}

int lb_step(lb_bearing *b, double now, double step) {
  if (!b) return LB_ERROR;
  double begin = lb_time(b), until = now + step - HOST(b, ORIGIN);
  if (HOST(b, PHASE) != LB_STEPPING) return lb_say(b, LB_ERROR, "a step comes between initialisation and the end");
  if (!(isfinite(now) && isfinite(step) && step > 0.0))
    return lb_say(b, LB_ERROR, "a step from t = %g s by %g s: must be positive and finite", now, step);
  if (step > LB_LONGEST_STEP) return lb_say(b, LB_ERROR, "a step of %g s: %g s is the longest at once", step, LB_LONGEST_STEP);
  if (fabs(now - begin) > 1e-6 * step + 1e-12 * fabs(begin))
    return lb_say(b, LB_ERROR, "a step from t = %.9g s, but the bearing stands at %.9g s: %s", now, begin,
                  now < begin ? "to go back, restore a state" : "steps follow each other without a gap");
  if (!(until - REAL(b, LB_CONTROL_TIME) > LB_LOST_STEP))
    return lb_say(b, LB_ERROR, "a step of %g s from t = %.9g s is lost in rounding", step, now);
  b->stale = 1;
  int status = arrive(b, until);
  if (status != LB_OK) return status;
  double lost = sum(b, LB_INTEGRALS, LB_LOSS_COUNT, 8), turned = REAL(b, LB_RELATIVE_ANGLE);
  double angle = turned - HOST(b, TURNED_BEFORE);
  HOST(b, TORQUE) = angle > 0.0 ? (lost - HOST(b, LOST_BEFORE)) / angle : 0.0;
  HOST(b, LOST_BEFORE) = lost, HOST(b, TURNED_BEFORE) = turned;
#if LB_CIRCUIT
  return lb_look(b) == LB_OK ? lb_conduct(b) : LB_ERROR;
#else
  return LB_OK;
#endif
}
