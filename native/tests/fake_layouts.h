// What rosidl generates about a message in each release of ROS 2, whole, as its headers declare it: what the library
// declares of it (rosidl_abi.h) are beginnings alone.
//
//   Humble    message_introspection.h without keys
//   Jazzy, Kilted   a member says whether it is a key, members whether any of them is
//   Lyrical   a member says whether it is a rosidl::Buffer, in its last field, which makes it a word longer;
//             callbacks say whether there are any, and have two more functions

#ifndef FAKE_LAYOUTS_H
#define FAKE_LAYOUTS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "../rosidl_abi.h"

typedef void (*any_function)(void);

typedef struct {
  const char * name_;
  uint8_t type_id_;
  size_t string_upper_bound_;
  const rosidl_type_support_t * members_;
  bool is_array_;
  size_t array_size_;
  bool is_upper_bound_;
  uint32_t offset_;
  const void * default_value_;
  any_function size, get_const, get, fetch, assign, resize;
} member_of_humble;

typedef struct {
  const char * name_;
  uint8_t type_id_;
  size_t string_upper_bound_;
  const rosidl_type_support_t * members_;
  bool is_key_;
  bool is_array_;
  size_t array_size_;
  bool is_upper_bound_;
  uint32_t offset_;
  const void * default_value_;
  any_function size, get_const, get, fetch, assign, resize;
} member_of_jazzy;

typedef struct {
  const char * name_;
  uint8_t type_id_;
  size_t string_upper_bound_;
  const rosidl_type_support_t * members_;
  bool is_key_;
  bool is_array_;
  size_t array_size_;
  bool is_upper_bound_;
  uint32_t offset_;
  const void * default_value_;
  any_function size, get_const, get, fetch, assign, resize;
  bool is_rosidl_buffer_;
} member_of_lyrical;

typedef struct {
  const char * message_namespace_;
  const char * message_name_;
  any_function cdr_serialize, cdr_deserialize;
  uint32_t (*get_serialized_size)(const void *);
  any_function max_serialized_size;
  void * key_callbacks;
  bool has_buffer_fields;
  any_function cdr_serialize_with_endpoint, cdr_deserialize_with_endpoint;
} callbacks_of_lyrical;

_Static_assert(sizeof(member_of_lyrical) == sizeof(member_of_jazzy) + sizeof(void *), "a word longer");
_Static_assert(offsetof(member_of_humble, is_array_) == offsetof(rosidl_member_t, is_key_or_array), "Humble");
_Static_assert(offsetof(member_of_jazzy, is_key_) == offsetof(rosidl_member_t, is_key_or_array), "since Jazzy");
_Static_assert(offsetof(member_of_lyrical, is_array_) == offsetof(rosidl_member_t, is_array), "since Jazzy");
_Static_assert(
  offsetof(callbacks_of_lyrical, get_serialized_size) == offsetof(fastrtps_callbacks_t, get_serialized_size), "Lyrical");

#endif
