// Counts the messages of an endpoint in the slots of those they come from.

#ifndef ROSLENS_COUNTING_H
#define ROSLENS_COUNTING_H

#include "endpoint.h"
#include "real_rmw.h"

// Begin to count for a handle that was just made.
void begin_counting(const void * handle, const rmw_node_t * node, const char * name);

// Learn what is to be known of the messages of a publisher or a subscription by their type.
void learn_type(endpoint * of, const void * support, bool stamps);

// Count no losses of a subscription any more: its middleware leaves messages out on purpose.
void expect_gaps(endpoint * of);

// Count a message published at `now`, of `size` bytes or -1; `content` is the message where its type tells its size.
void count_published(endpoint * of, int64_t now, int64_t size, const void * content);

// Count a message that was taken; `info` is NULL where nothing is known of it, `content` where it is serialised.
void count_taken(
  endpoint * of, const rmw_message_info_t * info, int64_t now, int64_t size, const void * content);

// Note that this thread does something else than to answer the message that it took last.
void forget_taken(void);

// Count a call at the client: its request, then its response.
void count_requested(endpoint * of, int64_t number, int64_t now);
void count_heard(endpoint * of, const rmw_service_info_t * info, int64_t now);

// Count a call at the server: its request, then its response.
void count_asked(endpoint * of, const rmw_service_info_t * info, int64_t now);
void count_replied(endpoint * of, const rmw_request_id_t * request, int64_t now);

// Return the time, ns since the epoch.
int64_t now_ns(void);

#endif
