/* FMI 3.0 for co-simulation: names and types of its functions are those of the standard (fmi-standard.org, version 3.0.2). */
#include <stdbool.h>

#define PREFIX fmi3
#define STATE FMUState
#define DESERIALISE Deserialize
#include "interface.h"

typedef void *instance;
typedef uint32_t reference;
typedef void (*logger)(void *, status, const char *, const char *);

static void tell(lb_bearing *b, int what, const char *category, const char *sentence) {
  ((logger)b->logger)(b->host, what, category, sentence);
}

LB_API const char *fmi3GetVersion(void) { return "3.0"; }

LB_API instance fmi3InstantiateCoSimulation(const char *name, const char *token, const char *resources, bool visible,
                                            bool logging, bool events, bool early, const reference needed[], size_t n,
                                            void *environment, logger log, void *update) {
  (void)resources, (void)visible, (void)early, (void)needed, (void)n, (void)update;
  return made(name, token, logging, environment, (void *)log, tell, events ? "this bearing has no events" : NULL);
}

LB_API instance fmi3InstantiateModelExchange(const char *name, const char *token, const char *resources, bool visible,
                                             bool logging, void *environment, logger log) {
  (void)resources, (void)visible;
  return made(name, token, logging, environment, (void *)log, tell, own_integrator);
}
LB_API instance fmi3InstantiateScheduledExecution(const char *name, const char *token, const char *resources,
                                                  bool visible, bool logging, void *environment, logger log,
                                                  void *update, void *lock, void *unlock) {
  (void)resources, (void)visible, (void)update, (void)lock, (void)unlock;
  return made(name, token, logging, environment, (void *)log, tell, own_integrator);
}

LB_API status fmi3SetDebugLogging(instance c, bool on, size_t n, const char *const categories[]) {
  (void)n, (void)categories;
  if (!c) return LB_ERROR;
  ((lb_bearing *)c)->logging = on;
  return LB_OK;
}

LB_API status fmi3EnterInitializationMode(instance c, bool with_tolerance, double tolerance, double start, bool with_end,
                                          double end) {
  (void)with_tolerance, (void)tolerance, (void)with_end, (void)end;
  int planned = lb_plan(c, start);
  return planned == LB_OK ? lb_enter(c) : planned;
}

static status amount(instance c, size_t n, size_t values) {
  return n == values ? LB_OK : lb_say(c, LB_ERROR, "%u variables have one value each, not %u together", (unsigned)n, (unsigned)values);
}
LB_API status fmi3GetFloat64(instance c, const reference which[], size_t n, double values[], size_t count) {
  return amount(c, n, count) == LB_OK ? lb_get(c, which, n, values) : LB_ERROR;
}
LB_API status fmi3SetFloat64(instance c, const reference which[], size_t n, const double values[], size_t count) {
  return amount(c, n, count) == LB_OK ? lb_set(c, which, n, values) : LB_ERROR;
}
LB_API status fmi3GetInt64(instance c, const reference which[], size_t n, int64_t values[], size_t count) {
  return amount(c, n, count) == LB_OK ? lb_get_counts(c, which, n, values) : LB_ERROR;
}
LB_API status fmi3SetInt64(instance c, const reference which[], size_t n, const int64_t values[], size_t count) {
  (void)values, (void)count;
  return no_integer_input(c, which, n);
}

/* Kinds of variables that a bearing has none of. */
#define NO_SUCH(kind, type, word)                                                                                     \
  LB_API status fmi3Get##kind(instance c, const reference which[], size_t n, type values[], size_t count) {           \
    (void)values, (void)count;                                                                                        \
    return none(c, which, n, word);                                                                 \
  }                                                                                                                   \
  LB_API status fmi3Set##kind(instance c, const reference which[], size_t n, const type values[], size_t count) {     \
    (void)values, (void)count;                                                                                        \
    return none(c, which, n, word);                                                                 \
  }
NO_SUCH(Float32, float, "32-bit real")
NO_SUCH(Int8, int8_t, "8-bit integer")
NO_SUCH(UInt8, uint8_t, "8-bit integer")
NO_SUCH(Int16, int16_t, "16-bit integer")
NO_SUCH(UInt16, uint16_t, "16-bit integer")
NO_SUCH(Int32, int32_t, "32-bit integer")
NO_SUCH(UInt32, uint32_t, "32-bit integer")
NO_SUCH(UInt64, uint64_t, "unsigned integer")
NO_SUCH(Boolean, bool, "boolean")
typedef const char *text;
LB_API status fmi3GetString(instance c, const reference which[], size_t n, text values[], size_t count) {
  (void)values, (void)count;
  return none(c, which, n, "string");
}
LB_API status fmi3SetString(instance c, const reference which[], size_t n, const text values[], size_t count) {
  (void)values, (void)count;
  return none(c, which, n, "string");
}
LB_API status fmi3GetBinary(instance c, const reference which[], size_t n, size_t sizes[], const uint8_t *values[],
                            size_t count) {
  (void)sizes, (void)values, (void)count;
  return none(c, which, n, "binary");
}
LB_API status fmi3SetBinary(instance c, const reference which[], size_t n, const size_t sizes[],
                            const uint8_t *const values[], size_t count) {
  (void)sizes, (void)values, (void)count;
  return none(c, which, n, "binary");
}
LB_API status fmi3GetClock(instance c, const reference which[], size_t n, bool values[]) {
  (void)values;
  return none(c, which, n, "clock");
}
LB_API status fmi3SetClock(instance c, const reference which[], size_t n, const bool values[]) {
  (void)values;
  return none(c, which, n, "clock");
}

