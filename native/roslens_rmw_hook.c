// Wraps the calls between a ROS 2 client library and its middleware and counts what passes; preloaded into nodes.
//
// Each function calls the real one with the same arguments and returns what it returns. Only the outermost of nested
// calls counts, for some middleware implements one function by another. Messages that the hook in Python claims in
// ROSLENS_RCLPY_HOOK are left to it.

#include <stddef.h>

#include "counter_file.h"
#include "counting.h"
#include "endpoint.h"
#include "real_rmw.h"

#define EXPORT __attribute__((visibility("default")))

// Whether this thread is within a wrapped function.
static __thread bool within __attribute__((tls_model("initial-exec")));

static inline void ready(const void * caller)
{
  if (__builtin_expect(!atomic_load_explicit(&real_rmw_found, memory_order_acquire), 0)) {
    const bool nested = within;
    within = true;
    find_real_rmw(caller);
    within = nested;
  }
}

// Call the real function, from within.
#define CALL(name, ...)                                                                  \
  __extension__({                                                                        \
    const bool nested_ = within;                                                         \
    within = true;                                                                       \
    const rmw_ret_t result_ = real_rmw.name != NULL ? real_rmw.name(__VA_ARGS__) : RMW_RET_UNSUPPORTED; \
    within = nested_;                                                                    \
    result_;                                                                             \
  })

static inline endpoint * counted(const void * handle)
{
  if (within || !atomic_load_explicit(&counter_file_open, memory_order_relaxed)) {
    return NULL;
  }
  return endpoint_of(handle);
}

// Count as if within a wrapped function: a signal handler that publishes must not wait for the thread it interrupts.
#define COUNT(call) (within = true, call, within = false)

static void made(const void * handle, const rmw_node_t * node, const char * name)
{
  if (handle != NULL && node != NULL && name != NULL && !within) {
    COUNT(begin_counting(handle, node, name));
  }
}

static void learn_publisher(const void * publisher, const void * type)
{
  endpoint * const of = counted(publisher);
  rmw_gid_t gid = {0};
  if (of != NULL) {
    COUNT(learn_type(of, type, false));
  }
  if (of != NULL && CALL(get_gid_for_publisher, publisher, &gid) == RMW_RET_OK) {
    __builtin_memcpy(of->gid, gid.data, GID_BYTES);
  }
}

// Create a handle and begin to count it. Takes a statement for what else is to be done with it.
#define CREATE(name, node, entity, also, ...)                                            \
  ready(__builtin_return_address(0));                                                    \
  const bool nested = within;                                                            \
  within = true;                                                                         \
  void * const handle = real_rmw.name != NULL ? real_rmw.name(__VA_ARGS__) : NULL;       \
  within = nested;                                                                       \
  made(handle, node, entity);                                                            \
  also;                                                                                  \
  return handle

EXPORT void * rmw_create_publisher(
  const rmw_node_t * node, const void * type, const char * name, const void * qos, const void * options)
{
  CREATE(create_publisher, node, name, learn_publisher(handle, type), node, type, name, qos, options);
}

static void learn_subscription(const void * subscription, const void * type)
{
  endpoint * const of = counted(subscription);
  if (of != NULL) {
    COUNT(learn_type(of, type, true));
  }
}

static void learn_filter(const void * subscription, bool filtered)
{
  endpoint * const of = filtered ? counted(subscription) : NULL;
  if (of != NULL) {
    COUNT(expect_gaps(of));
  }
}

EXPORT void * rmw_create_subscription(
  const rmw_node_t * node, const void * type, const char * name, const void * qos,
  const rmw_subscription_options_t * options)
{
  const bool filtered = options != NULL && options->content_filter_options != NULL;
  CREATE(
    create_subscription, node, name, (learn_subscription(handle, type), learn_filter(handle, filtered)), node, type, name, qos, options);
}

EXPORT rmw_ret_t rmw_subscription_set_content_filter(void * subscription, const void * options)
{
  ready(__builtin_return_address(0));
  learn_filter(subscription, true);
  return CALL(subscription_set_content_filter, subscription, options);
}

EXPORT void * rmw_create_client(const rmw_node_t * node, const void * type, const char * name, const void * qos)
{
  CREATE(create_client, node, name, , node, type, name, qos);
}

EXPORT void * rmw_create_service(const rmw_node_t * node, const void * type, const char * name, const void * qos)
{
  CREATE(create_service, node, name, , node, type, name, qos);
}

// Forgotten before it is destroyed: its address may be another's as soon as it is.
#define DESTROY(name, node, handle)       \
  ready(__builtin_return_address(0));     \
  if (counted(handle) != NULL) {          \
    COUNT(remove_endpoint(handle, now_ns()));       \
  }                                       \
  return CALL(name, node, handle)

EXPORT rmw_ret_t rmw_destroy_publisher(rmw_node_t * node, void * handle)
{
  DESTROY(destroy_publisher, node, handle);
}

EXPORT rmw_ret_t rmw_destroy_subscription(rmw_node_t * node, void * handle)
{
  DESTROY(destroy_subscription, node, handle);
}

EXPORT rmw_ret_t rmw_destroy_client(rmw_node_t * node, void * handle)
{
  DESTROY(destroy_client, node, handle);
}

EXPORT rmw_ret_t rmw_destroy_service(rmw_node_t * node, void * handle)
{
  DESTROY(destroy_service, node, handle);
}

// Publish, and count what was published when the call began.
#define PUBLISH(name, size, content, publisher, ...)                \
  ready(__builtin_return_address(0));                               \
  endpoint * const of = counted(publisher);                         \
  const int64_t now = of != NULL ? now_ns() : 0;                    \
  const rmw_ret_t result = CALL(name, publisher, __VA_ARGS__);      \
  if (result == RMW_RET_OK && of != NULL) {                         \
    COUNT(count_published(of, now, size, content));                 \
  }                                                                 \
  return result

