// The parts of the rmw interface that are read here, as ROS 2 Humble to Lyrical lay them out.
//
// Only beginnings of structs are declared; what lies behind them differs between distributions and is never touched:
//   rmw_node_t             name, namespace_
//   rmw_subscription_options_t   content_filter_options, whether there are any
//   rmw_serialized_message_t   buffer_length
//   rmw_message_info_t     source_timestamp, received_timestamp, publication_sequence_number, publisher_gid. Humble's
//                          identifiers have 24 bytes, those of later ones 16, so elements of an array lie 72 or 64 bytes
//                          apart. The identifier's first field must be the pointer that
//                          rmw_get_implementation_identifier() returns: where it is not, the struct is not believed.
//   rmw_service_info_t     all of it
//   rmw_request_id_t       all of it
// Publishers, subscriptions, clients and servers are only compared by address.

#ifndef ROSLENS_RMW_ABI_H
#define ROSLENS_RMW_ABI_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef int32_t rmw_ret_t;
enum { RMW_RET_OK = 0, RMW_RET_UNSUPPORTED = 3 };

// Distributions without rmw_get_gid_for_client, which is Humble, have the longer identifiers.
enum { HUMBLE_GID_BYTES = 24, LATER_GID_BYTES = 16, HUMBLE_INFO_BYTES = 72, LATER_INFO_BYTES = 64 };

// Publication sequence numbers are supported; the value of the enumerator in rmw_feature_t.
enum { FEATURE_PUBLICATION_SEQUENCE_NUMBER = 0 };
#define SEQUENCE_NUMBER_UNSUPPORTED UINT64_MAX

typedef struct {
  const char * implementation_identifier;
  void * data;
  const char * name;
  const char * namespace_;
} rmw_node_t;

typedef struct {
  void * rmw_specific_subscription_payload;
  bool ignore_local_publications;
  int require_unique_network_flow_endpoints;
  const void * content_filter_options;
} rmw_subscription_options_t;

typedef struct {
  uint8_t * buffer;
  size_t buffer_length;
} rmw_serialized_message_t;

typedef struct {
  const char * implementation_identifier;
  uint8_t data[HUMBLE_GID_BYTES];  // the longest
} rmw_gid_t;

typedef struct {
  int64_t source_timestamp;
  int64_t received_timestamp;
  uint64_t publication_sequence_number;
  uint64_t reception_sequence_number;
  const char * implementation_identifier;
  uint8_t gid[LATER_GID_BYTES];  // the shortest
} rmw_message_info_t;

typedef struct {
  rmw_message_info_t * data;
  size_t size;
} rmw_message_info_sequence_t;

typedef struct {
  uint8_t writer_guid[16];
  int64_t sequence_number;
} rmw_request_id_t;

typedef struct {
  int64_t source_timestamp;
  int64_t received_timestamp;
  rmw_request_id_t request_id;
} rmw_service_info_t;

_Static_assert(offsetof(rmw_message_info_t, gid) == 40, "as in rmw/types.h");
_Static_assert(offsetof(rmw_subscription_options_t, content_filter_options) == 2 * sizeof(void *), "as in rmw/types.h");
_Static_assert(sizeof(rmw_service_info_t) == 40, "as in rmw/types.h");

#endif
