#include "counting.h"

#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "counter_file.h"

// An endpoint that has been silent for so long gives its slot to one that finds none.
#define STALE_NS INT64_C(60000000000)

// How long an endpoint that found no slot waits before it looks again.
#define RETRY_NS INT64_C(1000000000)

// Ten years: two clocks may be apart, but more is a time that was never set.
#define LONGEST_NS INT64_C(315360000000000000)

// The hook in Python writes the number of its process here, and "taken" and "published" for what it counts of the topics
// of rclpy, whose ages and processing times it alone can see.
#define PYTHON_HOOK_VARIABLE "ROSLENS_RCLPY_HOOK"

static const uint8_t nobody[GID_BYTES];

int64_t now_ns(void)
{
  struct timespec now;
  clock_gettime(CLOCK_REALTIME, &now);
  return (int64_t)now.tv_sec * 1000000000 + now.tv_nsec;
}

// Below rclpy, where the hook in Python does not see it.
#define LOG_TOPIC "/rosout"

// Nobody asks for a size longer than this for each message; a type that takes a hundred times as long is asked for each
// hundredth.
#define DEAR_NS 2000

typedef struct {
  endpoint * of;
  uint64_t born;
  int64_t since;
} taken_message;

// What this thread took last, and has not been seen to do something else since.
static __thread taken_message given __attribute__((tls_model("initial-exec")));

// Whether somebody tells when a thread does something else; without, nobody knows what a message answers.
static atomic_bool answers_counted;

__attribute__((visibility("default"))) void roslens_count_answers(void);
__attribute__((visibility("default"))) void roslens_count_answers(void)
{
  atomic_store(&answers_counted, true);
}

__attribute__((visibility("default"))) void roslens_forget_taken(void);
__attribute__((visibility("default"))) void roslens_forget_taken(void)
{
  given.of = NULL;
}

void forget_taken(void)
{
  given.of = NULL;
}

static bool python_counts(const char * direction)
{
  const char * const claim = getenv(PYTHON_HOOK_VARIABLE);
  return claim != NULL && strtol(claim, NULL, 10) == (long)getpid() && strstr(claim, direction) != NULL;
}

static bool left_to_python(const endpoint * of, int kind)
{
  if (kind == KIND_PUBLISHED) {
    return strcmp(of->name, LOG_TOPIC) != 0 && python_counts("published");
  }
  return kind == KIND_TAKEN && python_counts("taken");
}

void begin_counting(const void * handle, const rmw_node_t * node, const char * name)
{
  open_counter_file();
  if (!atomic_load(&counter_file_open)) {
    return;
  }
  if (!real_rmw.supported) {
    say("preload: not counting: the middleware is older than that of ROS 2 Humble");
    return;
  }
  endpoint * const of = add_endpoint(handle, now_ns());
  if (of == NULL) {
    count_overflow();
    return;
  }
  const char * const space = node->namespace_ != NULL ? node->namespace_ : "";
  const char * const slash = *space != '\0' && space[strlen(space) - 1] == '/' ? "" : "/";
  snprintf(of->node, sizeof(of->node), "%s%s%s", space, slash, node->name != NULL ? node->name : "");
  snprintf(of->name, sizeof(of->name), "%s", name);
  memset(of->gid, 0, sizeof(of->gid));
  char state[STATE_BYTES];
  snprintf(
    state, sizeof(state), "preload: counting %s%s", real_rmw.implementation_identifier,
    python_counts("") ? " beside Python" : "");
  say(state);
}

void learn_type(endpoint * of, const void * support, bool stamps)
{
  const message_type found = look_at_type(support, stamps);
  pthread_mutex_lock(&of->lock);
  of->type = found;
  pthread_mutex_unlock(&of->lock);
}

static int64_t steady_ns(void)
{
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (int64_t)now.tv_sec * 1000000000 + now.tv_nsec;
}

// Ask a message for its size; where that takes long, take the next ones to be as long.
static int64_t asked_size(endpoint * of, const void * content)
{
  if (of->type.length == NULL || content == NULL) {
    return -1;
  }
  if (of->unasked > 0) {
    of->unasked--;
  } else {
    const int64_t begun = steady_ns();
    of->size = size_of(&of->type, content);
    of->unasked = (steady_ns() - begun) / DEAR_NS;
  }
  return of->size;
}

void expect_gaps(endpoint * of)
{
  pthread_mutex_lock(&of->lock);
  of->filtered = true;
  pthread_mutex_unlock(&of->lock);
}

static unsigned chain_of(const uint8_t gid[GID_BYTES])
{
  uint64_t words[3];
  memcpy(words, gid, sizeof(words));
  return (unsigned)(((words[0] ^ words[1] ^ words[2]) * UINT64_C(0x9E3779B97F4A7C15)) >> 58);
}

_Static_assert(CHAINS == 64, "six bits choose the chain");

