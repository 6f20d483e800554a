/* Files that become visible together: written under names of their own that no link can stand under, synced, and then
   renamed. What is unfinished stays locked by its owner, so that who finds one of a dead owner may take it away, or
   finish the renaming that the owner had begun.

   Whatever stands in a folder may be somebody else's doing. So all names are bare ones of one folder, which is opened
   once; nothing is followed or waited for; and a list is obeyed where this user alone can have written it and all that
   it names are files of the present case. All functions give 0, what errno was, or a number below 0. */
#define _GNU_SOURCE
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#ifndef O_PATH
#define O_PATH O_RDONLY
#endif

static const char unfinished[] = ".gfb-file-"; /* what names of unfinished files begin with */
static const char journal[]    = ".gfb-set-";  /* the same of lists of files that are being renamed */
static const char journal_end[] = "all";       /* what a whole list ends with */
static const char backup_end[] = ".old";
static const char seal_form[]  = "gfb crc32 %08x %016llx\n";
static const char *const result_ends[] = {".h5", ".csv", ".used.nml", ".summary", ".vtkhdf"};

enum { seal_length = 36, most_tries = 10000, piece = 1 << 20, longest_list = 1 << 20 };

/* The folder, for bare names in it; below 0 where it cannot be opened. */
static int open_folder(const char *path)
{
  return open(path, O_PATH | O_DIRECTORY | O_CLOEXEC);
}

/* --- checksum: CRC-32 of zlib and PNG --- */

static uint32_t crc_of(uint32_t crc, const unsigned char *bytes, size_t length)
{
  static uint32_t table[256];

  if (!table[1]) {
    for (uint32_t i = 0; i < 256; i++) {
      uint32_t c = i;
      for (int k = 0; k < 8; k++) c = c & 1 ? 0xedb88320u ^ (c >> 1) : c >> 1;
      table[i] = c;
    }
  }
  crc = ~crc;
  for (size_t i = 0; i < length; i++) crc = table[(crc ^ bytes[i]) & 0xff] ^ (crc >> 8);
  return ~crc;
}

/* Whether a file can be held in memory, as one that gfb has written was. */
static int fits_memory(long long bytes)
{
  long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);

  return pages <= 0 || page <= 0 || bytes/page < pages;
}

/* The end of a sealed file, with the length before it; what its checksum is to be compared with. */
static int read_seal(int file, long long size, char found[seal_length + 1])
{
  char wanted[seal_length + 1];

  if (size < seal_length) return -1;
  if (pread(file, found, seal_length, (off_t)(size - seal_length)) != seal_length || memcmp(found, seal_form, 10) != 0) return -1;
  snprintf(wanted, sizeof wanted, seal_form, 0u, (unsigned long long)(size - seal_length));
  if (memcmp(found + 18, wanted + 18, seal_length - 18) != 0) return -2;
  return fits_memory(size) ? 0 : EFBIG;
}

/* 0: what stands in the file is what was written; -1: it ends without checksum; -2: something has changed. What says at its end
   that it is no such file is not read. */
int gfb_check_seal(const char *path)
{
  unsigned char *bytes;
  char           found[seal_length + 1] = "", wanted[seal_length + 1];
  struct stat    about;
  uint32_t       crc  = 0;
  int            file = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK), status = 0;
  long long      left;
  ssize_t        got;

  if (file < 0) return errno;
  if (fstat(file, &about) != 0) status = errno;
  else if (!S_ISREG(about.st_mode)) status = S_ISDIR(about.st_mode) ? EISDIR : EINVAL;
  else status = read_seal(file, about.st_size, found);
  if (status == 0 && !(bytes = malloc(piece))) status = ENOMEM;
  if (status != 0) {
    close(file);
    return status;
  }
  for (left = about.st_size - seal_length; left > 0; left -= got) {
    got = read(file, bytes, left < piece ? (size_t)left : (size_t)piece);
    if (got <= 0) break;
    crc = crc_of(crc, bytes, (size_t)got);
  }
  snprintf(wanted, sizeof wanted, seal_form, crc, (unsigned long long)(about.st_size - seal_length));
  if (left > 0) status = EIO;
  else if (memcmp(found, wanted, seal_length) != 0) status = -2;
  free(bytes);
  close(file);
  return status;
}

