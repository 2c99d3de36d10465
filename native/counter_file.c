#include "counter_file.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

enum { FILE_BYTES = HEADER_BYTES + CAPACITY * SLOT_BYTES };

atomic_bool counter_file_open;

static struct {
  int handle;
  pid_t owner;
  char path[PATH_MAX];
  file_header * header;
} file = {.handle = -1};

static pthread_once_t once = PTHREAD_ONCE_INIT;

static bool make_folder(char * path)
{
  for (char * at = path + 1; *at != '\0'; at++) {
    if (*at == '/') {
      *at = '\0';
      const int made = mkdir(path, 0700);
      *at = '/';
      if (made != 0 && errno != EEXIST) {
        return false;
      }
    }
  }
  struct stat found;
  if ((mkdir(path, 0700) != 0 && errno != EEXIST) || lstat(path, &found) != 0) {
    return false;
  }
  if (!S_ISDIR(found.st_mode) || found.st_uid != getuid()) {
    errno = S_ISDIR(found.st_mode) ? EPERM : ENOTDIR;
    return false;
  }
  return true;
}

static void fill_header(file_header * header)
{
  struct timespec now;
  clock_gettime(CLOCK_REALTIME, &now);
  memcpy(header->magic, LAYOUT_MAGIC, sizeof(header->magic));
  header->version = LAYOUT_VERSION;
  header->slot_bytes = SLOT_BYTES;
  header->capacity = CAPACITY;
  header->pid = (uint64_t)getpid();
  header->started = (int64_t)now.tv_sec * 1000000000 + now.tv_nsec;
  gethostname(header->host, HOST_BYTES - 1);
}

// Make the file under a hidden name and give it its own when it can be read.
static bool make_file(const char * folder)
{
  char hidden[PATH_MAX];
  if (snprintf(hidden, sizeof(hidden), "%s/.XXXXXX", folder) + 32 >= (int)sizeof(hidden)) {
    errno = ENAMETOOLONG;
    return false;
  }
  file.handle = mkostemp(hidden, O_CLOEXEC);
  if (file.handle < 0) {
    return false;
  }
  // Memory that is promised but not there would kill the node when it is written.
  if (
    flock(file.handle, LOCK_EX | LOCK_NB) == 0 && ftruncate(file.handle, FILE_BYTES) == 0 &&
    fallocate(file.handle, 0, 0, HEADER_BYTES) == 0) {
    void * const memory = mmap(NULL, FILE_BYTES, PROT_READ | PROT_WRITE, MAP_SHARED, file.handle, 0);
    if (memory != MAP_FAILED) {
      file.header = memory;
      fill_header(file.header);
      const char * const name = strrchr(hidden, '/') + 2;
      const int length =
        snprintf(file.path, sizeof(file.path), "%s/%ld-%s" LAYOUT_SUFFIX, folder, (long)getpid(), name);
      if (length < (int)sizeof(file.path) && rename(hidden, file.path) == 0) {
        return true;
      }
      munmap(memory, FILE_BYTES);
    }
  }
  const int error = errno;
  unlink(hidden);
  close(file.handle);
  file.handle = -1;
  errno = error;
  return false;
}

static void leave_to_parent(void)
{
  atomic_store(&counter_file_open, false);
  if (file.handle >= 0) {
    close(file.handle);
    file.handle = -1;
  }
}

static void open_once(void)
{
  char folder[PATH_MAX - 64];
  const char * const named = getenv(FOLDER_VARIABLE);
  const int length = named != NULL && *named != '\0'
                       ? snprintf(folder, sizeof(folder), "%s", named)
                       : snprintf(folder, sizeof(folder), "/dev/shm/roslens-%ld", (long)getuid());
  if (length >= (int)sizeof(folder)) {
    errno = ENAMETOOLONG;
  } else if (make_folder(folder) && make_file(folder)) {
    file.owner = getpid();
    pthread_atfork(NULL, NULL, leave_to_parent);
    atomic_store(&counter_file_open, true);
    return;
  }
  fprintf(stderr, "roslens: the traffic of this process is not counted: %s: %s\n", folder, strerror(errno));
}

void open_counter_file(void)
{
  pthread_once(&once, open_once);
}

void say(const char * state)
{
  snprintf(file.header->state, STATE_BYTES, "%s", state);
}

slot_word * fresh_slot(void)
{
  const uint32_t used = file.header->used;
  if (used == CAPACITY) {
    return NULL;
  }
  const off_t at = HEADER_BYTES + (off_t)used * SLOT_BYTES;
  if (fallocate(file.handle, 0, at, SLOT_BYTES) != 0) {
    return NULL;
  }
  return (slot_word *)((char *)file.header + at);
}

void show_slot(void)
{
  atomic_fetch_add_explicit((_Atomic uint32_t *)&file.header->used, 1, memory_order_release);
}

void count_overflow(void)
{
  atomic_fetch_add_explicit((_Atomic uint64_t *)&file.header->overflow, 1, memory_order_relaxed);
}

// What is mapped stays so: other threads may publish until the last instant.
__attribute__((destructor)) static void take_away(void)
{
  if (atomic_load(&counter_file_open) && file.owner == getpid()) {
    unlink(file.path);
  }
}
