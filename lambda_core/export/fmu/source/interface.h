/* What the files of both versions of the interface have in common; each defines PREFIX, STATE and DESERIALISE before. */
#ifndef LB_INTERFACE_H
#define LB_INTERFACE_H
#include <stdlib.h>
#include <string.h>

#include "core.h"
#include "token.h"

#define JOINED(a, b) a##b
#define JOIN(a, b) JOINED(a, b)
#define API(name) JOIN(PREFIX, name)

typedef int status;

/* A bearing for a host whose description is that of this library, and who wants what it is for. */
static lb_bearing *made(const char *name, const char *token, int logging, void *environment, void *log,
                        void (*tell)(lb_bearing *, int, const char *, const char *), const char *wrong) {
  lb_bearing *b = lb_create(name, environment, log, log ? tell : NULL);
  if (!b) return NULL;
  b->logging = logging;
  if (!wrong && (!token || strcmp(token, LB_TOKEN) != 0))
    wrong = "the model description is not that of this library: export the bearing again";
  if (!wrong) return b;
  lb_say(b, LB_ERROR, "%s", wrong);
  lb_free(b);
  return NULL;
}
static const char own_integrator[] = "this bearing is for co-simulation: it brings its own integrator";

static status none(void *c, const unsigned *which, size_t n, const char *kind) {
  return n ? lb_unknown(c, which[0], kind) : LB_OK;
}
static status no_integer_input(void *c, const unsigned *which, size_t n) {
  return n ? lb_say(c, LB_ERROR, "the variable with the value reference %u is no integer input", which[0]) : LB_OK;
}

LB_API void API(FreeInstance)(void *c) { lb_free(c); }
LB_API status API(Terminate)(void *c) { return lb_end(c); }
LB_API status API(ExitInitializationMode)(void *c) { return lb_leave(c); }
LB_API status API(Reset)(void *c) {
  if (!c) return LB_ERROR;
  lb_reset(c);
  return LB_OK;
}

LB_API status JOIN(API(Get), STATE)(void *c, void **state) { return lb_save(c, state); }
LB_API status JOIN(API(Set), STATE)(void *c, void *state) { return lb_restore(c, state); }
LB_API status JOIN(API(Free), STATE)(void *c, void **state) {
  (void)c;
  if (!state) return LB_OK; /* the standard: such a call is ignored */
  free(*state);
  *state = NULL;
  return LB_OK;
}
LB_API status JOIN(JOIN(API(Serialized), STATE), Size)(void *c, void *state, size_t *size) {
  (void)c, (void)state;
  *size = lb_packed_size();
  return LB_OK;
}
LB_API status JOIN(API(Serialize), STATE)(void *c, void *state, char bytes[], size_t size) {
  return lb_pack(c, state, bytes, size);
}
LB_API status JOIN(API(DESERIALISE), STATE)(void *c, const char bytes[], size_t size, void **state) {
  return lb_unpack(c, bytes, size, state);
}
#endif