/* Whether a text has a line among its first megabyte; -1: it is no plain file, or not to be read. */
int gfb_has_line(const char *path, const char *line)
{
  struct stat about;
  size_t      length = strlen(line);
  ssize_t     got;
  char       *bytes = NULL, *place;
  int         file = open(path, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC), found = -1;

  if (file < 0) return -1;
  if (fstat(file, &about) == 0 && S_ISREG(about.st_mode) && (bytes = malloc(piece + 1)) && (got = read(file, bytes, piece)) >= 0) {
    bytes[got] = 0;
    found = 0;
    for (place = strstr(bytes, line); place && !found; place = strstr(place + 1, line))
      found = (place == bytes || place[-1] == '\n') && (place[length] == '\n' || place[length] == 0);
  }
  free(bytes);
  close(file);
  return found;
}

/* --- one file --- */

static int write_all(int file, const char *bytes, size_t length)
{
  while (length > 0) {
    ssize_t done = write(file, bytes, length < piece ? length : (size_t)piece);
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) return done < 0 ? errno : ENOSPC;
    bytes += done;
    length -= (size_t)done;
  }
  return 0;
}

/* A new file of a folder that nobody else has and that this process has locked. Its name was never used before: a list that a
   dead run has left does not mean it. */
static int create_own(int folder, const char *begin, mode_t mode, char name[], size_t room, int *file)
{
  struct stat     about;
  struct timespec now;

  clock_gettime(CLOCK_REALTIME, &now);
  for (int number = 0; number < most_tries; number++) {
    if (snprintf(name, room, "%s%ld-%llx-%d", begin, (long)getpid(), 1000000000ull*(unsigned long long)now.tv_sec
                 + (unsigned long long)now.tv_nsec, number) >= (int)room) return ENAMETOOLONG;
    *file = openat(folder, name, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, mode);
    if (*file < 0 && errno == EEXIST) continue;
    if (*file < 0) return errno;
    flock(*file, LOCK_EX | LOCK_NB);
    if (fstat(*file, &about) == 0 && about.st_nlink > 0) return 0;
    close(*file); /* somebody took it for one of a dead owner */
  }
  return EEXIST;
}

/* Writes a file of its own, synced, with a checksum behind its bytes where it is to be sealed; gives its bare name. */
int gfb_write_unfinished(const char *folder, const char *bytes, size_t length, int sealed, char name[], size_t room,
                         int *file)
{
  char seal[seal_length + 1];
  int  place = open_folder(folder), status;

  if (place < 0) return errno;
  status = create_own(place, unfinished, 0666, name, room, file);
  if (status == 0) {
    status = write_all(*file, bytes, length);
    if (status == 0 && sealed) {
      snprintf(seal, sizeof seal, seal_form, crc_of(0, (const unsigned char *)bytes, length), (unsigned long long)length);
      status = write_all(*file, seal, seal_length);
    }
    if (status == 0 && fsync(*file) != 0 && errno != EINVAL) status = errno;
    if (status != 0) {
      unlinkat(place, name, 0);
      close(*file);
    }
  }
  close(place);
  return status;
}

void gfb_drop_unfinished(const char *folder, const char *name, int file)
{
  int place = open_folder(folder);

  if (place >= 0) {
    unlinkat(place, name, 0);
    close(place);
  }
  close(file);
}

/* --- several files --- */

static void sync_folder(int folder)
{
  int file = openat(folder, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);

  if (file < 0) return;
  fsync(file);
  close(file);
}

static const char *next_word(const char *word)
{
  return word + strlen(word) + 1;
}

