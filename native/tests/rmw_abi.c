// Compiled against the headers of a real ROS 2: what is declared in rmw_abi.h lies where they put it.

#include <stddef.h>

#include <rmw/message_sequence.h>
#include <rmw/rmw.h>
#include <rmw/types.h>

#define rmw_node_t declared_node
#define rmw_gid_t declared_gid
#define rmw_message_info_t declared_info
#define rmw_message_info_sequence_t declared_infos
#define rmw_request_id_t declared_request
#define rmw_service_info_t declared_service
#define rmw_serialized_message_t declared_bytes
#define rmw_subscription_options_t declared_options
#define rmw_ret_t declared_ret
#undef RMW_RET_OK
#undef RMW_RET_UNSUPPORTED
#include "../rmw_abi.h"
#undef rmw_node_t
#undef rmw_gid_t
#undef rmw_message_info_t
#undef rmw_message_info_sequence_t
#undef rmw_request_id_t
#undef rmw_service_info_t
#undef rmw_serialized_message_t
#undef rmw_subscription_options_t
#undef rmw_ret_t

#define SAME(real, real_field, declared, field) \
  _Static_assert(offsetof(real, real_field) == offsetof(declared, field), #real "." #real_field)

SAME(rmw_node_t, name, declared_node, name);
SAME(rmw_node_t, namespace_, declared_node, namespace_);
SAME(rmw_gid_t, data, declared_gid, data);
SAME(rmw_message_info_t, source_timestamp, declared_info, source_timestamp);
SAME(rmw_message_info_t, received_timestamp, declared_info, received_timestamp);
SAME(rmw_message_info_t, publication_sequence_number, declared_info, publication_sequence_number);
SAME(rmw_message_info_t, publisher_gid.implementation_identifier, declared_info, implementation_identifier);
SAME(rmw_message_info_t, publisher_gid.data, declared_info, gid);
SAME(rmw_message_info_sequence_t, data, declared_infos, data);
SAME(rmw_request_id_t, writer_guid, declared_request, writer_guid);
SAME(rmw_request_id_t, sequence_number, declared_request, sequence_number);
SAME(rmw_service_info_t, source_timestamp, declared_service, source_timestamp);
SAME(rmw_service_info_t, received_timestamp, declared_service, received_timestamp);
SAME(rmw_service_info_t, request_id, declared_service, request_id);
SAME(rmw_serialized_message_t, buffer_length, declared_bytes, buffer_length);
SAME(rmw_subscription_options_t, content_filter_options, declared_options, content_filter_options);

_Static_assert(sizeof(rmw_gid_t) <= sizeof(declared_gid), "an identifier fits");
_Static_assert(
  sizeof(rmw_message_info_t) == (RMW_GID_STORAGE_SIZE == LATER_GID_BYTES ? LATER_INFO_BYTES : HUMBLE_INFO_BYTES),
  "elements of an array lie as far apart");
_Static_assert(sizeof(rmw_ret_t) == sizeof(declared_ret), "results are as large");
_Static_assert(RMW_MESSAGE_INFO_SEQUENCE_NUMBER_UNSUPPORTED == SEQUENCE_NUMBER_UNSUPPORTED, "no number");
_Static_assert(
  (int)RMW_FEATURE_MESSAGE_INFO_PUBLICATION_SEQUENCE_NUMBER == (int)FEATURE_PUBLICATION_SEQUENCE_NUMBER, "the feature");
