// A middleware that does nothing, as a shared library with the symbols of a real one.
//
// With HUMBLE its identifiers are those of that distribution; with ANCIENT it is older than that.

#include "fake_rmw.h"

#include <stdlib.h>
#include <string.h>

// A middleware that does nothing uses next to nothing of what it is given.
#pragma GCC diagnostic ignored "-Wunused-parameter"

#define EXPORT __attribute__((visibility("default")))

EXPORT fake_script fake;

static const char * const IDENTIFIER = "rmw_fake";

#if defined(HUMBLE) || defined(ANCIENT)
enum { THIS_GID = HUMBLE_GID_BYTES };
#else
enum { THIS_GID = LATER_GID_BYTES };
EXPORT rmw_ret_t rmw_get_gid_for_client(const void * client, rmw_gid_t * gid);
EXPORT rmw_ret_t rmw_get_gid_for_client(const void * client, rmw_gid_t * gid)
{
  return RMW_RET_OK;
}
#endif

// The layout of the distribution at hand, written apart from the declarations that the hook relies on.
typedef struct {
  int64_t source_timestamp;
  int64_t received_timestamp;
  uint64_t publication_sequence_number;
  uint64_t reception_sequence_number;
  struct {
    const char * implementation_identifier;
    uint8_t data[THIS_GID];
  } publisher_gid;
  bool from_intra_process;
} this_info;

#ifndef ANCIENT
EXPORT bool rmw_feature_supported(int feature);
EXPORT bool rmw_feature_supported(int feature)
{
  return feature == 0 && getenv("FAKE_UNNUMBERED") == NULL;
}
#endif

EXPORT void rcutils_reset_error(void);
EXPORT void rcutils_reset_error(void)
{
  fake.errors = 0;
}

EXPORT const char * rmw_get_implementation_identifier(void);
EXPORT const char * rmw_get_implementation_identifier(void)
{
  return IDENTIFIER;
}

EXPORT rmw_ret_t rmw_get_gid_for_publisher(const void * publisher, rmw_gid_t * gid);
EXPORT rmw_ret_t rmw_get_gid_for_publisher(const void * publisher, rmw_gid_t * gid)
{
  gid->implementation_identifier = IDENTIFIER;
  memset(gid->data, 0xAB, THIS_GID);
  return RMW_RET_OK;
}

static void fill(void * info)
{
  this_info * const into = info;
  memset(into, 0, sizeof(*into));
  into->source_timestamp = fake.source;
  into->received_timestamp = fake.received;
  into->publication_sequence_number = fake.number;
  into->reception_sequence_number = UINT64_MAX;
  into->publisher_gid.implementation_identifier = fake.foreign ? "somebody else" : IDENTIFIER;
  memcpy(into->publisher_gid.data, fake.gid, THIS_GID);
}

static rmw_ret_t result(void)
{
  return fake.fail ? 1 : RMW_RET_OK;
}

#define CREATE(what, ...)                               \
  EXPORT void * rmw_create_##what(__VA_ARGS__);         \
  EXPORT void * rmw_create_##what(__VA_ARGS__)          \
  {                                                     \
    return fake.fail ? NULL : malloc(64);               \
  }
CREATE(publisher, const rmw_node_t * node, const void * type, const char * name, const void * qos, const void * options)
CREATE(
  subscription, const rmw_node_t * node, const void * type, const char * name, const void * qos,
  const rmw_subscription_options_t * options)
CREATE(client, const rmw_node_t * node, const void * type, const char * name, const void * qos)
CREATE(service, const rmw_node_t * node, const void * type, const char * name, const void * qos)

#define DESTROY(what)                                                    \
  EXPORT rmw_ret_t rmw_destroy_##what(rmw_node_t * node, void * handle); \
  EXPORT rmw_ret_t rmw_destroy_##what(rmw_node_t * node, void * handle)  \
  {                                                                      \
    free(handle);                                                        \
    return RMW_RET_OK;                                                   \
  }
DESTROY(publisher)
DESTROY(subscription)
DESTROY(client)
DESTROY(service)

EXPORT rmw_ret_t rmw_subscription_set_content_filter(void * subscription, const void * options);
EXPORT rmw_ret_t rmw_subscription_set_content_filter(void * subscription, const void * options)
{
  return result();
}

EXPORT rmw_ret_t rmw_publish(const void * publisher, const void * message, void * allocation);
EXPORT rmw_ret_t rmw_publish(const void * publisher, const void * message, void * allocation)
{
  return result();
}

EXPORT rmw_ret_t rmw_publish_serialized_message(
  const void * publisher, const rmw_serialized_message_t * message, void * allocation);
EXPORT rmw_ret_t rmw_publish_serialized_message(
  const void * publisher, const rmw_serialized_message_t * message, void * allocation)
{
  return fake.nested ? rmw_publish(publisher, NULL, allocation) : result();
}

