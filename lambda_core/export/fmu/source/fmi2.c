/* FMI 2.0 for co-simulation: names and types of its functions are those of the standard (fmi-standard.org, version 2.0.4). */
#define PREFIX fmi2
#define STATE FMUstate
#define DESERIALISE DeSerialize
#include "interface.h"

typedef void *component;
typedef unsigned reference;
typedef int boolean;
typedef void (*logger)(void *, const char *, status, const char *, const char *, ...);
typedef struct {
  logger log;
  void *(*allocate)(size_t, size_t);
  void (*release)(void *);
  void (*step_finished)(void *, status);
  void *environment;
} callbacks;

static void tell(lb_bearing *b, int what, const char *category, const char *sentence) {
  ((logger)b->logger)(b->host, b->name, what, category, sentence);
}

LB_API const char *fmi2GetTypesPlatform(void) { return "default"; }
LB_API const char *fmi2GetVersion(void) { return "2.0"; }

LB_API component fmi2Instantiate(const char *name, int kind, const char *token, const char *resources,
                                 const callbacks *functions, boolean visible, boolean logging) {
  (void)resources, (void)visible;
  void *log = functions ? (void *)functions->log : NULL, *environment = functions ? functions->environment : NULL;
  return made(name, token, logging, environment, log, tell, kind == 1 ? NULL : own_integrator);
}

LB_API status fmi2SetDebugLogging(component c, boolean on, size_t n, const char *const categories[]) {
  (void)n, (void)categories;
  if (!c) return LB_ERROR;
  ((lb_bearing *)c)->logging = on;
  return LB_OK;
}

LB_API status fmi2SetupExperiment(component c, boolean with_tolerance, double tolerance, double start, boolean with_end,
                                  double end) {
  (void)with_tolerance, (void)tolerance, (void)with_end, (void)end;
  return lb_plan(c, start);
}
LB_API status fmi2EnterInitializationMode(component c) { return lb_enter(c); }

LB_API status fmi2GetReal(component c, const reference which[], size_t n, double values[]) {
  return lb_get(c, which, n, values);
}
LB_API status fmi2SetReal(component c, const reference which[], size_t n, const double values[]) {
  return lb_set(c, which, n, values);
}
LB_API status fmi2GetInteger(component c, const reference which[], size_t n, int values[]) {
  for (size_t i = 0; i < n; i++) {
    int64_t found;
    if (lb_get_counts(c, which + i, 1, &found) != LB_OK) return LB_ERROR;
    values[i] = (int)found;
  }
  return LB_OK;
}

LB_API status fmi2SetInteger(component c, const reference which[], size_t n, const int values[]) {
  (void)values;
  return no_integer_input(c, which, n);
}
LB_API status fmi2GetBoolean(component c, const reference which[], size_t n, boolean values[]) {
  (void)values;
  return none(c, which, n, "boolean");
}
LB_API status fmi2SetBoolean(component c, const reference which[], size_t n, const boolean values[]) {
  (void)values;
  return none(c, which, n, "boolean");
}
LB_API status fmi2GetString(component c, const reference which[], size_t n, const char *values[]) {
  (void)values;
  return none(c, which, n, "string");
}
LB_API status fmi2SetString(component c, const reference which[], size_t n, const char *const values[]) {
  (void)values;
  return none(c, which, n, "string");
}

LB_API status fmi2GetDirectionalDerivative(component c, const reference unknowns[], size_t n, const reference knowns[],
                                           size_t m, const double along[], double slopes[]) {
  return lb_slope(c, unknowns, n, knowns, m, along, slopes);
}

LB_API status fmi2DoStep(component c, double now, double step, boolean no_return) {
  (void)no_return;
  return lb_step(c, now, step);
}
LB_API status fmi2CancelStep(component c) { return lb_say(c, LB_ERROR, "steps are not asynchronous: none can be cancelled"); }
LB_API status fmi2SetRealInputDerivatives(component c, const reference which[], size_t n, const int order[],
                                          const double values[]) {
  (void)which, (void)n, (void)order, (void)values;
  return lb_say(c, LB_ERROR, "inputs take no derivatives this way: their rates are inputs of their own");
}
LB_API status fmi2GetRealOutputDerivatives(component c, const reference which[], size_t n, const int order[],
                                           double values[]) {
  (void)which, (void)n, (void)order, (void)values;
  return lb_say(c, LB_ERROR, "derivatives of outputs are not computed");
}

#define NOTHING_PENDS(kind, type)                                                  \
  LB_API status fmi2Get##kind##Status(component c, int what, type *found) {        \
    (void)what, (void)found;                                                       \
    return lb_say(c, LB_DISCARD, "steps are not asynchronous: none is under way"); \
  }
LB_API status fmi2GetStatus(component c, int what, status *found) {
  (void)what, (void)found;
  return lb_say(c, LB_DISCARD, "steps are not asynchronous: none is under way");
}
LB_API status fmi2GetRealStatus(component c, int what, double *found) {
  if (what != 2) return lb_say(c, LB_DISCARD, "steps are not asynchronous: none is under way");
  if (c) *found = lb_time(c);
  return c ? LB_OK : LB_ERROR;
}
NOTHING_PENDS(Integer, int)
NOTHING_PENDS(Boolean, boolean)
NOTHING_PENDS(String, const char *)
