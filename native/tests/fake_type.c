#include "fake_type.h"

#include <string.h>

#include "../rosidl_abi.h"
#include "fake_layouts.h"

enum { UINT8 = 8, STRING = 16 };

typedef struct {
  const char * space;
  const char * name;
  uint32_t member_count;
  size_t size_of;
  bool has_any_key_member;
  const void * members;
  void (*init)(void *);
} members_since_jazzy;

typedef struct {
  const char * space;
  const char * name;
  uint32_t member_count;
  size_t size_of;
  const void * members;
  void (*init)(void *);
} members_of_humble;

static uint32_t size(const void * message)
{
  (void)message;
  fake.asked++;
  return (uint32_t)fake.size;
}

static const fastrtps_callbacks_t callbacks = {.message_name = "Fake", .get_serialized_size = size};
static const rosidl_type_support_t fastrtps = {"rosidl_typesupport_fastrtps", &callbacks, NULL};

static const rosidl_type_support_t * header_support(const rosidl_type_support_t * of, const char * kind);

static const members_of_humble header_of_c = {"std_msgs__msg", "Header", 2, 24, NULL, NULL};
static const members_since_jazzy header_of_cpp = {"std_msgs::msg", "Header", 2, 40, false, NULL, NULL};
static const rosidl_type_support_t header_in_c = {"rosidl_typesupport_introspection_c", &header_of_c, header_support};
static const rosidl_type_support_t header_in_cpp = {
  "rosidl_typesupport_introspection_cpp", &header_of_cpp, header_support};

static const rosidl_type_support_t * header_support(const rosidl_type_support_t * of, const char * kind)
{
  return strcmp(of->typesupport_identifier, kind) == 0 ? of : NULL;
}

static const rosidl_member_t headed[] = {{"header", ROSIDL_TYPE_MESSAGE, 0, &header_in_c, false, false}};
static const rosidl_member_t headed_in_cpp[] = {{"header", ROSIDL_TYPE_MESSAGE, 0, &header_in_cpp, false, false}};
static const rosidl_member_t many_headers[] = {{"headers", ROSIDL_TYPE_MESSAGE, 0, &header_in_c, true, false}};
static const rosidl_member_t text[] = {{"data", STRING, 0, NULL, false, false}};

static const members_of_humble of_header = {"fake__msg", "Fake", 1, 24, headed, NULL};
static const members_since_jazzy of_jazzy = {"fake__msg", "Fake", 1, 24, false, headed, NULL};
static const members_since_jazzy of_cpp = {"fake::msg", "Fake", 1, 24, true, headed_in_cpp, NULL};
static const members_of_humble of_headers = {"fake__msg", "Fake", 1, 24, many_headers, NULL};
static const members_of_humble of_string = {"fake__msg", "Fake", 1, 24, text, NULL};

// An image as each release describes it: a header, and bytes behind it; those of Lyrical are a rosidl::Buffer.
#define IMAGE(header, ...) \
  {.name_ = "header", .type_id_ = ROSIDL_TYPE_MESSAGE, .members_ = header}, \
  {.name_ = "data", .type_id_ = UINT8, .is_array_ = true, .offset_ = 24, __VA_ARGS__}

static const member_of_humble image_of_humble[] = {IMAGE(&header_in_c)};
static const member_of_jazzy image_of_jazzy[] = {IMAGE(&header_in_cpp)};
static const member_of_lyrical image_of_lyrical[] = {IMAGE(&header_in_cpp, .is_rosidl_buffer_ = true)};
static const member_of_lyrical buffer_of_lyrical[] = {
  {.name_ = "data", .type_id_ = UINT8, .is_array_ = true, .is_rosidl_buffer_ = true}};

static const members_of_humble humble_image = {"fake__msg", "Fake", 2, 48, image_of_humble, NULL};
static const members_since_jazzy jazzy_image = {"fake::msg", "Fake", 2, 48, false, image_of_jazzy, NULL};
static const members_since_jazzy lyrical_image = {"fake::msg", "Fake", 2, 64, false, image_of_lyrical, NULL};
static const members_since_jazzy lyrical_buffer = {"fake::msg", "Fake", 1, 40, false, buffer_of_lyrical, NULL};

static const callbacks_of_lyrical with_buffers = {
  .message_name_ = "Fake", .get_serialized_size = size, .has_buffer_fields = true};
static const rosidl_type_support_t fastrtps_of_lyrical = {"rosidl_typesupport_fastrtps", &with_buffers, NULL};

static const struct {
  const char * word;
  const void * members;
  bool cpp;
  bool lyrical;
} kinds[] = {
  {"header", &of_header, false, false},
  {"jazzy", &of_jazzy, false, false},
  {"cpp", &of_cpp, true, false},
  {"headers", &of_headers, false, false},
  {"string", &of_string, false, false},
  {"humble_image", &humble_image, false, false},
  {"jazzy_image", &jazzy_image, true, false},
  {"lyrical_image", &lyrical_image, true, true},
  {"lyrical_buffer", &lyrical_buffer, true, true},
};

enum { KINDS = sizeof(kinds) / sizeof(kinds[0]) };

static rosidl_type_support_t supports[KINDS];
static rosidl_type_support_t introspections[KINDS];

static const rosidl_type_support_t * support(const rosidl_type_support_t * of, const char * kind)
{
  const bool cpp = strstr(of->typesupport_identifier, "_cpp") != NULL;
  if (cpp == (strstr(kind, "_cpp") != NULL)) {
    if (strncmp(kind, "rosidl_typesupport_fastrtps", 27) == 0) {
      return kinds[of - supports].lyrical ? &fastrtps_of_lyrical : &fastrtps;
    }
    if (strncmp(kind, "rosidl_typesupport_introspection", 32) == 0) {
      return introspections + (of - supports);
    }
  }
  fake.errors++;
  return NULL;
}

static const rosidl_type_support_t * nothing(const rosidl_type_support_t * of, const char * kind)
{
  (void)of;
  (void)kind;
  fake.errors++;
  return NULL;
}

static const rosidl_type_support_t bare = {"rosidl_typesupport_c", NULL, nothing};

const void * fake_type(const char * word)
{
  for (int at = 0; at < KINDS; at++) {
    if (strcmp(word, kinds[at].word) == 0) {
      introspections[at] = (rosidl_type_support_t){"introspection", kinds[at].members, NULL};
      supports[at] = (rosidl_type_support_t){
        kinds[at].cpp ? "rosidl_typesupport_cpp" : "rosidl_typesupport_c", NULL, support};
      return supports + at;
    }
  }
  return strcmp(word, "bare") == 0 ? &bare : NULL;
}
