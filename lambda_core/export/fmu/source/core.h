/* One bearing: a copy of the image, and what every version of the interface does with it. */
#ifndef LB_CORE_H
#define LB_CORE_H
#include <stddef.h>
#include <stdint.h>

#if defined(_WIN32)
#define LB_API __declspec(dllexport)
#else
#define LB_API __attribute__((visibility("default")))
#endif

enum { LB_OK, LB_WARNING, LB_DISCARD, LB_ERROR, LB_FATAL }; /* as FMI 2 and 3 number them */
enum { LB_CREATED, LB_INITIALISING, LB_STEPPING, LB_ENDED };
#define LB_EVENTS 9 /* limits that are told: see limits.c */
/* What a variable is: see variables.py. */
enum { LB_TIME, LB_INPUT, LB_VALUE, LB_LEAST, LB_GREATEST, LB_SUM, LB_TORQUE, LB_COUNT, LB_VARIED, LB_SOURCE, LB_CAPACITANCE, LB_SHORTED, LB_WEIGHTED };

typedef struct {
  int kind;
  unsigned place, count, stride; /* [bytes], items, [bytes] */
  double scale;                  /* of an input: by how much it is changed for a slope */
  unsigned begin;         /* of an input: place of the time at which it was given */
  double lowest, highest; /* of an option that varies */
  int axis;               /* in the matrix of slopes: of a reaction its row, of a motion its column, or -1 */
  double turn;            /* sign there */
} lb_variable;

typedef struct lb_bearing {
  unsigned char *memory, *image; /* the image begins at a line of the processor's cache */
  int stale;                     /* outputs are to be computed before they are read */
  int sloped;                    /* the matrix of slopes belongs to them */
  double looked, *seen;           /* when limits were looked at last, and each of each bearing was last beyond [s] */
  char *name;
  void *host;    /* what the host wants back with each sentence */
  void *logger;  /* its function */
  int logging;
  void (*tell)(struct lb_bearing *, int status, const char *category, const char *sentence);
} lb_bearing;

lb_bearing *lb_create(const char *name, void *host, void *logger,
                      void (*tell)(lb_bearing *, int, const char *, const char *));
void lb_free(lb_bearing *b);
void lb_reset(lb_bearing *b);
int lb_say(lb_bearing *b, int status, const char *form, ...); /* returns the status */
int lb_plan(lb_bearing *b, double start); /* time at which the bearing begins */
int lb_enter(lb_bearing *b);
int lb_leave(lb_bearing *b);
int lb_end(lb_bearing *b);
int lb_get(lb_bearing *b, const unsigned *which, size_t count, double *values);
int lb_set(lb_bearing *b, const unsigned *which, size_t count, const double *values);
int lb_get_counts(lb_bearing *b, const unsigned *which, size_t count, int64_t *values);
int lb_step(lb_bearing *b, double now, double step);
double lb_time(lb_bearing *b);
int lb_save(lb_bearing *b, void **state);
int lb_restore(lb_bearing *b, const void *state);
size_t lb_packed_size(void); /* of a state that leaves the process */
int lb_pack(lb_bearing *b, const void *state, void *bytes, size_t size);
int lb_unpack(lb_bearing *b, const void *bytes, size_t size, void **state);
int lb_unknown(lb_bearing *b, unsigned which, const char *kind);
int lb_slope(lb_bearing *b, const unsigned *unknowns, size_t n, const unsigned *knowns, size_t m, const double *along,
             double *slopes);
#endif
