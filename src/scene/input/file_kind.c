#include <sys/stat.h>

/* Whether a path leads to something that is neither a file with bytes of its own nor a folder: a pipe, a terminal. */
int gfb_is_no_file(const char *path)
{
  struct stat about;

  return stat(path, &about) == 0 && !S_ISREG(about.st_mode) && !S_ISDIR(about.st_mode);
}