static int64_t last_of(const counter * one)
{
  return one->slot.words[WORD_LAST].number;
}

static void unchain(counter * one)
{
  endpoint * const owner = one->owner;
  counter ** link = owner->chain + chain_of(one->gid);
  while (*link != one) {
    link = &(*link)->next;
  }
  *link = one->next;
  for (int at = 0; at < 2; at++) {
    if (owner->recent[at] == one) {
      owner->recent[at] = NULL;
    }
  }
}

// Take the counter away from who has not used it for longest. `taker` is locked by the caller.
static counter * stale_counter(endpoint * taker, int64_t now)
{
  counter * const all = all_counters();
  counter * oldest = NULL;
  for (counter * one = all; one < all + CAPACITY; one++) {
    if (one->owner != NULL && (oldest == NULL || last_of(one) < last_of(oldest))) {
      oldest = one;
    }
  }
  endpoint * const owner = oldest != NULL ? oldest->owner : NULL;
  if (owner == NULL || (owner != taker && pthread_mutex_trylock(&owner->lock) != 0)) {
    return NULL;
  }
  const bool stale = last_of(oldest) + STALE_NS < now;
  if (stale) {
    unchain(oldest);
  }
  if (owner != taker) {
    pthread_mutex_unlock(&owner->lock);
  }
  return stale ? oldest : NULL;
}

static counter * claim(endpoint * of, int kind, const uint8_t gid[GID_BYTES], int64_t now, const char * other)
{
  static int fresh;
  pthread_mutex_lock(&endpoints_lock);
  counter * one = ended_counter(now);
  slot_word * const words = one == NULL && fresh < CAPACITY ? fresh_slot() : NULL;
  if (words != NULL) {
    one = all_counters() + fresh++;
    one->slot.words = words;
  } else if (one == NULL && fresh == CAPACITY) {
    one = stale_counter(of, now);
  }
  if (one != NULL) {
    one->owner = of;
    one->kind = kind;
    memcpy(one->gid, gid, GID_BYTES);
    memset(&one->numbers, 0, offsetof(sequence, gap));
    const bool own = kind == KIND_PUBLISHED;
    const uint8_t * const shown = own ? of->gid : kind == KIND_ANSWERED ? nobody : gid;
    slot_begin(&one->slot, kind, shown, of->name, of->node, other);
    counter ** const chain = of->chain + chain_of(gid);
    one->next = *chain;
    *chain = one;
    if (words != NULL) {
      show_slot();
    }
  } else {
    count_overflow();
    of->tried = now;
  }
  pthread_mutex_unlock(&endpoints_lock);
  return one;
}

// Return the counter of a kind and a publisher, of answers that of the topic that is answered; NULL where there is no slot.
static counter * counter_for(endpoint * of, int kind, const uint8_t gid[GID_BYTES], int64_t now, const char * other)
{
  counter ** const recent = of->recent + (kind == KIND_HEARD || kind == KIND_REPLIED || kind == KIND_ANSWERED);
  counter * one = *recent;
  if (one != NULL && memcmp(one->gid, gid, GID_BYTES) == 0) {
    return one;
  }
  one = of->chain[chain_of(gid)];
  while (one != NULL && (one->kind != kind || memcmp(one->gid, gid, GID_BYTES) != 0)) {
    one = one->next;
  }
  if (one == NULL && (of->tried == 0 || now - of->tried > RETRY_NS || now < of->tried)) {
    if (left_to_python(of, kind)) {
      of->tried = now;
    } else {
      one = claim(of, kind, gid, now, other);
    }
  }
  *recent = one;
  return one;
}

static counter * counter_of(endpoint * of, int kind, const uint8_t gid[GID_BYTES], int64_t now)
{
  return counter_for(of, kind, gid, now, "");
}

// Count for a publisher what its message answers; whoever looks for the counter finds it by who took what is answered.
static void count_answer(endpoint * of, int64_t now)
{
  uint8_t key[GID_BYTES] = {0};
  memcpy(key, &given.of, sizeof(given.of));
  memcpy(key + sizeof(given.of), &given.born, sizeof(given.born));
  counter * const one = counter_for(of, KIND_ANSWERED, key, now, given.of->name);
  if (one != NULL) {
    slot_answered(&one->slot, now, now - given.since);
  }
}

static int64_t latency_of(int64_t sent, int64_t received)
{
  if (sent <= 0 || received <= 0) {
    return UNKNOWN_NS;
  }
  const int64_t latency = received - sent;
  return latency > -LONGEST_NS && latency < LONGEST_NS ? latency : UNKNOWN_NS;
}

