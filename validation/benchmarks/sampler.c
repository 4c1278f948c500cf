/* Where a process spends its processor time: the address that runs, at every tick of its own CPU clock.
 *
 * ITIMER_PROF counts the time of all threads; its signal goes to the thread that used up the tick. The handler does
 * nothing but store one number, so it may interrupt anything. */
#define _GNU_SOURCE
#include <signal.h>
#include <stdint.h>
#include <sys/time.h>
#include <ucontext.h>

static uint64_t *places;
static long room, count;

static void store(int signal, siginfo_t *info, void *context)
{
    (void)signal;
    (void)info;
    long k = __atomic_fetch_add(&count, 1, __ATOMIC_RELAXED);
    if (k >= room) {
        return;
    }
    const mcontext_t *machine = &((const ucontext_t *)context)->uc_mcontext;
#if defined(__x86_64__)
    places[k] = (uint64_t)machine->gregs[REG_RIP];
#elif defined(__aarch64__)
    places[k] = (uint64_t)machine->pc;
#else
#error "no program counter known for this processor"
#endif
}

static int every(long microseconds)
{
    struct timeval tick = {microseconds / 1000000, microseconds % 1000000};
    struct itimerval timer = {tick, tick};
    return setitimer(ITIMER_PROF, &timer, 0);
}

/* Begin to fill `buffer` (size addresses); 0 where that works. */
int sampler_start(uint64_t *buffer, long size, long microseconds)
{
    struct sigaction action = {0};
    places = buffer;
    room = size;
    count = 0;
    action.sa_sigaction = store;
    action.sa_flags = SA_SIGINFO | SA_RESTART;
    sigemptyset(&action.sa_mask);
    if (sigaction(SIGPROF, &action, 0) != 0) {
        return 1;
    }
    return every(microseconds);
}

/* How many were stored. */
long sampler_stop(void)
{
    every(0);
    return count < room ? count : room;
}
