/* A system clock of one process's own, off by as many seconds as a file says, and what waits by it does so too. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <semaphore.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

#define SECOND 1000000000LL
#define LOOK 5000000LL /* ns between looks at the clock while waiting: how soon a jump is seen */
#define STEADY_CLOCK 2 /* of a condition variable, in glibc */

static volatile long *seconds;

__attribute__((constructor)) static void open_file(void)
{
    int file = open(getenv("SYSTEM_CLOCK_FILE"), O_RDONLY);
    seconds = mmap(NULL, sizeof *seconds, PROT_READ, MAP_SHARED, file, 0);
    close(file);
}

int clock_gettime(clockid_t clock, struct timespec *time)
{
    int status = syscall(SYS_clock_gettime, clock, time);
    if (status == 0 && clock == CLOCK_REALTIME)
        time->tv_sec += *seconds;
    return status;
}

int gettimeofday(struct timeval *time, void *zone)
{
    struct timespec now;
    (void)zone;
    clock_gettime(CLOCK_REALTIME, &now);
    time->tv_sec = now.tv_sec;
    time->tv_usec = now.tv_nsec / 1000;
    return 0;
}

time_t time(time_t *time)
{
    struct timespec now;
    clock_gettime(CLOCK_REALTIME, &now);
    if (time)
        *time = now.tv_sec;
    return now.tv_sec;
}

/* Time in ns until an instant of this clock, and the same instant, or the next look, by the machine's. */
static long long left_until(const struct timespec *until, struct timespec *look)
{
    struct timespec now;
    clock_gettime(CLOCK_REALTIME, &now);
    long long left = (until->tv_sec - now.tv_sec) * SECOND + until->tv_nsec - now.tv_nsec;
    syscall(SYS_clock_gettime, CLOCK_REALTIME, look);
    long long end = look->tv_sec * SECOND + look->tv_nsec + (left > LOOK ? LOOK : left > 0 ? left : 0);
    look->tv_sec = end / SECOND;
    look->tv_nsec = end % SECOND;
    return left;
}

int pthread_cond_timedwait(pthread_cond_t *condition, pthread_mutex_t *mutex, const struct timespec *until)
{
    static int (*wait)(pthread_cond_t *, pthread_mutex_t *, const struct timespec *);
    if (!wait)
        wait = dlvsym(RTLD_NEXT, "pthread_cond_timedwait", "GLIBC_2.3.2");
    if (condition->__data.__wrefs & STEADY_CLOCK)
        return wait(condition, mutex, until);
    for (;;) {
        struct timespec look;
        long long left = left_until(until, &look);
        int status = wait(condition, mutex, &look);
        if (status != ETIMEDOUT || left <= LOOK)
            return status;
    }
}

int sem_timedwait(sem_t *semaphore, const struct timespec *until)
{
    static int (*wait)(sem_t *, const struct timespec *);
    if (!wait)
        wait = dlsym(RTLD_NEXT, "sem_timedwait");
    for (;;) {
        struct timespec look;
        long long left = left_until(until, &look);
        if (wait(semaphore, &look) == 0)
            return 0;
        if (errno != ETIMEDOUT || left <= LOOK)
            return -1;
    }
}
