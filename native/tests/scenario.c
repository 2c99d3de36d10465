// Plays the client library: does what the lines on standard input say, and answers each with one line.
//
// The message given with each take and the time given by the program around are what a test knows beforehand, so it can
// say what must be counted.

#include "fake_rmw.h"
#include "fake_type.h"

#include <dlfcn.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#define FUNCTION(result, name, parameters) extern result rmw_##name parameters;
#include "../real_rmw.h"
WRAPPED_FUNCTIONS(FUNCTION)

enum { MOST_HANDLES = 4096 };

static struct {
  const char * kind;
  void * handle;
} entities[MOST_HANDLES];
static int count;

static const char * const KINDS[] = {"publisher", "subscription", "client", "service"};

static fake_message in_flight;

static void * create(const char * kind, const rmw_node_t * node, const char * name, const char * how)
{
  const bool filtered = strcmp(how, "filtered") == 0;
  if (strcmp(kind, "publisher") == 0) {
    return rmw_create_publisher(node, fake_type(how), name, NULL, NULL);
  }
  if (strcmp(kind, "subscription") == 0) {
    const rmw_subscription_options_t options = {.content_filter_options = filtered ? "x > 1" : NULL};
    return rmw_create_subscription(node, fake_type(how), name, NULL, &options);
  }
  if (strcmp(kind, "client") == 0) {
    return rmw_create_client(node, NULL, name, NULL);
  }
  return rmw_create_service(node, NULL, name, NULL);
}

static rmw_ret_t destroy(const char * kind, void * handle)
{
  if (strcmp(kind, "publisher") == 0) {
    return rmw_destroy_publisher(NULL, handle);
  }
  if (strcmp(kind, "subscription") == 0) {
    return rmw_destroy_subscription(NULL, handle);
  }
  return strcmp(kind, "client") == 0 ? rmw_destroy_client(NULL, handle) : rmw_destroy_service(NULL, handle);
}

static rmw_ret_t publish(const void * publisher, const char * how)
{
  rmw_serialized_message_t bytes = {NULL, fake.size};
  if (strcmp(how, "serialized") == 0) {
    return rmw_publish_serialized_message(publisher, &bytes, NULL);
  }
  return strcmp(how, "loaned") == 0 ? rmw_publish_loaned_message(publisher, &in_flight, NULL)
                                    : rmw_publish(publisher, &in_flight, NULL);
}

static rmw_ret_t take_sequence(const void * subscription, bool * taken)
{
  static uint8_t memory[4 * HUMBLE_INFO_BYTES];
  rmw_message_info_sequence_t infos = {(rmw_message_info_t *)(void *)memory, 0};
  size_t got = 0;
  const rmw_ret_t result = rmw_take_sequence(subscription, 4, NULL, &infos, &got, NULL);
  *taken = got == 4;
  return result;
}

static rmw_ret_t take(const void * subscription, const char * how, bool * taken)
{
  union {
    rmw_message_info_t read;
    uint8_t all[HUMBLE_INFO_BYTES];
  } info;
  rmw_serialized_message_t bytes = {NULL, 0};
  void * loan = &in_flight;
  in_flight = (fake_message){fake.stamp, 250};
  if (strcmp(how, "info") == 0) {
    return rmw_take_with_info(subscription, &in_flight, taken, &info.read, NULL);
  }
  if (strcmp(how, "serialized") == 0) {
    return rmw_take_serialized_message(subscription, &bytes, taken, NULL);
  }
  if (strcmp(how, "serialized_info") == 0) {
    return rmw_take_serialized_message_with_info(subscription, &bytes, taken, &info.read, NULL);
  }
  if (strcmp(how, "loaned") == 0) {
    return rmw_take_loaned_message(subscription, &loan, taken, NULL);
  }
  if (strcmp(how, "loaned_info") == 0) {
    return rmw_take_loaned_message_with_info(subscription, &loan, taken, &info.read, NULL);
  }
  return strcmp(how, "sequence") == 0 ? take_sequence(subscription, taken) : rmw_take(subscription, &in_flight, taken, NULL);
}

static rmw_ret_t serve(void * handle, const char * how, bool * taken)
{
  rmw_service_info_t info;
  int64_t number = 0;
  *taken = true;
  if (strcmp(how, "request") == 0) {
    return rmw_send_request(handle, NULL, &number);
  }
  if (strcmp(how, "response") == 0) {
    return rmw_take_response(handle, &info, NULL, taken);
  }
  return strcmp(how, "ask") == 0 ? rmw_take_request(handle, &info, NULL, taken)
                                 : rmw_send_response(handle, &fake.call, NULL);
}

typedef struct {
  void * publisher;
  void * subscription;
  int messages;
} work;

static void * labour(void * given)
{
  const work * const todo = given;
  bool taken;
  for (int at = 0; at < todo->messages; at++) {
    publish(todo->publisher, "typed");
    take(todo->subscription, "info", &taken);
  }
  return NULL;
}

