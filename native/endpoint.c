#include "endpoint.h"

#include <stdatomic.h>
#include <string.h>
#include <sys/mman.h>

enum { PLACES = 2 * MOST_ENDPOINTS, PLACE_BITS = 12 };

_Static_assert(1 << PLACE_BITS == PLACES, "the hash has as many bits");

// What a slot counted last can be read for so long after its endpoint ended: all readers read that often.
#define REST_NS INT64_C(10000000000)

// A place that was taken once: a search goes on behind it.
#define LEFT ((void *)1)

typedef struct {
  _Atomic(const void *) handle;
  _Atomic(endpoint *) found;
} place;

pthread_mutex_t endpoints_lock = PTHREAD_MUTEX_INITIALIZER;

static place places[PLACES];
static endpoint * memory;
static counter * counters;
static int used;
static endpoint * free_ones;
static uint64_t made;
static counter * first_ended;
static counter * last_ended;

static unsigned hash(const void * handle)
{
  return (unsigned)(((uint64_t)(uintptr_t)handle * UINT64_C(0x9E3779B97F4A7C15)) >> (64 - PLACE_BITS));
}

static place * place_of(const void * handle)
{
  unsigned at = hash(handle);
  for (int tries = 0; tries < PLACES; tries++, at = (at + 1) % PLACES) {
    const void * const here = atomic_load_explicit(&places[at].handle, memory_order_acquire);
    if (here == handle) {
      return places + at;
    }
    if (here == NULL) {
      return NULL;
    }
  }
  return NULL;
}

endpoint * endpoint_of(const void * handle)
{
  place * const at = place_of(handle);
  return at != NULL ? atomic_load_explicit(&at->found, memory_order_relaxed) : NULL;
}

// Memory that nobody writes is not there: thousands of endpoints cost as much as those that are used.
static bool reserve(void)
{
  if (memory == NULL) {
    const size_t size = MOST_ENDPOINTS * sizeof(endpoint) + CAPACITY * sizeof(counter);
    void * const got = mmap(NULL, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (got == MAP_FAILED) {
      return false;
    }
    memory = got;
    counters = (counter *)(memory + MOST_ENDPOINTS);
  }
  return true;
}

static endpoint * unused(void)
{
  endpoint * found = free_ones;
  if (found != NULL) {
    free_ones = found->free;
  } else if (used < MOST_ENDPOINTS) {
    found = memory + used++;
    // Who waits lends its priority to who holds the lock: a thread in real time never waits for an ordinary one.
    pthread_mutexattr_t kind;
    pthread_mutexattr_init(&kind);
    pthread_mutexattr_setprotocol(&kind, PTHREAD_PRIO_INHERIT);
    pthread_mutex_init(&found->lock, &kind);
    pthread_mutexattr_destroy(&kind);
  }
  return found;
}

endpoint * add_endpoint(const void * handle, int64_t now)
{
  remove_endpoint(handle, now);
  pthread_mutex_lock(&endpoints_lock);
  endpoint * const found = reserve() ? unused() : NULL;
  if (found != NULL) {
    found->handle = handle;
    found->filtered = false;
    found->tried = 0;
    found->type = (message_type){NULL, false};
    found->unasked = 0;
    found->born = ++made;
    unsigned at = hash(handle);
    for (;; at = (at + 1) % PLACES) {
      const void * const here = atomic_load(&places[at].handle);
      if (here == NULL || here == LEFT) {
        break;
      }
    }
    atomic_store(&places[at].found, found);
    atomic_store_explicit(&places[at].handle, handle, memory_order_release);
  }
  pthread_mutex_unlock(&endpoints_lock);
  return found;
}

static void leave(place * at)
{
  atomic_store(&at->handle, LEFT);
  // Nothing lies behind the last of a run, so searches need not go on there.
  unsigned behind = (unsigned)(at - places);
  while (atomic_load(&places[behind].handle) == LEFT &&
         atomic_load(&places[(behind + 1) % PLACES].handle) == NULL) {
    atomic_store(&places[behind].handle, NULL);
    behind = (behind + PLACES - 1) % PLACES;
  }
}

static void end(counter * one, int64_t now)
{
  slot_end(&one->slot, now);
  one->owner = NULL;
  one->next = NULL;
  if (last_ended != NULL) {
    last_ended->next = one;
  } else {
    first_ended = one;
  }
  last_ended = one;
}

counter * ended_counter(int64_t now)
{
  counter * const found = first_ended;
  if (found == NULL) {
    return NULL;
  }
  const int64_t rested = now - found->slot.words[WORD_ENDED].number;
  if (rested >= 0 && rested < REST_NS) {
    return NULL;
  }
  first_ended = found->next;
  if (first_ended == NULL) {
    last_ended = NULL;
  }
  return found;
}

void remove_endpoint(const void * handle, int64_t now)
{
  endpoint * const gone = endpoint_of(handle);
  if (gone == NULL) {
    return;
  }
  pthread_mutex_lock(&gone->lock);
  pthread_mutex_lock(&endpoints_lock);
  place * const at = place_of(handle);
  if (at != NULL && atomic_load(&at->found) == gone) {
    leave(at);
    for (int chain = 0; chain < CHAINS; chain++) {
      for (counter *of = gone->chain[chain], *next; of != NULL; of = next) {
        next = of->next;
        end(of, now);
      }
      gone->chain[chain] = NULL;
    }
    gone->recent[0] = gone->recent[1] = NULL;
    gone->born = 0;
    memset(gone->calls, 0, sizeof(gone->calls));
    gone->free = free_ones;
    free_ones = gone;
  }
  pthread_mutex_unlock(&endpoints_lock);
  pthread_mutex_unlock(&gone->lock);
}

counter * all_counters(void)
{
  return counters;
}