/* Where a list keeps what stood under a name, while that is being replaced. */
static void backup_name(const char *list, int number, char backup[NAME_MAX + 1])
{
  snprintf(backup, NAME_MAX + 1, "%s%.200s-%d%s", unfinished, list + strlen(journal), number, backup_end);
}

/* Keeps what a file is to replace, where that is no folder. */
static int back_up(int folder, const char *name, const char *backup)
{
  struct stat about;

  if (linkat(folder, name, folder, backup, 0) == 0 || errno == ENOENT) return 0;
  if (errno == ENOSPC || errno == EDQUOT || errno == EIO) return errno;
  if (fstatat(folder, name, &about, AT_SYMLINK_NOFOLLOW) != 0 || S_ISDIR(about.st_mode)) return 0; /* the renaming will say so */
  return renameat(folder, name, folder, backup) == 0 ? 0 : errno; /* a file system without links */
}

static void remove_backups(int folder, const char *list, int count)
{
  char backup[NAME_MAX + 1];

  for (int i = 0; i < count; i++) {
    backup_name(list, i, backup);
    unlinkat(folder, backup, 0);
  }
}

/* Puts back what stood under the names; where nothing did, the first names, which were given already, go. */
static void put_back(int folder, const char *list, int given, int count, const char *names)
{
  char backup[NAME_MAX + 1];

  for (int i = 0; i < count; i++, names = next_word(next_word(names))) {
    backup_name(list, i, backup);
    if (renameat(folder, backup, folder, next_word(names)) != 0 && i < given) unlinkat(folder, next_word(names), 0);
  }
}

/* Renames files of a folder, each by its present and its new bare name, one after the other with a closing zero: all of them or
   none. A list of them stands in the folder meanwhile, by which a later run of the case finishes what a kill has interrupted. */
int gfb_publish(const char *folder, int count, const char *names, size_t length, int *culprit)
{
  char        list[NAME_MAX + 1], backup[NAME_MAX + 1];
  const char *name;
  int         place = open_folder(folder), file, done, status;

  *culprit = 0;
  if (place < 0) return errno;
  status = create_own(place, journal, 0600, list, sizeof list, &file);
  if (status != 0) {
    close(place);
    return status;
  }
  status = write_all(file, names, length);
  for (done = 0, name = names; done < count && status == 0; done++, name = next_word(next_word(name))) {
    backup_name(list, done, backup);
    status = back_up(place, next_word(name), backup);
    if (status != 0) *culprit = done;
  }
  if (status == 0) status = write_all(file, journal_end, sizeof journal_end);
  if (status == 0 && fsync(file) != 0 && errno != EINVAL) status = errno;
  for (done = 0, name = names; done < count && status == 0; name = next_word(next_word(name))) {
    if (renameat(place, name, place, next_word(name)) != 0) {
      status   = errno;
      *culprit = done;
    } else done++;
  }
  if (status != 0) {
    if (ftruncate(file, (off_t)length) != 0) unlinkat(place, list, 0); /* what is put back is not to be renamed by a later run */
    put_back(place, list, done, count, names);
  }
  sync_folder(place);
  remove_backups(place, list, count);
  unlinkat(place, list, 0); /* last: who finds it knows what else there may be */
  close(file);
  close(place);
  return status;
}

/* --- what dead runs have left --- */

/* Whether a name is a bare one of a case's results: the case's, a dot, and a result's ending. */
static int is_result(const char *stem, const char *name)
{
  size_t length = strlen(name), start = strlen(stem);

  if (strchr(name, '/') || strncmp(name, stem, start) != 0 || name[start] != '.' || start == 0) return 0;
  for (size_t i = 0; i < sizeof result_ends/sizeof *result_ends; i++) {
    size_t end = strlen(result_ends[i]);
    if (length >= start + end && strcmp(name + length - end, result_ends[i]) == 0) return 1;
  }
  return 0;
}

