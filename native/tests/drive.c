// Loads the client library for itself alone, as Python does, and keeps a clock of its own once it is given a time.
//
//     drive LIBRARY [global|outside]
//
// "global" is how a program of C++ has its libraries; with "outside" the first to call the middleware is this program,
// which has no library that leads to it.

#include <dlfcn.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include "../rmw_abi.h"

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

static int call_from_outside(void)
{
  void * (*create)(const rmw_node_t *, const void *, const char *, const void *, const void *) = NULL;
  void * const found = dlsym(RTLD_DEFAULT, "rmw_create_publisher");
  memcpy(&create, &found, sizeof(found));
  const rmw_node_t node = {NULL, NULL, "outside", "/"};
  return create(&node, NULL, "/outside", NULL, NULL) != NULL;
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
  if (count > 2 && strcmp(arguments[2], "outside") == 0 && !call_from_outside()) {
    return 4;
  }
  int (*scenario)(void (*)(int64_t)) = NULL;
  void * const found = dlsym(library, "scenario");
  memcpy(&scenario, &found, sizeof(found));
  return scenario(set_time);
}
