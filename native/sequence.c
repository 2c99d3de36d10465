#include "sequence.h"

#include <string.h>

static void lose(sequence * of, int gaps)
{
  for (int at = 0; at < gaps; at++) {
    const int64_t missing = (int64_t)(of->gap[at].last - of->gap[at].first + 1);
    of->lost += missing;
    of->pending -= missing;
  }
  of->gaps -= gaps;
  memmove(of->gap, of->gap + gaps, (size_t)of->gaps * sizeof(of->gap[0]));
}

static void settle(sequence * of, int64_t now)
{
  int settled = 0;
  while (settled < of->gaps && now - of->gap[settled].seen > SETTLE_NS) {
    settled++;
  }
  if (settled > 0) {
    lose(of, settled);
  }
}

static void fill(sequence * of, uint64_t number)
{
  for (int at = 0; at < of->gaps; at++) {
    sequence_gap * const gap = of->gap + at;
    if (number < gap->first || number > gap->last) {
      continue;
    }
    of->pending--;
    if (gap->first == gap->last) {
      of->gaps--;
      memmove(gap, gap + 1, (size_t)(of->gaps - at) * sizeof(*gap));
    } else if (number == gap->first) {
      gap->first++;
    } else if (number == gap->last) {
      gap->last--;
    } else {
      memmove(gap + 1, gap, (size_t)(of->gaps - at) * sizeof(*gap));
      of->gaps++;
      gap[0].last = number - 1;
      gap[1].first = number + 1;
      if (of->gaps == ROOM_FOR_GAPS) {
        lose(of, 1);
      }
    }
    return;
  }
}

void sequence_feed(sequence * of, uint64_t number, int64_t now)
{
  if (of->gaps > 0) {
    settle(of, now);
  }
  // Who comes late has lost nothing, and a publisher that counts anew neither.
  if (number == of->next || !of->begun || (number > of->next && number - of->next >= FARTHEST_JUMP)) {
    of->begun = true;
    of->next = number + 1;
  } else if (number > of->next) {
    of->gap[of->gaps++] = (sequence_gap){now, of->next, number - 1};
    of->pending += (int64_t)(number - of->next);
    of->pending_since = now;
    of->next = number + 1;
    if (of->gaps > MOST_GAPS) {
      lose(of, 1);
    }
  } else {
    fill(of, number);
  }
}