/* Whether nothing stands under a name of a folder, or what this user has put there: no folder; where `plain` a file of one name. */
static int may_be_moved(int folder, const char *name, int plain)
{
  struct stat about;

  if (fstatat(folder, name, &about, AT_SYMLINK_NOFOLLOW) != 0) return errno == ENOENT;
  if (about.st_uid != geteuid() || S_ISDIR(about.st_mode)) return 0;
  return !plain || (S_ISREG(about.st_mode) && about.st_nlink == 1);
}

/* Whether a list was left by a run of a case: of each pair an unfinished file and a result. */
static int is_of_case(int folder, const char *list, int count, const char *names, const char *stem)
{
  char backup[NAME_MAX + 1];

  for (int i = 0; i < count; i++, names = next_word(next_word(names))) {
    backup_name(list, i, backup);
    if (strchr(names, '/') || strncmp(names, unfinished, strlen(unfinished)) != 0 || !is_result(stem, next_word(names))) return 0;
    if (!may_be_moved(folder, names, 1) || !may_be_moved(folder, backup, 0)) return 0;
  }
  return 1;
}

/* The words of a list that this user alone can have written, the last one that is whole included; NULL: it is no such list. */
static char *read_list(int file, size_t *length)
{
  struct stat about;
  char       *words;

  if (fstat(file, &about) != 0 || !S_ISREG(about.st_mode) || about.st_nlink != 1 || about.st_uid != geteuid()
      || (about.st_mode & (S_IWGRP | S_IWOTH)) || about.st_size > longest_list) return NULL;
  *length = (size_t)about.st_size;
  words   = malloc(*length + 1);
  if (words && read(file, words, *length) != (ssize_t)*length) {
    free(words);
    return NULL;
  }
  while (words && *length > 0 && words[*length - 1]) --*length;
  return words;
}

/* Finishes a renaming that was interrupted when its list was whole, or puts back what was kept; no backup is left. Whether the
   list was one of the case. */
static int finish_list(int folder, const char *list, int file, const char *stem)
{
  size_t length;
  char  *names = read_list(file, &length);
  int    words = 0, whole, mine;

  if (!names) return 0;
  for (size_t i = 0; i < length; i++) words += !names[i];
  whole = words % 2 == 1 && length > sizeof journal_end
          && memcmp(names + length - sizeof journal_end - 1, "\0all", sizeof journal_end + 1) == 0;
  mine = is_of_case(folder, list, words/2, names, stem);
  if (mine) {
    const char *name = names;
    for (int i = 0; whole && i < words/2; i++, name = next_word(next_word(name))) renameat(folder, name, folder, next_word(name));
    if (!whole) put_back(folder, list, 0, words/2, names);
    remove_backups(folder, list, words/2);
  }
  free(names);
  return mine;
}

/* Whether the list stands in the folder for which a backup is kept: it is there before the backup and goes after it. */
static int has_list(int folder, const char *backup)
{
  char  list[NAME_MAX + 1];
  char *number;

  snprintf(list, sizeof list, "%s%s", journal, backup + strlen(unfinished));
  list[strlen(list) - strlen(backup_end)] = 0;
  if ((number = strrchr(list, '-'))) *number = 0;
  return faccessat(folder, list, F_OK, AT_SYMLINK_NOFOLLOW) == 0;
}

