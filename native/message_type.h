// What is known of the messages of an endpoint by their type: how long they are on the wire, and where their stamp is.
//
// Types are described by rosidl; who made the type support decides what can be asked of it. What is not there, or is not
// laid out as declared, stays unknown.

#ifndef ROSLENS_MESSAGE_TYPE_H
#define ROSLENS_MESSAGE_TYPE_H

#include <stdbool.h>
#include <stdint.h>

typedef struct {
  uint32_t (*length)(const void * message);  // serialised, without the four bytes before it; NULL where unknown
  bool stamped;                              // whether a message begins with a std_msgs/Header, that is, with its stamp
} message_type;

// Return what is known of a type support (rosidl_message_type_support_t); `stamps` asks for where stamps are, too.
message_type look_at_type(const void * support, bool stamps);

// Return the serialised size of a message in bytes, -1 where it is not known.
int64_t size_of(const message_type * type, const void * message);

// Return the stamp of a message, ns since the epoch; 0 where it has none.
int64_t stamp_of(const message_type * type, const void * message);

#endif
