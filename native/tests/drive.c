// Loads the client library for itself alone, as Python does, and keeps a clock of its own once it is given a time.
//
//     drive LIBRARY [global]

#include <dlfcn.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

static int64_t given;

static void set_time(int64_t ns)
{
  given = ns;
}

__attribute__((visibility("default"))) int clock_gettime(clockid_t clock, struct timespec * now)
{
  if (given != 0 && clock == CLOCK_REALTIME) {
    now->tv_sec = given / 1000000000;
    now->tv_nsec = given % 1000000000;
    return 0;
  }
  return (int)syscall(SYS_clock_gettime, clock, now);
}

int main(int count, char ** arguments)
{
  if (count < 2) {
    return 2;
  }
  const int shared = count > 2 && strcmp(arguments[2], "global") == 0 ? RTLD_GLOBAL : RTLD_LOCAL;
  void * const library = dlopen(arguments[1], RTLD_NOW | shared);
  if (library == NULL) {
    fprintf(stderr, "%s\n", dlerror());
    return 3;
  }
  int (*scenario)(void (*)(int64_t)) = NULL;
  void * const found = dlsym(library, "scenario");
  memcpy(&scenario, &found, sizeof(found));
  return scenario(set_time);
}
