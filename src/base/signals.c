/* Signals that ask the program to stop. A handler may do little: it notes the signal, and the program looks at the
   note where it can stop. Where it does not come to look, as a library does not return, a clock ends it. */
#include <signal.h>
#include <time.h>
#include <unistd.h>

static volatile sig_atomic_t received = 0; /* the signal that asked first, 0 for none */
static volatile sig_atomic_t agreed   = 0; /* the one because of which all ranks stop */
static struct timespec       when;         /* it was received */
static volatile sig_atomic_t awaited = 0;  /* the clock runs */
static volatile sig_atomic_t held    = 0;  /* no clock: results are being written */
static volatile sig_atomic_t patience = 10; /* until it ends the program [s]: this, or more where looks lie far apart */
static struct timespec       last_look;    /* of the program at the note; zero before the first */
static const double          many_times = 3.0; /* the longest time from look to look */

/* The signals of one request, such as timeout(1)'s two, come within this time [s]. */
static const double one_request = 0.5;

static double seconds_between(const struct timespec *from, const struct timespec *to)
{
  return (double)(to->tv_sec - from->tv_sec) + 1e-9*(double)(to->tv_nsec - from->tv_nsec);
}

static void end_waiting(void)
{
  static const char words[] = "gfb: asked to stop by a signal, but what is under way does not come to an end: stopped in the "
                              "middle of it; older results and the restart file are as they were\n";

  (void)!write(STDERR_FILENO, words, sizeof words - 1);
  _exit(128 + received);
}

/* The time limit, which has the same clock, has no use any more. */
static void start_waiting(int signal_number)
{
  if (agreed || held || (signal_number != SIGTERM && signal_number != SIGINT && signal_number != SIGHUP)) return;
  awaited = 1;
  alarm((unsigned)patience);
}

static void stop_waiting(void)
{
  if (!awaited) return;
  awaited = 0;
  alarm(0);
}

static void note_signal(int signal_number)
{
  struct timespec now;

  if (signal_number == SIGALRM && awaited) end_waiting();
  clock_gettime(CLOCK_MONOTONIC, &now);
  if (!received) {
    when     = now;
    received = signal_number;
    start_waiting(signal_number);
  } else if (signal_number != SIGALRM && received != SIGALRM &&
             seconds_between(&when, &now) > one_request) {
    signal(signal_number, SIG_DFL);
    raise(signal_number);
  } else if (received == SIGALRM && signal_number != SIGALRM) {
    when     = now;
    received = signal_number;
    start_waiting(signal_number);
  }
}

void gfb_catch_signals(void)
{
  const int        asking[] = {SIGINT, SIGTERM, SIGHUP, SIGXCPU, SIGUSR1, SIGALRM};
  struct sigaction action, before;

  sigemptyset(&action.sa_mask);
  action.sa_handler = note_signal;
  action.sa_flags   = SA_RESTART;
  for (unsigned i = 0; i < sizeof asking/sizeof *asking; i++) {
    if (sigaction(asking[i], NULL, &before) == 0 && before.sa_handler == SIG_IGN) continue; /* as nohup asks */
    sigaction(asking[i], &action, NULL);
  }
  signal(SIGPIPE, SIG_DFL); /* nobody reads on: a quiet end */
  signal(SIGXFSZ, SIG_IGN); /* a file that may not grow is a write that fails */
}

void gfb_limit_time(int seconds)
{
  alarm((unsigned)seconds);
}

int gfb_received_signal(void)
{
  struct timespec now;

  clock_gettime(CLOCK_MONOTONIC, &now);
  if (last_look.tv_sec || last_look.tv_nsec) {
    double time = many_times*seconds_between(&last_look, &now);
    if (time > patience) patience = time < 1e6 ? (int)time : 1000000;
  }
  last_look = now;
  return received;
}

int gfb_agreed_signal(void)
{
  return agreed;
}

void gfb_agree_on_signal(int signal_number)
{
  agreed = signal_number;
  if (agreed) stop_waiting();
}

void gfb_hold_clock(int on)
{
  held = on;
  if (held) stop_waiting();
}