static void * churn(void * given)
{
  const work * const todo = given;
  const rmw_node_t node = {NULL, NULL, "churn", "/"};
  for (int at = 0; at < todo->messages / 10; at++) {
    void * const handle = rmw_create_publisher(&node, NULL, at % 2 ? "/odd" : "/even", NULL, NULL);
    if (at % 100 == 0) {
      publish(handle, "typed");
    }
    rmw_destroy_publisher(NULL, handle);
  }
  return NULL;
}

static void threads(int number, work todo)
{
  pthread_t running[64];
  for (int at = 0; at < number; at++) {
    pthread_create(running + at, NULL, at == 0 ? churn : labour, &todo);
  }
  for (int at = 0; at < number; at++) {
    pthread_join(running[at], NULL);
  }
}

static int fork_and_publish(void * publisher)
{
  const pid_t child = fork();
  if (child == 0) {
    publish(publisher, "typed");
    exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return status;
}

static void read_bytes(uint8_t * into, size_t most, const char * hexadecimal)
{
  memset(into, 0, most);
  for (size_t at = 0; at < most && strlen(hexadecimal) >= 2 * (at + 1); at++) {
    unsigned value;
    sscanf(hexadecimal + 2 * at, "%2x", &value);
    into[at] = (uint8_t)value;
  }
}

// Call a function of the library as the hook in Python does.
static int tell_library(const char * name)
{
  void (*call)(void) = NULL;
  void * const found = dlsym(RTLD_DEFAULT, name);
  memcpy(&call, &found, sizeof(found));
  if (call != NULL) {
    call();
  }
  return call == NULL;
}

static void set(const char * what, long value)
{
  if (strcmp(what, "fail") == 0) {
    fake.fail = value;
  } else if (strcmp(what, "empty") == 0) {
    fake.empty = value;
  } else if (strcmp(what, "nested") == 0) {
    fake.nested = value;
  } else if (strcmp(what, "foreign") == 0) {
    fake.foreign = value;
  } else if (strcmp(what, "stamp") == 0) {
    fake.stamp = (int32_t)value;
  } else if (strcmp(what, "size") == 0) {
    fake.size = (size_t)value;
  }
}

__attribute__((visibility("default"))) int scenario(void (*set_time)(int64_t));

__attribute__((visibility("default"))) int scenario(void (*set_time)(int64_t))
{
  char line[2048];
  while (fgets(line, sizeof(line), stdin) != NULL) {
    char verb[32] = "";
    char one[1024] = "";
    char two[512] = "";
    char three[512] = "";
    char four[64] = "";
    sscanf(line, "%31s %1023s %511s %511s %63s", verb, one, two, three, four);
    const int id = atoi(one);
    long answer = 0;
    for (int at = 0; at < 4; at++) {
      if (strcmp(verb, KINDS[at]) == 0) {
        const rmw_node_t node = {NULL, NULL, three, two};
        void * const handle = create(KINDS[at], &node, one, four);
        answer = handle != NULL ? count : -1;
        entities[count].kind = KINDS[at];
        entities[count++].handle = handle;
      }
    }
    bool taken = false;
    if (strcmp(verb, "destroy") == 0) {
      answer = destroy(entities[id].kind, entities[id].handle);
    } else if (strcmp(verb, "message") == 0) {
      fake.source = strtoll(one, NULL, 10);
      fake.received = strtoll(two, NULL, 10);
      fake.number = strtoull(three, NULL, 10);
      read_bytes(fake.gid, sizeof(fake.gid), four);
    } else if (strcmp(verb, "call") == 0) {
      fake.call.sequence_number = strtoll(one, NULL, 10);
      read_bytes(fake.call.writer_guid, sizeof(fake.call.writer_guid), two);
    } else if (strcmp(verb, "set") == 0) {
      set(one, atol(two));
    } else if (strcmp(verb, "time") == 0) {
      set_time(strtoll(one, NULL, 10));
    } else if (strcmp(verb, "publish") == 0) {
      answer = publish(entities[id].handle, two);
    } else if (strcmp(verb, "take") == 0) {
      answer = take(entities[id].handle, two, &taken) * 10 + taken;
    } else if (strcmp(verb, "serve") == 0) {
      answer = serve(entities[id].handle, two, &taken) * 10 + taken;
    } else if (strcmp(verb, "environment") == 0) {
      char value[128];
      snprintf(value, sizeof(value), "%.20s %.50s %.50s", two, three, four);
      answer = two[0] != '\0' ? setenv(one, value, 1) : unsetenv(one);
    } else if (strcmp(verb, "threads") == 0) {
      threads(id, (work){entities[atoi(two)].handle, entities[atoi(three)].handle, atoi(four)});
    } else if (strcmp(verb, "library") == 0) {
      answer = tell_library(one);
    } else if (strcmp(verb, "asked") == 0) {
      answer = fake.asked * 10 + fake.errors;
    } else if (strcmp(verb, "filter") == 0) {
      answer = rmw_subscription_set_content_filter(entities[id].handle, NULL);
    } else if (strcmp(verb, "fork") == 0) {
      answer = fork_and_publish(entities[id].handle);
    } else if (strcmp(verb, "exit") == 0) {
      break;
    }
    printf("%ld\n", answer);
    fflush(stdout);
  }
  return 0;
}
