/* What the parts of the library share about the image, and nobody else sees. */
#ifndef LB_IMAGE_H
#define LB_IMAGE_H
#include <math.h>

#include "core.h"

typedef struct {
  double lowest, start, highest;
} lb_option; /* of the case, which a host may change */
typedef struct {
  unsigned place; /* [bytes] */
  double base;
  int scales; /* several options act by their ratios */
  unsigned first, count;
} lb_constant; /* a number that follows options, and its curves */
typedef struct {
  unsigned option, first, order;
} lb_curve; /* values at the points of Chebyshev, from the highest to the lowest */
typedef struct {
  unsigned place;
  double weight;
} lb_share; /* of a sum */
typedef struct {
  unsigned place, begin, first, count;
} lb_follower; /* a number that is a sum of inputs, since when it is, and its shares */
typedef struct {
  const char *label, *element; /* before what is told of it; ball or roller */
  unsigned first_ball, balls, contacts; /* of a ball or roller */
  unsigned char ring[6], rib[6]; /* of each contact its ring, and whether a rib is what it touches */
  int grooved;
  double grooves[2][3];  /* of each ring: radius, edge, edge between two arcs */
  double highest_pressure, least_share;
  int one_sided, ridge;
} lb_part; /* a bearing */
typedef struct {
  unsigned first_ball, balls, node; /* of the outer ring where it is insulated, otherwise 0 */
  double conductivity, metal, ball_permittivity;
  int rough;
} lb_film; /* of a bearing in the circuit */

#include "case.h" /* written for each case: places in the image, variables, sentences */

extern const unsigned char lb_image[];
extern void *const lb_functions[];
extern int64_t lb_advance(unsigned char *image, double until, int64_t work);
extern int64_t lb_observe(unsigned char *image);
extern int64_t lb_static(unsigned char *image, int64_t iterations);
extern int64_t lb_integrate_circuit(unsigned char *image);
extern int64_t lb_jacobian(unsigned char *image, double time);

#define REAL(b, place) (*(double *)((b)->image + (place)))
#define WORD(b, place) (*(int64_t *)((b)->image + (place)))
/* What was observed last of a contact of a ball. */
#define SAMPLE(j, k, name) REAL(b, LB_CONTACTS + LB_CONTACT_SIZE * (LB_CONTACTS_OF_A_BALL * (j) + (k)) + LB_CONTACT_##name)
/* Numbers of the host that belong to a state. */
enum { ORIGIN, LOST_BEFORE, TURNED_BEFORE, TORQUE, PHASE, UNSETTLED };
#define HOST(b, which) REAL(b, LB_HOST + 8 * (which))

const lb_variable *lb_real(lb_bearing *b, unsigned which); /* or NULL, and it has been said */
int lb_given(const lb_variable *v);                        /* whether a host sets it */
int lb_look(lb_bearing *b);    /* bring what can be read to the state as it stands */
double lb_capacitance(lb_bearing *b, const lb_part *p, unsigned *shorted); /* [F] of the balls that short nothing; how many do */
int lb_refused(lb_bearing *b); /* say which law refused; an error */
void lb_address(unsigned char *image); /* give it the addresses of where it stands */
void lb_follow(lb_bearing *b); /* bring constants to the values of the options */
int lb_settle(lb_bearing *b);  /* find the equilibrium at the start; an error where there is none */
void lb_tell_limits(lb_bearing *b); /* warn where what was observed last leaves what the laws are made for */
#if LB_CIRCUIT
void lb_take(lb_bearing *b);   /* take the contacts as they were observed last for the end of a step */
int lb_conduct(lb_bearing *b); /* bring the circuit to the end of a step */
#endif
#endif
