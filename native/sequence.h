// Which messages of a publisher are lost, by the numbers it gives them.

#ifndef ROSLENS_SEQUENCE_H
#define ROSLENS_SEQUENCE_H

#include <stdbool.h>
#include <stdint.h>

// How long a message may be late before it counts as lost. A reliable connection that sends again hands messages over
// in order, so whoever takes them sees no gap; what comes late of others was overtaken on its way or between threads.
#define SETTLE_NS INT64_C(150000000)

// A publisher that jumps farther begins anew: nobody loses that many messages between two.
#define FARTHEST_JUMP (UINT64_C(1) << 30)

// Late messages may split gaps beyond the first number; the second is where memory ends.
enum { MOST_GAPS = 256, ROOM_FOR_GAPS = 512 };

typedef struct {
  int64_t seen;
  uint64_t first;
  uint64_t last;
} sequence_gap;

// All zero is a sequence that has seen nothing.
typedef struct {
  uint64_t next;
  int64_t lost;
  int64_t pending;
  int64_t pending_since;
  int gaps;
  bool begun;
  sequence_gap gap[ROOM_FOR_GAPS];
} sequence;

// Take the number of a message that came at `now` (ns).
void sequence_feed(sequence * of, uint64_t number, int64_t now);

#endif