EXPORT rmw_ret_t rmw_publish(const void * publisher, const void * message, void * allocation)
{
  PUBLISH(publish, -1, message, publisher, message, allocation);
}

EXPORT rmw_ret_t rmw_publish_serialized_message(
  const void * publisher, const rmw_serialized_message_t * message, void * allocation)
{
  PUBLISH(publish_serialized_message, (int64_t)message->buffer_length, NULL, publisher, message, allocation);
}

EXPORT rmw_ret_t rmw_publish_loaned_message(const void * publisher, void * message, void * allocation)
{
  // Once it is published it is the middleware's. What can be lent has a fixed size, which is quick to ask for.
  const endpoint * const lent = counted(publisher);
  const int64_t size = lent != NULL ? size_of(&lent->type, message) : -1;
  PUBLISH(publish_loaned_message, size, NULL, publisher, message, allocation);
}

// Take, and count what was taken.
#define TAKE(name, size, content, info, subscription, ...)              \
  ready(__builtin_return_address(0));                                   \
  const rmw_ret_t result = CALL(name, subscription, __VA_ARGS__);       \
  if (result == RMW_RET_OK && *taken) {                                 \
    endpoint * const of = counted(subscription);                        \
    if (of != NULL) {                                                   \
      COUNT(count_taken(of, info, now_ns(), size, content));            \
    }                                                                   \
  }                                                                     \
  return result

EXPORT rmw_ret_t rmw_take(const void * subscription, void * message, bool * taken, void * allocation)
{
  TAKE(take, -1, message, NULL, subscription, message, taken, allocation);
}

EXPORT rmw_ret_t rmw_take_with_info(
  const void * subscription, void * message, bool * taken, rmw_message_info_t * info, void * allocation)
{
  TAKE(take_with_info, -1, message, info, subscription, message, taken, info, allocation);
}

EXPORT rmw_ret_t rmw_take_serialized_message(
  const void * subscription, rmw_serialized_message_t * message, bool * taken, void * allocation)
{
  TAKE(
    take_serialized_message, (int64_t)message->buffer_length, NULL, NULL, subscription, message, taken, allocation);
}

EXPORT rmw_ret_t rmw_take_serialized_message_with_info(
  const void * subscription, rmw_serialized_message_t * message, bool * taken, rmw_message_info_t * info,
  void * allocation)
{
  TAKE(
    take_serialized_message_with_info, (int64_t)message->buffer_length, NULL, info, subscription, message, taken, info,
    allocation);
}

EXPORT rmw_ret_t rmw_take_loaned_message(const void * subscription, void ** message, bool * taken, void * allocation)
{
  TAKE(take_loaned_message, -1, *message, NULL, subscription, message, taken, allocation);
}

EXPORT rmw_ret_t rmw_take_loaned_message_with_info(
  const void * subscription, void ** message, bool * taken, rmw_message_info_t * info, void * allocation)
{
  TAKE(take_loaned_message_with_info, -1, *message, info, subscription, message, taken, info, allocation);
}

EXPORT rmw_ret_t rmw_take_sequence(
  const void * subscription, size_t count, void * messages, rmw_message_info_sequence_t * infos, size_t * taken,
  void * allocation)
{
  ready(__builtin_return_address(0));
  const rmw_ret_t result = CALL(take_sequence, subscription, count, messages, infos, taken, allocation);
  endpoint * const of = result == RMW_RET_OK && *taken > 0 ? counted(subscription) : NULL;
  if (of != NULL) {
    const int64_t now = now_ns();
    const char * const first = (const char *)infos->data;
    for (size_t at = 0; at < *taken; at++) {
      COUNT(count_taken(of, (const rmw_message_info_t *)(first + at * real_rmw.info_bytes), now, -1, NULL));
    }
  }
  return result;
}

EXPORT rmw_ret_t rmw_send_request(const void * client, const void * request, int64_t * number)
{
  ready(__builtin_return_address(0));
  endpoint * const of = counted(client);
  const int64_t now = of != NULL ? now_ns() : 0;
  const rmw_ret_t result = CALL(send_request, client, request, number);
  if (result == RMW_RET_OK && of != NULL) {
    COUNT(count_requested(of, *number, now));
  }
  return result;
}

EXPORT rmw_ret_t rmw_send_response(const void * service, rmw_request_id_t * request, void * response)
{
  ready(__builtin_return_address(0));
  endpoint * const of = counted(service);
  const int64_t now = of != NULL ? now_ns() : 0;
  const rmw_ret_t result = CALL(send_response, service, request, response);
  if (result == RMW_RET_OK && of != NULL) {
    COUNT(count_replied(of, request, now));
  }
  return result;
}

// Take a request or a response, and count it.
#define TAKE_CALL(name, count, handle, info, message)                  \
  ready(__builtin_return_address(0));                                  \
  const rmw_ret_t result = CALL(name, handle, info, message, taken);   \
  if (result == RMW_RET_OK && *taken) {                                \
    endpoint * const of = counted(handle);                             \
    if (of != NULL) {                                                  \
      COUNT(count(of, info, now_ns()));                                \
    }                                                                  \
  }                                                                    \
  return result

EXPORT rmw_ret_t rmw_take_response(const void * client, rmw_service_info_t * info, void * response, bool * taken)
{
  TAKE_CALL(take_response, count_heard, client, info, response);
}

EXPORT rmw_ret_t rmw_take_request(const void * service, rmw_service_info_t * info, void * request, bool * taken)
{
  TAKE_CALL(take_request, count_asked, service, info, request);
}
