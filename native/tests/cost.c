// Tells what a message costs in ns, with the fake middleware: cost MESSAGES, with the library preloaded or without it.

#include "fake_rmw.h"

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#define FUNCTION(result, name, parameters) extern result rmw_##name parameters;
#include "../real_rmw.h"
WRAPPED_FUNCTIONS(FUNCTION)

static double seconds(void)
{
  struct timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return (double)now.tv_sec + (double)now.tv_nsec * 1e-9;
}

int main(int count, char ** arguments)
{
  const int messages = count > 1 ? atoi(arguments[1]) : 1000000;
  const int publishers = count > 2 ? atoi(arguments[2]) : 1;
  const rmw_node_t node = {NULL, NULL, "node", "/"};
  void * const publisher = rmw_create_publisher(&node, NULL, "/out", NULL, NULL);
  void * const subscription = rmw_create_subscription(&node, NULL, "/in", NULL, NULL);
  union {
    rmw_message_info_t read;
    uint8_t all[HUMBLE_INFO_BYTES];
  } info;
  bool taken;
  const double begin = seconds();
  for (int at = 0; at < messages; at++) {
    rmw_publish(publisher, NULL, NULL);
  }
  const double middle = seconds();
  for (int at = 0; at < messages; at++) {
    fake.gid[3] = (uint8_t)(at % publishers + 1);
    fake.number = (uint64_t)(at / publishers);
    fake.source = 1000000000 + at;
    fake.received = 1000000100 + at;
    rmw_take_with_info(subscription, NULL, &taken, &info.read, NULL);
  }
  const double end = seconds();
  printf("%.2f %.2f\n", (middle - begin) / messages * 1e9, (end - middle) / messages * 1e9);
  return 0;
}