LB_API status fmi3GetDirectionalDerivative(instance c, const reference unknowns[], size_t n, const reference knowns[],
                                           size_t m, const double along[], size_t seeds, double slopes[], size_t found) {
  if (amount(c, m, seeds) != LB_OK || amount(c, n, found) != LB_OK) return LB_ERROR;
  return lb_slope(c, unknowns, n, knowns, m, along, slopes);
}
LB_API status fmi3DoStep(instance c, double now, double step, bool final, bool *event, bool *end, bool *early,
                         double *last) {
  (void)final;
  int done = lb_step(c, now, step);
  if (event) *event = false;
  if (end) *end = false;
  if (early) *early = false;
  if (last && c) *last = lb_time(c);
  return done;
}

/* What a bearing cannot do. */
#define CANNOT(name, arguments, sentence) \
  LB_API status name arguments { return lb_say(c, LB_ERROR, "%s", sentence); }
static const char no_events[] = "this bearing has no events", no_clocks[] = "this bearing has no clocks";
static const char no_structure[] = "this bearing has no structural parameters";
static const char no_outside[] = "this bearing brings its own integrator";
CANNOT(fmi3EnterContinuousTimeMode, (instance c), no_outside)
CANNOT(fmi3CompletedIntegratorStep, (instance c, bool a, bool *b, bool *d), no_outside)
CANNOT(fmi3SetTime, (instance c, double t), no_outside)
CANNOT(fmi3SetContinuousStates, (instance c, const double x[], size_t n), no_outside)
CANNOT(fmi3GetContinuousStates, (instance c, double x[], size_t n), no_outside)
CANNOT(fmi3GetContinuousStateDerivatives, (instance c, double x[], size_t n), no_outside)
CANNOT(fmi3GetNominalsOfContinuousStates, (instance c, double x[], size_t n), no_outside)
CANNOT(fmi3GetEventIndicators, (instance c, double x[], size_t n), no_outside)
CANNOT(fmi3GetNumberOfContinuousStates, (instance c, size_t *n), no_outside)
CANNOT(fmi3GetNumberOfEventIndicators, (instance c, size_t *n), no_outside)
CANNOT(fmi3ActivateModelPartition, (instance c, reference clock, double t), no_clocks)
CANNOT(fmi3EnterEventMode, (instance c), no_events)
CANNOT(fmi3EnterStepMode, (instance c), no_events)
CANNOT(fmi3EvaluateDiscreteStates, (instance c), no_events)
CANNOT(fmi3UpdateDiscreteStates, (instance c, bool *a, bool *b, bool *d, bool *e, bool *f, double *g), no_events)
CANNOT(fmi3EnterConfigurationMode, (instance c), no_structure)
CANNOT(fmi3ExitConfigurationMode, (instance c), no_structure)
CANNOT(fmi3GetNumberOfVariableDependencies, (instance c, reference v, size_t *n), "dependencies do not change: they are in the model description")
CANNOT(fmi3GetVariableDependencies, (instance c, reference v, size_t a[], reference b[], size_t d[], int e[], size_t n), "dependencies do not change: they are in the model description")
CANNOT(fmi3GetAdjointDerivative, (instance c, const reference u[], size_t n, const reference k[], size_t m, const double s[], size_t a, double x[], size_t b), "adjoint derivatives are not computed: ask for directional ones")
CANNOT(fmi3GetOutputDerivatives, (instance c, const reference v[], size_t n, const int32_t o[], double x[], size_t m), "derivatives of outputs are not computed")
CANNOT(fmi3GetIntervalDecimal, (instance c, const reference v[], size_t n, double x[], int q[]), no_clocks)
CANNOT(fmi3GetIntervalFraction, (instance c, const reference v[], size_t n, uint64_t x[], uint64_t y[], int q[]), no_clocks)
CANNOT(fmi3GetShiftDecimal, (instance c, const reference v[], size_t n, double x[]), no_clocks)
CANNOT(fmi3GetShiftFraction, (instance c, const reference v[], size_t n, uint64_t x[], uint64_t y[]), no_clocks)
CANNOT(fmi3SetIntervalDecimal, (instance c, const reference v[], size_t n, const double x[]), no_clocks)
CANNOT(fmi3SetIntervalFraction, (instance c, const reference v[], size_t n, const uint64_t x[], const uint64_t y[]), no_clocks)
CANNOT(fmi3SetShiftDecimal, (instance c, const reference v[], size_t n, const double x[]), no_clocks)
CANNOT(fmi3SetShiftFraction, (instance c, const reference v[], size_t n, const uint64_t x[], const uint64_t y[]), no_clocks)
