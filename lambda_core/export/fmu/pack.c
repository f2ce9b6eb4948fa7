/* What the program asks of a library of its machine code: functions by their place in a table, and whether the
   processor has what they were made for. */
#include <stdint.h>

#ifdef _WIN32
#define SEEN __declspec(dllexport)
#else
#define SEEN __attribute__((visibility("default")))
#endif

extern const void *const lb_functions[] __attribute__((visibility("hidden")));

SEEN const void *lb_function(int64_t place) { return lb_functions[place]; }

SEEN int lb_runs_here(void) {
#ifdef __x86_64__
  __builtin_cpu_init();
  /* Every processor with these has all of x86-64-v3. */
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi") &&
         __builtin_cpu_supports("bmi2");
#else
  return 1;
#endif
}