/* Takes an unfinished file away that has no living owner; one of another user, and what is no file, stays. */
static void clear_file(int folder, const char *name)
{
  size_t      length = strlen(name), end = strlen(backup_end);
  struct stat about;
  int         file;

  if (length > strlen(unfinished) + end && strcmp(name + length - end, backup_end) == 0) { /* no owner locks it */
    if (!has_list(folder, name) && may_be_moved(folder, name, 0)) unlinkat(folder, name, 0);
    return;
  }
  file = openat(folder, name, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (file < 0) return;
  if (fstat(file, &about) == 0 && S_ISREG(about.st_mode) && about.st_uid == geteuid() && flock(file, LOCK_EX | LOCK_NB) == 0)
    unlinkat(folder, name, 0);
  close(file);
}

/* Finishes or undoes what dead runs of a case have left in a folder, and takes away what stands unfinished there without a living
   owner. Lists that are not the case's stay as they are, with all that they may name: their number, and the name of one. */
void gfb_clear_folder(const char *path, const char *stem, int *left, char name[], size_t room)
{
  struct dirent *entry;
  DIR           *all;
  int            folder = open_folder(path), living = 0;

  *left = 0;
  *name = 0;
  if (folder < 0) return;
  for (int lists = 1; lists >= (*left + living > 0); lists--) { /* lists first: they name files that are whole */
    const char *begin = lists ? journal : unfinished;
    if (!(all = fdopendir(openat(folder, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC)))) break;
    while ((entry = readdir(all))) {
      int file;
      if (strncmp(entry->d_name, begin, strlen(begin)) != 0) continue;
      if (!lists) {
        clear_file(folder, entry->d_name);
        continue;
      }
      file = openat(folder, entry->d_name, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
      if (file < 0 && errno == ENOENT) continue;
      if (file >= 0 && flock(file, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) living++;
      else if (file >= 0 && finish_list(folder, entry->d_name, file, stem)) unlinkat(folder, entry->d_name, 0);
      else if ((*left)++ == 0) snprintf(name, room, "%s", entry->d_name);
      if (file >= 0) close(file);
    }
    closedir(all);
  }
  close(folder);
}

/* Whether a name without its stem is that of a surface's file: .SURFACE.vtkhdf or .SURFACE.steps.vtkhdf. A case whose name goes
   on after a dot has other files. */
static int is_surface(const char *rest)
{
  size_t surface;

  if (*rest++ != '.') return 0;
  surface = strcspn(rest, ".");
  rest += surface;
  return surface > 0 && (strcmp(rest, ".vtkhdf") == 0 || strcmp(rest, ".steps.vtkhdf") == 0);
}

void gfb_remove_surfaces(const char *stem)
{
  char           folder[PATH_MAX], path[PATH_MAX];
  const char    *name = strrchr(stem, '/');
  struct dirent *entry;
  DIR           *all;

  name = name ? name + 1 : stem;
  if (snprintf(folder, sizeof folder, "%.*s", (int)(name - stem), stem) >= (int)sizeof folder) return;
  if (!(all = opendir(*folder ? folder : "."))) return;
  while ((entry = readdir(all))) {
    if (strncmp(entry->d_name, name, strlen(name)) != 0 || !is_surface(entry->d_name + strlen(name))) continue;
    if (snprintf(path, sizeof path, "%s%s", folder, entry->d_name) < (int)sizeof path) unlink(path);
  }
  closedir(all);
}

/* --- one run a case --- */

/* Locks a case of a folder; -1: another process has it; -2: what stands under the name is no plain file. Where a file system knows
   no locks, none is there. */
int gfb_lock_case(const char *name, int *file)
{
  struct stat mine, there;

  for (int tries = 0; tries < 100; tries++) {
    *file = open(name, O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0666);
    if (*file < 0) return errno == ELOOP || errno == EISDIR || errno == ENXIO ? -2 : errno;
    if (fstat(*file, &mine) != 0 || !S_ISREG(mine.st_mode)) {
      close(*file);
      return -2;
    }
    if (flock(*file, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
      close(*file);
      return -1;
    }
    if (lstat(name, &there) == 0 && mine.st_ino == there.st_ino && mine.st_dev == there.st_dev) return 0;
    close(*file); /* its last owner has removed it meanwhile */
  }
  return -1;
}

/* Longest name of a file in a folder, and longest path. */
void gfb_name_limits(const char *folder, int *name, int *path)
{
  long most = pathconf(folder, _PC_NAME_MAX);

  *name = most > 0 ? (int)most : NAME_MAX;
  *path = PATH_MAX - 1;
}

void gfb_error_words(int status, char words[], size_t room)
{
  snprintf(words, room, "%s", strerror(status));
}
