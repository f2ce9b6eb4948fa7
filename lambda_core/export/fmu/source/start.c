/* The equilibrium at a start that is not the case's: what drivers/equilibrium.py does, from the case's equilibrium on. */
#include <string.h>

#include "image.h"

#if !LB_SETTLES
/* The program finds the equilibrium of a machine, which is that of its shaft in all bearings, and that of rollers: see
   drivers/machine_statics.py and elements/roller. */
int lb_settle(lb_bearing *b) {
  lb_say(b, LB_WARNING, "the start is the equilibrium of the case: what was given before the initialisation ended acts "
                        "from the start as a jump");
  return LB_OK;
}
#else
#define BALL(j, field) (LB_START_STATE + LB_BALL_SIZE * (j) + LB_BALL_##field)

/* Which balls the cage drives: 1 for each of them. */
typedef struct {
  int64_t of[LB_BALLS];
} lb_driven;

#define DRIVEN(b) ((lb_driven *)((b)->image + LB_START_HELD))

/* A search that begins, and decides which balls the cage drives, or takes those that are given. */
static int64_t search(lb_bearing *b, int friction, const lb_driven *driven, int work) {
  WORD(b, LB_FRICTION_ON) = friction, WORD(b, LB_GUIDES_ON) = 0;
  memset(b->image + LB_START_REPORT, 0, LB_REPORT_SIZE);
  memset(DRIVEN(b), 0, sizeof(lb_driven));
  for (unsigned i = 0; i < LB_STATES; i++) REAL(b, LB_START_LAST + 8 * i) = 0.0;
  for (unsigned j = 0; j < LB_BALLS; j++) REAL(b, LB_START_TRUST + 8 * j) = 1.0;
  int64_t status = lb_static(b->image, driven ? 0 : work);
  if (driven) {
    REAL(b, LB_REPORT_ITERATIONS) = LB_BEGUN, *DRIVEN(b) = *driven;
    status = lb_static(b->image, work);
  }
  WORD(b, LB_FRICTION_ON) = 1, WORD(b, LB_GUIDES_ON) = 1;
  return status;
}

static int equilibrium(lb_bearing *b, int friction, const lb_driven *driven) {
  return search(b, friction, driven, friction ? LB_FRICTION_WORK : LB_SMOOTH_WORK) == LB_STATUS_OK;
}

static void roll(lb_bearing *b) {
  double speed = LB_SPIN >= 0 ? REAL(b, LB_SPIN) : LB_SPEED;
  for (unsigned j = 0; j < LB_BALLS; j++) {
    const double *still = lb_rolling + 4 * j, *turning = still + 4 * LB_BALLS;
    REAL(b, BALL(j, VELOCITY) + 16) = still[0] + speed * turning[0];
    for (int i = 1; i < 4; i++) REAL(b, BALL(j, SPIN) + 8 * (i - 1)) = still[i] + speed * turning[i];
  }
}

/* Velocity of a ball along its path, axial or radial: where its neighbours in the row are it comes by. */
static double path(lb_bearing *b, unsigned j, unsigned place) {
  unsigned first = j - j % LB_BALLS_OF_A_ROW;
  double slope = 0.0;
  for (unsigned m = 0; m < LB_BALLS_OF_A_ROW; m++)
    slope += lb_path[(first + m + LB_BALLS_OF_A_ROW - j) % LB_BALLS_OF_A_ROW] *
             REAL(b, LB_START_STATE + LB_BALL_SIZE * (first + m) + place);
  return slope * REAL(b, BALL(j, VELOCITY) + 16) / REAL(b, BALL(j, RADIUS));
}

#define PATHS (2 * LB_BALLS) /* axial and radial velocity of every ball */

static double product(const double *a, const double *b) {
  double sum = 0.0;
  for (unsigned i = 0; i < PATHS; i++) sum += a[i] * b[i];
  return sum;
}

/* Weights with which the last one or two changes of a difference come nearest to it. */
static void weigh(int memory, double changed[2][PATHS], const double *off, double weights[2]) {
  weights[0] = weights[1] = 0.0;
  if (memory < 1) return;
  double a = product(changed[0], changed[0]), p = product(changed[0], off);
  if (memory == 1 && a > 0.0) weights[0] = p / a;
  if (memory < 2) return;
  double c = product(changed[0], changed[1]), d = product(changed[1], changed[1]), q = product(changed[1], off);
  double det = a * d - c * c;
  if (det > 0.0) weights[0] = (d * p - c * q) / det, weights[1] = (a * q - c * p) / det;
}

/* An equilibrium on the way, and the velocities it has. */
typedef struct {
  unsigned char state[8 * LB_STATES];
  double moving[PATHS], off[PATHS];
  lb_driven driven;
} lb_stage;

static int same(const lb_driven *a, const lb_driven *b) { return memcmp(a, b, sizeof *a) == 0; }

