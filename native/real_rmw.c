#include "real_rmw.h"

#include <dlfcn.h>
#include <link.h>
#include <pthread.h>
#include <string.h>

real_functions real_rmw;
atomic_bool real_rmw_found;

static pthread_mutex_t finding = PTHREAD_MUTEX_INITIALIZER;

enum { MOST_CANDIDATES = 8, PATH_BYTES = 1024 };

typedef struct {
  int count;
  char path[MOST_CANDIDATES][PATH_BYTES];
} candidates;

static int is_candidate(struct dl_phdr_info * info, size_t size, void * found)
{
  (void)size;
  candidates * const into = found;
  const char * const slash = strrchr(info->dlpi_name, '/');
  const char * const file = slash != NULL ? slash + 1 : info->dlpi_name;
  if (strncmp(file, "librmw", 6) == 0 && strlen(info->dlpi_name) < PATH_BYTES && into->count < MOST_CANDIDATES) {
    strcpy(into->path[into->count++], info->dlpi_name);
  }
  return 0;
}

// Return a handle of a library that is loaded already if it, or what it needs, has the interface.
static void * loaded_with_interface(const char * path)
{
  void * const handle = dlopen(path, RTLD_LAZY | RTLD_NOLOAD);
  if (handle == NULL) {
    return NULL;
  }
  void * const function = dlsym(handle, "rmw_publish");
  return function != NULL && function != dlsym(RTLD_DEFAULT, "rmw_publish") ? handle : NULL;
}

static void * where_to_look(const void * caller)
{
  // In a program of C++ the middleware is among the libraries behind this one. Python loads it for its extension module
  // alone: there it is what that module's libraries would find, or in the worst case what has the right name.
  if (dlsym(RTLD_NEXT, "rmw_publish") != NULL) {
    return RTLD_NEXT;
  }
  Dl_info from;
  void * handle = NULL;
  if (dladdr(caller, &from) != 0 && from.dli_fname != NULL) {
    handle = loaded_with_interface(from.dli_fname);
  }
  if (handle == NULL) {
    static candidates found;
    dl_iterate_phdr(is_candidate, &found);
    for (int at = 0; at < found.count && handle == NULL; at++) {
      handle = loaded_with_interface(found.path[at]);
    }
  }
  return handle;
}

// Copying is how POSIX has a data pointer become one to a function.
static void find(void * where, const char * name, void * function)
{
  void * const found = dlsym(where, name);
  memcpy(function, &found, sizeof(found));
}

void find_real_rmw(const void * caller)
{
  pthread_mutex_lock(&finding);
  if (!atomic_load(&real_rmw_found)) {
    void * const where = where_to_look(caller);
    if (where != NULL) {
#define FIND(result, name, parameters) find(where, "rmw_" #name, &real_rmw.name);
      WRAPPED_FUNCTIONS(FIND)
#undef FIND
      const char * (*identifier)(void) = NULL;
      bool (*supports)(int) = NULL;
      void * later = dlsym(where, "rmw_get_gid_for_client");
      find(where, "rmw_get_implementation_identifier", &identifier);
      find(where, "rmw_feature_supported", &supports);
      find(where, "rmw_get_gid_for_publisher", &real_rmw.get_gid_for_publisher);
      find(where, "rcutils_reset_error", &real_rmw.reset_error);
      real_rmw.gid_bytes = later != NULL ? LATER_GID_BYTES : HUMBLE_GID_BYTES;
      real_rmw.info_bytes = later != NULL ? LATER_INFO_BYTES : HUMBLE_INFO_BYTES;
      // Both came with Humble, and so did the layout of the message information.
      real_rmw.supported = identifier != NULL && supports != NULL;
      if (real_rmw.supported) {
        real_rmw.implementation_identifier = identifier();
        real_rmw.numbers = supports(FEATURE_PUBLICATION_SEQUENCE_NUMBER);
      }
      atomic_store_explicit(&real_rmw_found, true, memory_order_release);
    }
  }
  pthread_mutex_unlock(&finding);
}
