// The counters of one kind of traffic of one endpoint, written so that other processes may read at any time.
//
// Who writes a slot holds the lock of its endpoint. Readers need none: see the two sequence words in slots.py.

#ifndef ROSLENS_SLOT_H
#define ROSLENS_SLOT_H

#include <stdint.h>

#include "counter_layout.h"
#include "sequence.h"

// A time span that is not known.
#define UNKNOWN_NS INT64_MIN

typedef struct {
  slot_word * words;
  int64_t bank_time;
  int bank_at;
} slot;

// A message that came or went. Times are ns.
typedef struct {
  int64_t now;             // when it is counted
  int64_t when;            // of its receipt, or of its publishing
  int64_t latency;         // from its publishing to its receipt
  int64_t age;             // from its stamp to its receipt
  int64_t processing;      // from what it answers to it
  int64_t size;            // serialised, in bytes; -1 where unknown
  const sequence * numbers;  // what knows the losses of the connection; NULL where nothing does
} message;

// Fill the slot in for an endpoint, whatever was counted in it before.
void slot_begin(
  slot * in, int kind, const uint8_t gid[GID_BYTES], const char * topic, const char * node, const char * other);

void slot_count(slot * in, const message * what);

// Note when the endpoint was destroyed: nothing more is counted here.
void slot_end(slot * in, int64_t now);

// Count a message that answers another, in a slot for these alone: when, and how long after the other one was taken.
void slot_answered(slot * in, int64_t now, int64_t processing);

#endif