/* Anderson's mixing of two steps, as in drivers/ball_paths.py; there is why stages alternate, and which one goes on. */
static int follow_paths(lb_bearing *b) {
  double rolling = 0.0, moving[PATHS] = {0.0}, off[PATHS] = {0.0}, moved[2][PATHS], changed[2][PATHS], weights[2];
  lb_stage before;
  lb_driven held;
  int holds = 0, n = 0; /* steps since the iteration began, or began anew */
  for (unsigned j = 0; j < LB_BALLS; j++) rolling = fmax(rolling, fabs(REAL(b, BALL(j, VELOCITY) + 16)));
  for (int k = 0; k < LB_PATH_ITERATIONS; k++) {
    double across = 0.0, change = 0.0;
    for (unsigned i = 0; i < PATHS; i++) {
      double aim = path(b, i / 2, i % 2 ? LB_BALL_RADIUS : LB_BALL_X), last = off[i];
      off[i] = aim - moving[i];
      if (n) changed[(n - 1) % 2][i] = off[i] - last;
      if (i % 2 == 0) across = fmax(across, fabs(aim)), change = fmax(change, fabs(off[i]));
    }
    if (across <= LB_NO_PATH * rolling || change <= LB_PATH_TOLERANCE * across) return 1;
    if (!holds) {
      lb_driven last = *DRIVEN(b);
      search(b, 1, 0, 0);
      if (k && !same(DRIVEN(b), &last) && same(DRIVEN(b), &before.driven)) {
        holds = 1, n = 0, held = k % 2 ? before.driven : last;
        if (k % 2) {
          memcpy(b->image + LB_START_STATE, before.state, sizeof before.state);
          memcpy(moving, before.moving, sizeof moving), memcpy(off, before.off, sizeof off);
        }
      }
      memcpy(before.state, b->image + LB_START_STATE, sizeof before.state);
      memcpy(before.moving, moving, sizeof moving), memcpy(before.off, off, sizeof off);
      before.driven = last;
    }
    int memory = n < 2 ? n : 2;
    double share = n ? LB_PATH_SHARE : 1.0;
    weigh(memory, changed, off, weights);
    for (unsigned i = 0; i < PATHS; i++) {
      double step = share * off[i];
      for (int m = 0; m < memory; m++) step -= weights[m] * (moved[m][i] + share * changed[m][i]);
      moved[n % 2][i] = step, moving[i] += step;
    }
    n++;
    for (unsigned i = 0; i < PATHS; i++) REAL(b, BALL(i / 2, VELOCITY) + 8 * (i % 2)) = moving[i];
    if (!equilibrium(b, 1, holds ? &held : 0)) return 0;
  }
  return 1;
}

/* Every ball at the cage's speed, the cage centred on the balls. */
static void enclose(lb_bearing *b, double orbit) {
  double middle = 0.0;
  for (unsigned j = 0; j < LB_BALLS; j++) {
    REAL(b, BALL(j, VELOCITY) + 16) = orbit * REAL(b, BALL(j, RADIUS));
    middle += REAL(b, BALL(j, X)) / LB_BALLS;
  }
  for (unsigned i = 0; i < LB_CAGE_ENTRIES; i++) {
    unsigned what = lb_cage[i][1];
    REAL(b, LB_START_STATE + 8 * lb_cage[i][0]) = what == LB_CAGE_X       ? middle
                                                  : what == LB_CAGE_ANGLE ? REAL(b, BALL(0, AZIMUTH))
                                                  : what == LB_CAGE_SPEED ? orbit
                                                                          : 0.0;
  }
}

int lb_settle(lb_bearing *b) {
  unsigned char *state = b->image + LB_START_STATE, smooth[8 * LB_STATES];
  memcpy(state, lb_image + LB_START_STATE, 8 * LB_STATES);
  for (unsigned j = 0; j < LB_BALLS; j++) REAL(b, BALL(j, VELOCITY)) = REAL(b, BALL(j, VELOCITY) + 8) = 0.0;
  roll(b);
  if (!equilibrium(b, 0, 0))
    return lb_say(b, LB_ERROR, "there is no equilibrium at the start with these inputs: set others before the initialisation ends");
  roll(b);
  memcpy(smooth, state, sizeof smooth);
  double orbit = REAL(b, BALL(0, VELOCITY) + 16) / REAL(b, BALL(0, RADIUS));
  if (equilibrium(b, 1, 0) && follow_paths(b)) {
    orbit = REAL(b, LB_REPORT_ORBIT);
  } else {
    memcpy(state, smooth, sizeof smooth);
    lb_say(b, LB_WARNING, "loads and contact angles at the start are found, a steady motion of the balls is not: they begin rolling");
  }
  enclose(b, orbit);
  memcpy(b->image + LB_STATE, state, 8 * LB_STATES);
  return LB_OK;
}
#endif
