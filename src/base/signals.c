/* Signals that ask the program to stop. A handler may do little: it notes the signal, and the program looks at the
   note where it can stop. */
#include <signal.h>
#include <time.h>
#include <unistd.h>

static volatile sig_atomic_t received = 0; /* the signal that asked first, 0 for none */
static volatile sig_atomic_t agreed   = 0; /* the one because of which all ranks stop */
static struct timespec       when;         /* it was received */

/* The signals of one request, such as timeout(1)'s two, come within this time [s]. */
static const double one_request = 0.5;

static void note_signal(int signal_number)
{
  struct timespec now;

  clock_gettime(CLOCK_MONOTONIC, &now);
  if (!received) {
    when     = now;
    received = signal_number;
  } else if (signal_number != SIGALRM && received != SIGALRM &&
             (double)(now.tv_sec - when.tv_sec) + 1e-9*(double)(now.tv_nsec - when.tv_nsec) > one_request) {
    signal(signal_number, SIG_DFL);
    raise(signal_number);
  } else if (received == SIGALRM && signal_number != SIGALRM) {
    when     = now;
    received = signal_number;
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
  return received;
}

int gfb_agreed_signal(void)
{
  return agreed;
}

void gfb_agree_on_signal(int signal_number)
{
  agreed = signal_number;
}
