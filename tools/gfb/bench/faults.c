/* Preloaded: makes one operation on the files of a folder fail. GFB_FAULT_FOLDER: the folder. GFB_FAULT_AT: number of the
   operation, from 1. GFB_FAULT_KIND: once (it fails), full (so do all that need room from then on), kill (the process
   ends there; then removals count, too). GFB_FAULT_LINKS=none: the file system has no links. The number of operations is
   written to GFB_FAULT_COUNT where that is a file's name. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/types.h>
#include <unistd.h>

static int count = 0;

/* Said at once: mpiexec may kill a process that has failed before its end is orderly. */
static void tell(void)
{
  const char *name = getenv("GFB_FAULT_COUNT");
  FILE       *file = name ? fopen(name, "w") : NULL;

  if (!file) return;
  fprintf(file, "%d\n", count);
  fclose(file);
}

static int fails(int needs_room)
{
  const char *at = getenv("GFB_FAULT_AT"), *kind = getenv("GFB_FAULT_KIND");

  count++;
  tell();
  if (!at || !kind || count < atoi(at)) return 0;
  if (count == atoi(at) && strcmp(kind, "kill") == 0) kill(getpid(), SIGKILL);
  return count == atoi(at) || (needs_room && strcmp(kind, "full") == 0);
}

static int is_inside(const char *path)
{
  const char *folder = getenv("GFB_FAULT_FOLDER");

  return folder && path && strncmp(path, folder, strlen(folder)) == 0;
}

static int is_of_folder(int file)
{
  char    link[64], path[4096];
  ssize_t length;

  snprintf(link, sizeof link, "/proc/self/fd/%d", file);
  length = readlink(link, path, sizeof path - 1);
  if (length < 0) return 0;
  path[length] = 0;
  return is_inside(path);
}

#define NEXT(type, name, ...) \
  static type (*next)(__VA_ARGS__) = NULL; \
  if (!next) next = (type (*)(__VA_ARGS__))dlsym(RTLD_NEXT, name)

ssize_t write(int file, const void *bytes, size_t length)
{
  NEXT(ssize_t, "write", int, const void *, size_t);
  if (is_of_folder(file) && fails(1)) {
    if (length > 1 && next(file, bytes, length/2) < 0) return -1; /* a part still finds room */
    errno = ENOSPC;
    return -1;
  }
  return next(file, bytes, length);
}

int fsync(int file)
{
  NEXT(int, "fsync", int);
  if (is_of_folder(file) && fails(0)) {
    errno = EIO;
    return -1;
  }
  return next(file);
}

int open(const char *path, int flags, ...)
{
  mode_t  mode = 0;
  va_list more;
  NEXT(int, "open", const char *, int, ...);

  if (flags & O_CREAT) {
    va_start(more, flags);
    mode = va_arg(more, mode_t);
    va_end(more);
    if (is_inside(path) && fails(1)) {
      errno = ENOSPC;
      return -1;
    }
  }
  return next(path, flags, mode);
}

int openat(int folder, const char *name, int flags, ...)
{
  mode_t  mode = 0;
  va_list more;
  NEXT(int, "openat", int, const char *, int, ...);

  if (flags & O_CREAT) {
    va_start(more, flags);
    mode = va_arg(more, mode_t);
    va_end(more);
    if (is_of_folder(folder) && fails(1)) {
      errno = ENOSPC;
      return -1;
    }
  }
  return next(folder, name, flags, mode);
}

int renameat(int from, const char *old, int to, const char *new)
{
  NEXT(int, "renameat", int, const char *, int, const char *);
  if (is_of_folder(from) && fails(0)) {
    errno = EIO;
    return -1;
  }
  return next(from, old, to, new);
}

int linkat(int from, const char *old, int to, const char *new, int flags)
{
  const char *links = getenv("GFB_FAULT_LINKS");
  NEXT(int, "linkat", int, const char *, int, const char *, int);

  if (is_of_folder(from) && fails(1)) {
    errno = ENOSPC;
    return -1;
  }
  if (is_of_folder(from) && links && strcmp(links, "none") == 0) {
    errno = EPERM;
    return -1;
  }
  return next(from, old, to, new, flags);
}

static int counts_removals(void)
{
  const char *kind = getenv("GFB_FAULT_KIND");

  return kind && strcmp(kind, "kill") == 0;
}

int unlink(const char *path)
{
  NEXT(int, "unlink", const char *);

  if (is_inside(path) && counts_removals()) fails(0);
  return next(path);
}

int unlinkat(int folder, const char *name, int flags)
{
  NEXT(int, "unlinkat", int, const char *, int);

  if (is_of_folder(folder) && counts_removals()) fails(0);
  return next(folder, name, flags);
}
