/* Directional derivatives: of what can be read with what a host sets, at this communication point (FMI 2.0.4, 2.1.9).

   While a bearing steps its states stand: reactions with the motion of rings come from the solver's Jacobian, everything
   else from central differences. Before, outputs follow from the inputs by the equilibrium, which is found anew beside
   the start: the balls have followed. */
#include <stdlib.h>
#include <string.h>

#include "image.h"

#define BESIDE_START 100.0 /* steps of differences are so much longer there: an equilibrium is found to a tolerance */

#if LB_SLOPES
/* The slopes of the forces on all bodies with their states, once for a moment. */
static int differentiate(lb_bearing *b) {
  if (b->sloped) return LB_OK;
  double *state = &REAL(b, LB_SLOPE_STATE);
  memcpy(state, b->image + LB_STATE, LB_ELEMENT_STATES_SIZE);
  state += LB_ELEMENT_STATES_SIZE / sizeof *state;
  for (size_t i = 0; i < sizeof lb_slope_states / sizeof *lb_slope_states; i++)
    *state++ = REAL(b, LB_SHARED + 8 * lb_slope_states[i]);
  memcpy(state, b->image + LB_CONTACT_STATES, LB_CONTACT_STATES_SIZE);
  if (lb_jacobian(b->image, REAL(b, LB_CONTROL_TIME)) != LB_STATUS_OK) return lb_refused(b);
  b->sloped = 1;
  return LB_OK;
}

static double by_jacobian(lb_bearing *b, const lb_variable *output, const lb_variable *input) {
  if (input->axis < 0) return 0.0; /* an acceleration moves no spring and no damper */
  return input->turn * REAL(b, LB_SLOPE_MATRIX + 8 * (LB_SLOPE_WIDTH * output->axis + input->axis));
}
#endif

/* Whether the solver's Jacobian has the slope. */
static int is_led(lb_bearing *b, const lb_variable *output, const lb_variable *input) {
  return LB_SLOPES && HOST(b, PHASE) >= LB_STEPPING && input->kind == LB_INPUT && output->kind == LB_VALUE && output->axis >= 0;
}

/* An input goes on with its derivatives since it was set: say the same from here on, and slopes are those of now. */
static void anchor(lb_bearing *b, unsigned begin) {
  unsigned row = begin - LB_TERM_BEGIN;
  double *value = &REAL(b, row + LB_TERM_VALUE), *rate = &REAL(b, row + LB_TERM_RATE);
  double acceleration = REAL(b, row + LB_TERM_ACCELERATION), passed = REAL(b, LB_CONTROL_TIME) - REAL(b, begin);
  *value += passed * (*rate + 0.5 * passed * acceleration);
  *rate += passed * acceleration;
  REAL(b, begin) = REAL(b, LB_CONTROL_TIME);
}

/* An input of a machine moves what follows it. */
static void shift_followers(lb_bearing *b, unsigned place, double by) {
  for (unsigned i = 0; i < LB_FOLLOWERS; i++) {
    const lb_follower *f = &lb_followers[i];
    for (unsigned k = f->first; k < f->first + f->count; k++)
      if (lb_shares[k].place == place) anchor(b, f->begin), REAL(b, f->place) += lb_shares[k].weight * by;
  }
}

static void shift(lb_bearing *b, const lb_variable *v, double by) {
  if (LB_FOLLOWERS && v->kind == LB_INPUT) {
    shift_followers(b, v->place, by);
  } else {
    if (v->kind == LB_INPUT) anchor(b, v->begin);
    REAL(b, v->place) += by;
  }
  if (v->kind == LB_VARIED) lb_follow(b);
  if (HOST(b, PHASE) < LB_STEPPING && v->kind != LB_SOURCE) HOST(b, UNSETTLED) = 1.0;
  b->stale = 1;
}

/* Central differences about the state as it stands, which a copy brings back to the last bit. */
static int by_differences(lb_bearing *b, const unsigned *unknowns, size_t n, const lb_variable *v, double along, double *slopes) {
  double by = v->scale * (HOST(b, PHASE) < LB_STEPPING ? BESIDE_START : 1.0);
  int sloped = b->sloped;
  void *state = NULL;
  int status = lb_save(b, &state);
  if (status != LB_OK) return status;
  for (int side = 1; side >= -1 && status == LB_OK; side -= 2) {
    shift(b, v, side * by);
    for (size_t i = 0; i < n && status == LB_OK; i++) {
      double found;
      if (is_led(b, &lb_variables[unknowns[i]], v)) continue;
      status = lb_get(b, unknowns + i, 1, &found);
      slopes[i] += along * (side * found / (2.0 * by));
    }
    lb_restore(b, state);
  }
  free(state);
  b->stale = 0, b->sloped = sloped; /* the copy has what was seen at this state */
  return status;
}

static int with_one(lb_bearing *b, const unsigned *unknowns, size_t n, const lb_variable *v, double along, double *slopes) {
  int rest = 0;
  for (size_t i = 0; i < n; i++) {
    const lb_variable *u = &lb_variables[unknowns[i]];
    if (!is_led(b, u, v)) {
      rest = 1;
      continue;
    }
#if LB_SLOPES
    if (v->axis >= 0 && differentiate(b) != LB_OK) return LB_ERROR;
    slopes[i] += along * by_jacobian(b, u, v);
#endif
  }
  return rest ? by_differences(b, unknowns, n, v, along, slopes) : LB_OK;
}

int lb_slope(lb_bearing *b, const unsigned *unknowns, size_t n, const unsigned *knowns, size_t m, const double *along,
             double *slopes) {
  if (!b) return LB_ERROR;
  for (size_t i = 0; i < n; i++) {
    if (!lb_real(b, unknowns[i])) return LB_ERROR;
    slopes[i] = 0.0;
  }
  for (size_t k = 0; k < m; k++) {
    const lb_variable *v = lb_real(b, knowns[k]);
    if (!v) return LB_ERROR;
    if (!isfinite(along[k])) return lb_say(b, LB_ERROR, "a slope along %g of %s: must be finite", along[k], lb_names[knowns[k]]);
    if (!lb_given(v)) return lb_say(b, LB_ERROR, "%s is no input: there are no slopes with it", lb_names[knowns[k]]);
  }
  if (lb_look(b) != LB_OK) return LB_ERROR;
  for (size_t k = 0; k < m; k++)
    if (along[k] != 0.0) {
      int status = with_one(b, unknowns, n, &lb_variables[knowns[k]], along[k], slopes);
      if (status != LB_OK) return status;
    }
  for (size_t i = 0; i < n; i++)
    if (!isfinite(slopes[i]))
      return lb_say(b, LB_ERROR, "the slope of %s is beyond any number: ask along something smaller", lb_names[unknowns[i]]);
  return LB_OK;
}
