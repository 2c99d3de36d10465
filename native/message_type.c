#include "message_type.h"

#include <string.h>

#include "real_rmw.h"
#include "rosidl_abi.h"

// The representation header in front of every serialised message.
enum { ENCAPSULATION_BYTES = 4 };

// Ask for one kind of support, as a middleware does; whoever has it not says so in an error that is nobody's business.
static const rosidl_type_support_t * support_of(const rosidl_type_support_t * of, const char * kind)
{
  const rosidl_type_support_t * const found = of->func(of, kind);
  if (found == NULL) {
    real_rmw.reset_error();
  }
  return found;
}

static const void * either(const rosidl_type_support_t * of, const char * in_c, const char * in_cpp)
{
  // A handle of C++ knows nothing of the support for C, and the other way round.
  const bool cpp = strstr(of->typesupport_identifier, "_cpp") != NULL;
  const rosidl_type_support_t * const found = support_of(of, cpp ? in_cpp : in_c);
  return found != NULL ? found->data : NULL;
}

static const rosidl_members_t * members_of(const rosidl_type_support_t * of)
{
  return either(of, "rosidl_typesupport_introspection_c", "rosidl_typesupport_introspection_cpp");
}

static const rosidl_member_t * first_member(const rosidl_members_t * of)
{
  if (of == NULL || of->member_count == 0) {
    return NULL;
  }
  // Since Jazzy a truth value stands before the pointer; a pointer is never 0 or 1.
  uint64_t word;
  memcpy(&word, &of->humble.members, sizeof(word));
  return (word & ~UINT64_C(1)) != 0 ? of->humble.members : of->jazzy.members;
}

static bool begins_with_header(const rosidl_type_support_t * of)
{
  const rosidl_member_t * const first = first_member(members_of(of));
  if (
    first == NULL || first->type_id != ROSIDL_TYPE_MESSAGE || first->is_key_or_array || first->is_array ||
    first->members == NULL) {
    return false;
  }
  const rosidl_members_t * const header = members_of(first->members);
  return header != NULL && strcmp(header->name, "Header") == 0 && strncmp(header->space, "std_msgs", 8) == 0;
}

message_type look_at_type(const void * support, bool stamps)
{
  message_type found = {NULL, false};
  const rosidl_type_support_t * const of = support;
  if (of == NULL || of->typesupport_identifier == NULL || of->func == NULL || real_rmw.reset_error == NULL) {
    return found;
  }
  const fastrtps_callbacks_t * const callbacks =
    either(of, "rosidl_typesupport_fastrtps_c", "rosidl_typesupport_fastrtps_cpp");
  if (callbacks != NULL) {
    found.length = callbacks->get_serialized_size;
  }
  found.stamped = stamps && begins_with_header(of);
  return found;
}

int64_t size_of(const message_type * type, const void * message)
{
  return type->length != NULL && message != NULL ? (int64_t)type->length(message) + ENCAPSULATION_BYTES : -1;
}

int64_t stamp_of(const message_type * type, const void * message)
{
  if (!type->stamped || message == NULL) {
    return 0;
  }
  struct {
    int32_t seconds;
    uint32_t nanoseconds;
  } stamp;
  memcpy(&stamp, message, sizeof(stamp));
  return stamp.seconds != 0 ? (int64_t)stamp.seconds * 1000000000 + stamp.nanoseconds : 0;
}
