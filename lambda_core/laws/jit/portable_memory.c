/* The memory that compiled code of Numba allocates: arrays without destructors. Numba 0.65 to 0.68 put a count of
   references at the beginning of this record, and compiled code reads the count and the address of the data. */
#include <stdint.h>
#include <stdlib.h>

typedef struct {
  size_t references;
  void *destructor, *for_destructor, *data;
  size_t size;
  void *allocator;
} record;

void *NRT_MemInfo_alloc_aligned(size_t size, unsigned align) {
  record *made = malloc(sizeof *made + size + align);
  if (!made) return NULL;
  made->references = 1;
  made->destructor = made->for_destructor = made->allocator = NULL;
  made->data = (void *)(((uintptr_t)(made + 1) + align - 1) / align * align);
  made->size = size;
  return made;
}

void NRT_MemInfo_call_dtor(void *made) { free(made); }
void NRT_Free(void *made) { free(made); }