void count_published(endpoint * of, int64_t now, int64_t size, const void * content)
{
  pthread_mutex_lock(&of->lock);
  counter * const one = counter_of(of, KIND_PUBLISHED, nobody, now);
  if (one != NULL) {
    const int64_t length = size < 0 ? asked_size(of, content) : size;
    const message what = {now, now, UNKNOWN_NS, UNKNOWN_NS, UNKNOWN_NS, length, NULL};
    slot_count(&one->slot, &what);
  }
  if (given.of != NULL && given.of->born == given.born && now >= given.since) {
    count_answer(of, now);
  }
  pthread_mutex_unlock(&of->lock);
}

void count_taken(
  endpoint * of, const rmw_message_info_t * info, int64_t now, int64_t size, const void * content)
{
  uint8_t gid[GID_BYTES] = {0};
  message what = {now, now, UNKNOWN_NS, UNKNOWN_NS, UNKNOWN_NS, size, NULL};
  const bool believed = info != NULL && info->implementation_identifier == real_rmw.implementation_identifier;
  if (believed) {
    memcpy(gid, (const uint8_t *)info + offsetof(rmw_message_info_t, gid), real_rmw.gid_bytes);
    const int64_t received = info->received_timestamp > 0 ? info->received_timestamp : now;
    what.when = received;
    what.latency = latency_of(info->source_timestamp, received);
  }
  pthread_mutex_lock(&of->lock);
  if (atomic_load_explicit(&answers_counted, memory_order_relaxed)) {
    given = (taken_message){of, of->born, now};
  }
  counter * const one = counter_of(of, KIND_TAKEN, gid, now);
  if (one != NULL) {
    const int64_t stamp = stamp_of(&of->type, content);
    if (stamp != 0) {
      what.age = what.when - stamp;
    }
    if (size < 0) {
      what.size = asked_size(of, content);
    }
    const bool numbered =
      believed && real_rmw.numbers && !of->filtered && info->publication_sequence_number != SEQUENCE_NUMBER_UNSUPPORTED;
    // Without an identifier the numbers of several publishers cannot be distinguished.
    if (numbered && memcmp(gid, nobody, GID_BYTES) != 0) {
      sequence_feed(&one->numbers, info->publication_sequence_number, now);
      what.numbers = &one->numbers;
    }
    slot_count(&one->slot, &what);
  }
  pthread_mutex_unlock(&of->lock);
}

static call * call_of(endpoint * of, int64_t number)
{
  return of->calls + (uint64_t)number % CALLS;
}

static void count_begun(
  endpoint * of, int kind, const uint8_t client[16], int64_t number, int64_t now, int64_t received, int64_t latency)
{
  pthread_mutex_lock(&of->lock);
  call * const begun = call_of(of, number);
  memcpy(begun->client, client, sizeof(begun->client));
  begun->number = number;
  begun->since = now;
  counter * const one = counter_of(of, kind, nobody, now);
  if (one != NULL) {
    const message what = {now, received, latency, UNKNOWN_NS, UNKNOWN_NS, -1, NULL};
    slot_count(&one->slot, &what);
  }
  pthread_mutex_unlock(&of->lock);
}

static void count_ended(
  endpoint * of, int kind, const uint8_t client[16], int64_t number, int64_t now, int64_t received, int64_t latency)
{
  pthread_mutex_lock(&of->lock);
  call * const begun = call_of(of, number);
  int64_t processing = UNKNOWN_NS;
  if (
    begun->since != 0 && begun->number == number && now >= begun->since &&
    memcmp(begun->client, client, sizeof(begun->client)) == 0) {
    processing = now - begun->since;
    begun->since = 0;
  }
  counter * const one = counter_of(of, kind, nobody, now);
  if (one != NULL) {
    const message what = {now, received, latency, UNKNOWN_NS, processing, -1, NULL};
    slot_count(&one->slot, &what);
  }
  pthread_mutex_unlock(&of->lock);
}

void count_requested(endpoint * of, int64_t number, int64_t now)
{
  count_begun(of, KIND_REQUESTED, nobody, number, now, now, UNKNOWN_NS);
}

void count_heard(endpoint * of, const rmw_service_info_t * info, int64_t now)
{
  forget_taken();
  const int64_t received = info->received_timestamp > 0 ? info->received_timestamp : now;
  const int64_t latency = latency_of(info->source_timestamp, received);
  count_ended(of, KIND_HEARD, nobody, info->request_id.sequence_number, now, received, latency);
}

void count_asked(endpoint * of, const rmw_service_info_t * info, int64_t now)
{
  forget_taken();
  const int64_t received = info->received_timestamp > 0 ? info->received_timestamp : now;
  const int64_t latency = latency_of(info->source_timestamp, received);
  const rmw_request_id_t * const request = &info->request_id;
  count_begun(of, KIND_ASKED, request->writer_guid, request->sequence_number, now, received, latency);
}

void count_replied(endpoint * of, const rmw_request_id_t * request, int64_t now)
{
  count_ended(of, KIND_REPLIED, request->writer_guid, request->sequence_number, now, now, UNKNOWN_NS);
}
