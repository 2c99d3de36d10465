// The parts of rosidl that are read here, as ROS 2 Humble to Lyrical lay them out. Nothing is ever written.
//
//   rosidl_message_type_support_t   all that Humble has of it
//   message_type_support_callbacks_t (rosidl_typesupport_fastrtps)   up to get_serialized_size
//   MessageMembers, MessageMember (rosidl_typesupport_introspection_c and _cpp)   up to what tells the type of the first
//                                   member, which lies at the beginning of a message

#ifndef ROSLENS_ROSIDL_ABI_H
#define ROSLENS_ROSIDL_ABI_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { ROSIDL_TYPE_MESSAGE = 18 };

typedef struct rosidl_type_support {
  const char * typesupport_identifier;
  const void * data;
  const struct rosidl_type_support * (*func)(const struct rosidl_type_support *, const char *);
} rosidl_type_support_t;

typedef struct {
  const char * message_namespace;
  const char * message_name;
  void * cdr_serialize;
  void * cdr_deserialize;
  uint32_t (*get_serialized_size)(const void *);
} fastrtps_callbacks_t;

typedef struct {
  const char * name;
  uint8_t type_id;
  size_t string_upper_bound;
  const rosidl_type_support_t * members;
  bool is_key_or_array;  // Humble: whether it is an array; since Jazzy whether it is a key
  bool is_array;         // since Jazzy; padding before
} rosidl_member_t;

typedef struct {
  const char * space;
  const char * name;
  uint32_t member_count;
  size_t size_of;
  union {
    struct {
      const rosidl_member_t * members;
    } humble;
    struct {
      bool has_any_key_member;
      const rosidl_member_t * members;
    } jazzy;
  };
} rosidl_members_t;

_Static_assert(offsetof(fastrtps_callbacks_t, get_serialized_size) == 4 * sizeof(void *), "the fifth word");
_Static_assert(offsetof(rosidl_member_t, is_key_or_array) == 32, "as in message_introspection.h");
_Static_assert(offsetof(rosidl_members_t, humble) == 32, "as in message_introspection.h");

#endif
