// What the fake middleware is given by a test, beside the functions of rmw.

#ifndef FAKE_RMW_H
#define FAKE_RMW_H

#include "../rmw_abi.h"

// What the next takes hand out. Identifiers have 24 bytes; only as many as the distribution has are used.
typedef struct {
  int64_t source;
  int64_t received;
  uint64_t number;
  uint8_t gid[HUMBLE_GID_BYTES];
  bool foreign;  // whether the identifier of the implementation is somebody else's
  bool fail;     // whether calls fail
  bool empty;    // whether nothing is there to be taken
  bool nested;   // whether functions are implemented by one another, through their exported names
  size_t size;   // of serialised messages; of others as their type support tells it
  int32_t stamp;  // seconds in the header of messages
  int errors;    // that were set and not taken back
  int asked;     // how often a size was asked for
  rmw_request_id_t call;
} fake_script;

extern fake_script fake;

#endif
