// The layout of a counter file, as src/roslens/live/inside/slots.py defines and explains it.

#ifndef ROSLENS_COUNTER_LAYOUT_H
#define ROSLENS_COUNTER_LAYOUT_H

#include <stdint.h>

#define LAYOUT_MAGIC "RLCOUNTS"
#define LAYOUT_SUFFIX ".counters"
#define FOLDER_VARIABLE "ROSLENS_COUNTERS"

enum {
  LAYOUT_VERSION = 1,
  HEADER_BYTES = 4096,
  HOST_BYTES = 64,
  STATE_BYTES = 128,
  SLOT_WORDS = 448,
  SLOT_BYTES = SLOT_WORDS * 8,
  CAPACITY = 1024,
};

// What a slot counts. A client and a server of a service have two each, one for each direction.
enum {
  KIND_TAKEN = 1,
  KIND_PUBLISHED = 2,
  KIND_ANSWERED = 3,   // published in answer to what was taken of another topic
  KIND_REQUESTED = 4,  // requests that a client sent
  KIND_HEARD = 5,      // responses that a client took; processing is the time since the request
  KIND_ASKED = 6,      // requests that a server took
  KIND_REPLIED = 7,    // responses that a server sent; processing is the time since it took the request
};

// Words of a slot.
enum {
  WORD_SEQUENCE = 0,
  WORD_KIND = 1,
  WORD_GENERATION = 2,
  WORD_GID = 3,
  WORD_COUNT = 6,
  WORD_BYTES = 7,
  WORD_FIRST = 8,
  WORD_LAST = 9,
  WORD_LOST = 10,
  WORD_PENDING = 11,
  WORD_PENDING_SINCE = 12,
  WORD_BANK = 13,
  WORD_PERIOD = 14,
  WORD_LATENCY = 17,
  WORD_AGE = 20,
  WORD_PROCESSING = 23,
  WORD_ENDED = 26,
  WORD_BANKS = 32,
  WORD_TOPIC = 288,
  WORD_NODE = 320,
  WORD_OTHER = 352,
  WORD_END = SLOT_WORDS - 1,
};

// Words of a bank: least and greatest of each series.
enum { BANKS = 32, BANK_WORDS = 8, BANK_PERIOD = 0, BANK_LATENCY = 2, BANK_AGE = 4, BANK_PROCESSING = 6, BANK_SHIFT = 28 };

enum { GID_BYTES = 24, NAME_BYTES = 256 };

typedef union {
  int64_t number;
  double real;
} slot_word;

typedef struct {
  char magic[8];
  uint32_t version;
  uint32_t slot_bytes;
  uint32_t capacity;
  uint32_t used;
  uint64_t pid;
  int64_t started;
  uint64_t faults;
  uint64_t overflow;
  char host[HOST_BYTES];
  char state[STATE_BYTES];
} file_header;

_Static_assert(sizeof(slot_word) == 8, "words have eight bytes");
_Static_assert(sizeof(file_header) == 248, "no padding, as the struct format with = has none");

#endif
