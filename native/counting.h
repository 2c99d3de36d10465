// Counts the messages of an endpoint in the slots of those they come from.

#ifndef ROSLENS_COUNTING_H
#define ROSLENS_COUNTING_H

#include "endpoint.h"
#include "real_rmw.h"

// Begin to count for a handle that was just made.
void begin_counting(const void * handle, const rmw_node_t * node, const char * name);

// Count no losses of a subscription any more: its middleware leaves messages out on purpose.
void expect_gaps(endpoint * of);

// Count a message published at `now`, of `size` bytes or -1.
void count_published(endpoint * of, int64_t now, int64_t size);

// Count a message that was taken; `info` is NULL where nothing is known of it.
void count_taken(endpoint * of, const rmw_message_info_t * info, int64_t now, int64_t size);

// Count a call at the client: its request, then its response.
void count_requested(endpoint * of, int64_t number, int64_t now);
void count_heard(endpoint * of, const rmw_service_info_t * info, int64_t now);

// Count a call at the server: its request, then its response.
void count_asked(endpoint * of, const rmw_service_info_t * info, int64_t now);
void count_replied(endpoint * of, const rmw_request_id_t * request, int64_t now);

// Return the time, ns since the epoch.
int64_t now_ns(void);

#endif
