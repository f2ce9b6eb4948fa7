/* A host in C: loads the library of an FMU 2.0, takes steps under a load and prints its outputs, bit for bit.
   plain_host LIBRARY TOKEN STEPS STEP INPUT VALUE OUTPUT... (value references) */
#ifdef _WIN32
#include <windows.h>
#define OPEN(file) (void *)LoadLibraryA(file)
#define FUNCTION(library, name) GetProcAddress((HMODULE)(library), name)
#define WHY() "it cannot be loaded"
#else
#include <dlfcn.h>
#define OPEN(file) dlopen(file, RTLD_NOW)
#define FUNCTION(library, name) dlsym(library, name)
#define WHY() dlerror()
#endif
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

typedef struct {
  void (*log)(void *, const char *, int, const char *, const char *, ...);
  void *(*allocate)(size_t, size_t);
  void (*release)(void *);
  void (*finished)(void *, int);
  void *environment;
} callbacks;

static void hear(void *host, const char *name, int status, const char *category, const char *sentence, ...) {
  (void)host;
  fprintf(stderr, "%s %d %s %s\n", name, status, category, sentence);
}

int main(int n, char **words) {
  void *library = OPEN(words[1]);
  if (!library) return fprintf(stderr, "%s\n", WHY()), 2;
#define FIND(result, name, ...) result (*name)(__VA_ARGS__) = (result(*)(__VA_ARGS__))FUNCTION(library, #name)
  FIND(void *, fmi2Instantiate, const char *, int, const char *, const char *, const callbacks *, int, int);
  FIND(int, fmi2SetupExperiment, void *, int, double, double, int, double);
  FIND(int, fmi2EnterInitializationMode, void *);
  FIND(int, fmi2ExitInitializationMode, void *);
  FIND(int, fmi2SetReal, void *, const unsigned *, size_t, const double *);
  FIND(int, fmi2GetReal, void *, const unsigned *, size_t, double *);
  FIND(int, fmi2DoStep, void *, double, double, int);
  FIND(void, fmi2FreeInstance, void *);
  callbacks given = {hear, calloc, free, 0, 0};
  void *bearing = fmi2Instantiate("plain", 1, words[2], "", &given, 0, 0);
  if (!bearing) return 3;
  int steps = atoi(words[3]), outputs = n - 7, wrong = 0;
  double step = atof(words[4]), value = atof(words[6]), time = 0.0;
  unsigned input = atoi(words[5]), which[16];
  for (int i = 0; i < outputs; i++) which[i] = atoi(words[7 + i]);
  wrong |= fmi2SetupExperiment(bearing, 0, 0.0, 0.0, 0, 0.0);
  wrong |= fmi2EnterInitializationMode(bearing) | fmi2ExitInitializationMode(bearing);
  for (int k = 0; k < steps; k++, time += step) {
    double load = k < steps / 2 ? 0.0 : value, found[16];
    wrong |= fmi2SetReal(bearing, &input, 1, &load) | fmi2DoStep(bearing, time, step, 1);
    wrong |= fmi2GetReal(bearing, which, outputs, found);
    for (int i = 0; i < outputs; i++) printf("%a%c", found[i], i < outputs - 1 ? ' ' : '\n');
  }
  fmi2FreeInstance(bearing);
  return wrong;
}