EXPORT rmw_ret_t rmw_publish_loaned_message(const void * publisher, void * message, void * allocation);
EXPORT rmw_ret_t rmw_publish_loaned_message(const void * publisher, void * message, void * allocation)
{
  return fake.nested ? rmw_publish(publisher, message, allocation) : result();
}

static rmw_ret_t take(bool * taken, void * info)
{
  *taken = !fake.empty && !fake.fail;
  if (info != NULL) {
    fill(info);
  }
  return result();
}

EXPORT rmw_ret_t rmw_take(const void * subscription, void * message, bool * taken, void * allocation);
EXPORT rmw_ret_t rmw_take(const void * subscription, void * message, bool * taken, void * allocation)
{
  return take(taken, NULL);
}

EXPORT rmw_ret_t rmw_take_with_info(
  const void * subscription, void * message, bool * taken, void * info, void * allocation);
EXPORT rmw_ret_t rmw_take_with_info(
  const void * subscription, void * message, bool * taken, void * info, void * allocation)
{
  return take(taken, info);
}

EXPORT rmw_ret_t rmw_take_serialized_message(
  const void * subscription, rmw_serialized_message_t * message, bool * taken, void * allocation);
EXPORT rmw_ret_t rmw_take_serialized_message(
  const void * subscription, rmw_serialized_message_t * message, bool * taken, void * allocation)
{
  message->buffer_length = fake.size;
  return take(taken, NULL);
}

EXPORT rmw_ret_t rmw_take_serialized_message_with_info(
  const void * subscription, rmw_serialized_message_t * message, bool * taken, void * info, void * allocation);
EXPORT rmw_ret_t rmw_take_serialized_message_with_info(
  const void * subscription, rmw_serialized_message_t * message, bool * taken, void * info, void * allocation)
{
  message->buffer_length = fake.size;
  return take(taken, info);
}

EXPORT rmw_ret_t rmw_take_loaned_message(
  const void * subscription, void ** message, bool * taken, void * allocation);
EXPORT rmw_ret_t rmw_take_loaned_message(
  const void * subscription, void ** message, bool * taken, void * allocation)
{
  return fake.nested ? rmw_take(subscription, message, taken, allocation) : take(taken, NULL);
}

EXPORT rmw_ret_t rmw_take_loaned_message_with_info(
  const void * subscription, void ** message, bool * taken, void * info, void * allocation);
EXPORT rmw_ret_t rmw_take_loaned_message_with_info(
  const void * subscription, void ** message, bool * taken, void * info, void * allocation)
{
  return fake.nested ? rmw_take_with_info(subscription, message, taken, info, allocation) : take(taken, info);
}

// Hands out messages with numbers that follow each other.
EXPORT rmw_ret_t rmw_take_sequence(
  const void * subscription, size_t count, void * messages, rmw_message_info_sequence_t * infos, size_t * taken,
  void * allocation);
EXPORT rmw_ret_t rmw_take_sequence(
  const void * subscription, size_t count, void * messages, rmw_message_info_sequence_t * infos, size_t * taken,
  void * allocation)
{
  *taken = fake.empty ? 0 : count;
  for (size_t at = 0; at < *taken; at++) {
    fill((this_info *)(void *)infos->data + at);
    fake.number++;
    fake.source += 1000;
    fake.received += 1000;
  }
  infos->size = *taken;
  return result();
}

EXPORT rmw_ret_t rmw_send_request(const void * client, const void * request, int64_t * number);
EXPORT rmw_ret_t rmw_send_request(const void * client, const void * request, int64_t * number)
{
  *number = fake.call.sequence_number;
  return result();
}

static rmw_ret_t take_call(rmw_service_info_t * info, bool * taken)
{
  info->source_timestamp = fake.source;
  info->received_timestamp = fake.received;
  info->request_id = fake.call;
  return take(taken, NULL);
}

EXPORT rmw_ret_t rmw_take_response(const void * client, rmw_service_info_t * info, void * response, bool * taken);
EXPORT rmw_ret_t rmw_take_response(const void * client, rmw_service_info_t * info, void * response, bool * taken)
{
  return take_call(info, taken);
}

EXPORT rmw_ret_t rmw_take_request(const void * service, rmw_service_info_t * info, void * request, bool * taken);
EXPORT rmw_ret_t rmw_take_request(const void * service, rmw_service_info_t * info, void * request, bool * taken)
{
  return take_call(info, taken);
}

EXPORT rmw_ret_t rmw_send_response(const void * service, rmw_request_id_t * request, void * response);
EXPORT rmw_ret_t rmw_send_response(const void * service, rmw_request_id_t * request, void * response)
{
  return result();
}
