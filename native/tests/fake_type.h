// Type supports of messages for the fake middleware, as rosidl generates them in C and C++, for Humble and since Jazzy.

#ifndef FAKE_TYPE_H
#define FAKE_TYPE_H

#include "fake_rmw.h"

// A message as the client library hands it over: its stamp is where a header would have it.
typedef struct {
  int32_t seconds;
  uint32_t nanoseconds;
} fake_message;

// Return a type support: "header" begins with one, in C and as in Humble; "jazzy" and "cpp" are that of later releases
// and of C++, "string" begins with something else, "headers" with an array of them, "bare" supports nothing; NULL for
// any other word.
const void * fake_type(const char * word);

#endif
