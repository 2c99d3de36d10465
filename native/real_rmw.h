// The functions that the client library would have called were this library not there.

#ifndef ROSLENS_REAL_RMW_H
#define ROSLENS_REAL_RMW_H

#include <stdatomic.h>

#include "rmw_abi.h"

// Every function of the interface that is wrapped: result, name behind rmw_, parameters.
#define WRAPPED_FUNCTIONS(X)                                                                                    \
  X(void *, create_publisher, (const rmw_node_t *, const void *, const char *, const void *, const void *))     \
  X(rmw_ret_t, destroy_publisher, (rmw_node_t *, void *))                                                       \
  X(void *, create_subscription,                                                                                \
    (const rmw_node_t *, const void *, const char *, const void *, const rmw_subscription_options_t *))         \
  X(rmw_ret_t, destroy_subscription, (rmw_node_t *, void *))                                                    \
  X(rmw_ret_t, subscription_set_content_filter, (void *, const void *))                                         \
  X(void *, create_client, (const rmw_node_t *, const void *, const char *, const void *))                      \
  X(rmw_ret_t, destroy_client, (rmw_node_t *, void *))                                                          \
  X(void *, create_service, (const rmw_node_t *, const void *, const char *, const void *))                     \
  X(rmw_ret_t, destroy_service, (rmw_node_t *, void *))                                                         \
  X(rmw_ret_t, publish, (const void *, const void *, void *))                                                   \
  X(rmw_ret_t, publish_serialized_message, (const void *, const rmw_serialized_message_t *, void *))            \
  X(rmw_ret_t, publish_loaned_message, (const void *, void *, void *))                                          \
  X(rmw_ret_t, take, (const void *, void *, bool *, void *))                                                    \
  X(rmw_ret_t, take_with_info, (const void *, void *, bool *, rmw_message_info_t *, void *))                    \
  X(rmw_ret_t, take_sequence, (const void *, size_t, void *, rmw_message_info_sequence_t *, size_t *, void *))  \
  X(rmw_ret_t, take_serialized_message, (const void *, rmw_serialized_message_t *, bool *, void *))             \
  X(rmw_ret_t, take_serialized_message_with_info,                                                               \
    (const void *, rmw_serialized_message_t *, bool *, rmw_message_info_t *, void *))                           \
  X(rmw_ret_t, take_loaned_message, (const void *, void **, bool *, void *))                                    \
  X(rmw_ret_t, take_loaned_message_with_info, (const void *, void **, bool *, rmw_message_info_t *, void *))    \
  X(rmw_ret_t, send_request, (const void *, const void *, int64_t *))                                           \
  X(rmw_ret_t, take_response, (const void *, rmw_service_info_t *, void *, bool *))                             \
  X(rmw_ret_t, take_request, (const void *, rmw_service_info_t *, void *, bool *))                              \
  X(rmw_ret_t, send_response, (const void *, rmw_request_id_t *, void *))

typedef struct {
#define FIELD(result, name, parameters) result(*name) parameters;
  WRAPPED_FUNCTIONS(FIELD)
#undef FIELD
  rmw_ret_t (*get_gid_for_publisher)(const void *, rmw_gid_t *);
  void (*reset_error)(void);  // of rcutils; NULL where that is not found
  const char * implementation_identifier;  // as the middleware writes it into what it hands out
  size_t gid_bytes;
  size_t info_bytes;
  bool numbers;    // whether publication sequence numbers are right
  bool supported;  // whether the structs are known to be laid out as declared
} real_functions;

extern real_functions real_rmw;
extern atomic_bool real_rmw_found;

// Find the functions; `caller` is an address in who calls one of them.
void find_real_rmw(const void * caller);

#endif
