/* Preloaded, it sets the wall clock of a process ahead by the seconds that stand in $WALL_CLOCK_AHEAD (a file, one double).

   What waits until a time of the wall clock waits for the kernel's, which stays as it is: such times are set back. */

#define _GNU_SOURCE
#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <semaphore.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

/* Times above are of the wall clock, those below of one that began with the machine. */
#define WALL 1000000000

static const volatile double *ahead;

__attribute__((constructor)) static void find(void)
{
  const char *path = getenv("WALL_CLOCK_AHEAD");
  int file = path ? open(path, O_RDONLY | O_CLOEXEC) : -1;
  if (file < 0)
    return;
  void *page = mmap(NULL, sizeof(double), PROT_READ, MAP_SHARED, file, 0);
  if (page != MAP_FAILED)
    ahead = page;
  close(file);
}

static struct timespec until(const struct timespec *wanted)
{
  struct timespec kernels = *wanted;
  if (ahead && kernels.tv_sec > WALL)
    kernels.tv_sec -= (time_t)*ahead;
  return kernels;
}

int clock_gettime(clockid_t clock, struct timespec *time)
{
  static int (*next)(clockid_t, struct timespec *);
  if (!next)
    next = (int (*)(clockid_t, struct timespec *))dlsym(RTLD_NEXT, "clock_gettime");
  int failed = next(clock, time);
  if (!failed && clock == CLOCK_REALTIME && ahead)
    time->tv_sec += (time_t)*ahead;
  return failed;
}

int gettimeofday(struct timeval *restrict time, void *restrict zone)
{
  struct timespec now;
  (void)zone;
  int failed = clock_gettime(CLOCK_REALTIME, &now);
  time->tv_sec = now.tv_sec;
  time->tv_usec = now.tv_nsec / 1000;
  return failed;
}

time_t time(time_t *into)
{
  struct timespec now;
  clock_gettime(CLOCK_REALTIME, &now);
  if (into)
    *into = now.tv_sec;
  return now.tv_sec;
}

int pthread_cond_timedwait(pthread_cond_t *condition, pthread_mutex_t *mutex, const struct timespec *wanted)
{
  static int (*next)(pthread_cond_t *, pthread_mutex_t *, const struct timespec *);
  /* The oldest of its versions, which is found without one, knows conditions of another layout. */
  if (!next)
    next = (int (*)(pthread_cond_t *, pthread_mutex_t *, const struct timespec *))
      dlvsym(RTLD_NEXT, "pthread_cond_timedwait", "GLIBC_2.3.2");
  if (!next)
    next = (int (*)(pthread_cond_t *, pthread_mutex_t *, const struct timespec *))
      dlsym(RTLD_NEXT, "pthread_cond_timedwait");
  struct timespec kernels = until(wanted);
  return next(condition, mutex, &kernels);
}

int pthread_cond_clockwait(pthread_cond_t *condition, pthread_mutex_t *mutex, clockid_t clock,
                           const struct timespec *wanted)
{
  static int (*next)(pthread_cond_t *, pthread_mutex_t *, clockid_t, const struct timespec *);
  if (!next)
    next = (int (*)(pthread_cond_t *, pthread_mutex_t *, clockid_t, const struct timespec *))
      dlsym(RTLD_NEXT, "pthread_cond_clockwait");
  struct timespec kernels = until(wanted);
  return next(condition, mutex, clock, &kernels);
}

int sem_timedwait(sem_t *restrict semaphore, const struct timespec *restrict wanted)
{
  static int (*next)(sem_t *, const struct timespec *);
  if (!next)
    next = (int (*)(sem_t *, const struct timespec *))dlsym(RTLD_NEXT, "sem_timedwait");
  struct timespec kernels = until(wanted);
  return next(semaphore, &kernels);
}
