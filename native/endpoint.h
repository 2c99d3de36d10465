// The publishers, subscriptions, clients and servers of this process, found by the address of their rmw handle.
//
// Finding one takes no lock. What a call does with a handle that another thread destroys is as undefined here as in rmw,
// but never a use of freed memory: endpoints live in memory that is kept, and are given out again.

#ifndef ROSLENS_ENDPOINT_H
#define ROSLENS_ENDPOINT_H

#include <pthread.h>
#include <stdbool.h>

#include "counter_layout.h"
#include "message_type.h"
#include "sequence.h"
#include "slot.h"

enum { MOST_ENDPOINTS = 2048, CHAINS = 64, CALLS = 64 };

typedef struct endpoint endpoint;

// The private side of a slot.
typedef struct counter {
  slot slot;
  endpoint * owner;
  struct counter * next;  // in the chain of its owner, or behind those that ended before
  int kind;
  uint8_t gid[GID_BYTES];
  sequence numbers;
} counter;

// A request on its way, to be found when its response comes or goes.
typedef struct {
  uint8_t client[16];
  int64_t number;
  int64_t since;
} call;

struct endpoint {
  pthread_mutex_t lock;
  const void * handle;
  endpoint * free;  // the next one that is free
  counter * recent[2];
  char name[NAME_BYTES];
  char node[NAME_BYTES];
  uint8_t gid[GID_BYTES];
  message_type type;
  int64_t size;    // of the last message that was asked for its size
  int64_t unasked;  // how many messages are taken to be as long, because to ask takes long
  uint64_t born;   // the number of its making, by which who remembers an endpoint knows that it is still the same
  bool filtered;  // whether messages are left out on purpose, so that missing numbers tell nothing
  int64_t tried;  // when it was last left without a slot, or to the hook in Python; 0 is never
  counter * chain[CHAINS];
  call calls[CALLS];
};

// Memory for all endpoints and counters, and the lock that guards what is not one endpoint's own.
// Who holds the lock of an endpoint may take it, not the other way round.
extern pthread_mutex_t endpoints_lock;

// Return the endpoint of a handle; NULL of one that is not known.
endpoint * endpoint_of(const void * handle);

// Make a handle known; NULL where there are too many.
endpoint * add_endpoint(const void * handle, int64_t now);

// Forget a handle. Its slots say that it ended; they stay for a while, for who did not read them yet.
void remove_endpoint(const void * handle, int64_t now);

// Return a counter whose endpoint ended so long ago that its slot was read; NULL where there is none. Wants the lock.
counter * ended_counter(int64_t now);

// Return the memory of the counters, CAPACITY of them.
counter * all_counters(void);

#endif
