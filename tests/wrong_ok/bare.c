/* Preloaded, it makes a participant without ROS of a node: what tells others of its nodes is not sent. */

#define _GNU_SOURCE
#include <dlfcn.h>
#include <string.h>

#define PUBLISH \
  "_ZN23rmw_fastrtps_shared_cpp13__rmw_publishEPKcPK15rmw_publisher_sPKvP26rmw_publisher_allocation_s"

struct rmw_publisher {
  const char *implementation;
  void *data;
  const char *topic;
};

typedef int publish_function(const char *, const struct rmw_publisher *, const void *, void *);

int publish(const char *, const struct rmw_publisher *, const void *, void *) __asm__(PUBLISH);

int publish(const char *identifier, const struct rmw_publisher *publisher, const void *message, void *allocation)
{
  static publish_function *next;
  if (strstr(publisher->topic, "ros_discovery_info"))
    return 0;
  /* The library was loaded for nobody else to see: RTLD_NEXT does not find it. */
  if (!next)
    next = (publish_function *)dlsym(dlopen("librmw_fastrtps_shared_cpp.so", RTLD_LAZY | RTLD_NOLOAD), PUBLISH);
  return next(identifier, publisher, message, allocation);
}
