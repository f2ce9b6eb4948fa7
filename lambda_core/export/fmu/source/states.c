/* States of a bearing: copies of its image, workspaces at its end left out, in the process and as bytes that leave it. */
#include <stdlib.h>
#include <string.h>

#include "image.h"

#define TOKEN_SIZE 64 /* [bytes] before the image: whose state it is, and at their end the sum of its words */
#define SUM_PLACE (TOKEN_SIZE - 8)

void lb_address(unsigned char *image) {
  for (size_t i = 0; i < sizeof lb_relocations / sizeof *lb_relocations; i++)
    *(uint64_t *)(image + lb_relocations[i][0]) = (uint64_t)(uintptr_t)(image + lb_relocations[i][1]);
  for (size_t i = 0; i < sizeof lb_fixes / sizeof *lb_fixes; i++)
    *(uint64_t *)(image + lb_fixes[i][0]) = (uint64_t)(uintptr_t)lb_functions[lb_fixes[i][1]];
}

int lb_save(lb_bearing *b, void **state) {
  if (!b || !state) return lb_say(b, LB_ERROR, "there is no place for a state");
  if (!*state) *state = malloc(LB_KEPT_SIZE);
  if (!*state) return lb_say(b, LB_ERROR, "there is no memory for a state of %u bytes", (unsigned)LB_KEPT_SIZE);
  memcpy(*state, b->image, LB_KEPT_SIZE);
  return LB_OK;
}

int lb_restore(lb_bearing *b, const void *state) {
  if (!b || !state) return lb_say(b, LB_ERROR, "there is no state to restore");
  memcpy(b->image, state, LB_KEPT_SIZE);
  lb_address(b->image);
  b->stale = 1;
  return LB_OK;
}

/* FNV-1a over words of eight bytes: each step is one-to-one, so that a change of one word is never missed. A product
   carries upwards only; the upper half is brought down, or the signs of two numbers could change unseen. */
static uint64_t check_sum(const unsigned char *image) {
  uint64_t found = 0xcbf29ce484222325u, word;
  for (size_t i = 0; i < LB_KEPT_SIZE; i += sizeof word) {
    memcpy(&word, image + i, sizeof word);
    found = (found ^ word) * 0x100000001b3u;
    found ^= found >> 32;
  }
  return found;
}

size_t lb_packed_size(void) { return LB_KEPT_SIZE + TOKEN_SIZE; }

int lb_pack(lb_bearing *b, const void *state, void *bytes, size_t size) {
  unsigned char *image = (unsigned char *)bytes + TOKEN_SIZE;
  if (!state || !bytes || size < lb_packed_size())
    return lb_say(b, LB_ERROR, "a state takes %u bytes, not %u", (unsigned)lb_packed_size(), (unsigned)size);
  memset(bytes, 0, TOKEN_SIZE);
  strncpy(bytes, LB_TOKEN, SUM_PLACE - 1);
  memcpy(image, state, LB_KEPT_SIZE);
  /* Addresses mean nothing outside: the same state is the same bytes. */
  for (size_t i = 0; i < sizeof lb_relocations / sizeof *lb_relocations; i++)
    memcpy(image + lb_relocations[i][0], lb_image + lb_relocations[i][0], 8);
  for (size_t i = 0; i < sizeof lb_fixes / sizeof *lb_fixes; i++)
    memcpy(image + lb_fixes[i][0], lb_image + lb_fixes[i][0], 8);
  uint64_t sum = check_sum(image);
  memcpy((unsigned char *)bytes + SUM_PLACE, &sum, sizeof sum);
  return LB_OK;
}

int lb_unpack(lb_bearing *b, const void *bytes, size_t size, void **state) {
  if (!bytes || !state || size != lb_packed_size() || strncmp(bytes, LB_TOKEN, SUM_PLACE - 1) != 0)
    return lb_say(b, LB_ERROR, "these bytes are no state of this bearing");
  const unsigned char *image = (const unsigned char *)bytes + TOKEN_SIZE;
  uint64_t sum = check_sum(image);
  if (memcmp((const unsigned char *)bytes + SUM_PLACE, &sum, sizeof sum) != 0)
    return lb_say(b, LB_ERROR, "these bytes are a state of this bearing that was damaged on its way: their sum is another one");
  if (!*state) *state = malloc(LB_KEPT_SIZE);
  if (!*state) return lb_say(b, LB_ERROR, "there is no memory for a state of %u bytes", (unsigned)LB_KEPT_SIZE);
  memcpy(*state, image, LB_KEPT_SIZE);
  return LB_OK;
}
