/* Files that become visible together: written under names of their own that no link can stand under, synced, and then
   renamed. What is unfinished stays locked by its owner, so that who finds one of a dead owner may take it away, or
   finish the renaming that the owner had begun. All functions give 0, what errno was, or a number below 0. */
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
#include <unistd.h>

static const char unfinished[] = ".gfb-file-"; /* what names of unfinished files begin with */
static const char journal[]    = ".gfb-set-";  /* the same of lists of files that are being renamed */
static const char journal_end[] = "all";       /* what a whole list ends with */
static const char backup_end[] = ".old";
static const char seal_form[]  = "gfb crc32 %08x %016llx\n";

enum { seal_length = 36, most_tries = 10000, piece = 1 << 20 };

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

/* 0: what stands in the file is what was written; -1: it ends without checksum; -2: something has changed. */
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
  else if (about.st_size < seal_length) status = -1;
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
  if (left > 0) status = EIO;
  else if (read(file, found, seal_length) != seal_length || memcmp(found, seal_form, 10) != 0) status = -1;
  snprintf(wanted, sizeof wanted, seal_form, crc, (unsigned long long)(about.st_size - seal_length));
  if (status == 0 && memcmp(found, wanted, seal_length) != 0) status = -2;
  free(bytes);
  close(file);
  return status;
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

/* A new file that nobody else has and that this process has locked. */
static int create_own(const char *folder, const char *begin, char name[], size_t room, int *file)
{
  struct stat about;

  for (int number = 0; number < most_tries; number++) {
    if (snprintf(name, room, "%s/%s%ld-%d", folder, begin, (long)getpid(), number) >= (int)room) return ENAMETOOLONG;
    *file = open(name, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (*file < 0 && errno == EEXIST) continue;
    if (*file < 0) return errno;
    flock(*file, LOCK_EX | LOCK_NB);
    if (fstat(*file, &about) == 0 && about.st_nlink > 0) return 0;
    close(*file); /* somebody took it for one of a dead owner */
  }
  return EEXIST;
}

/* Writes a file of its own, synced, with a checksum behind its bytes where it is to be sealed. */
int gfb_write_unfinished(const char *folder, const char *bytes, size_t length, int sealed, char name[], size_t room,
                         int *file)
{
  char seal[seal_length + 1];
  int  status = create_own(folder, unfinished, name, room, file);

  if (status != 0) return status;
  status = write_all(*file, bytes, length);
  if (status == 0 && sealed) {
    snprintf(seal, sizeof seal, seal_form, crc_of(0, (const unsigned char *)bytes, length), (unsigned long long)length);
    status = write_all(*file, seal, seal_length);
  }
  if (status == 0 && fsync(*file) != 0 && errno != EINVAL) status = errno;
  if (status != 0) {
    unlink(name);
    close(*file);
  }
  return status;
}

void gfb_drop_unfinished(const char *name, int file)
{
  unlink(name);
  close(file);
}

/* --- several files --- */

static void sync_folder(const char *folder)
{
  int file = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);

  if (file < 0) return;
  fsync(file);
  close(file);
}

static const char *next_word(const char *word)
{
  return word + strlen(word) + 1;
}

/* What stood under a name while it is being replaced. */
static void backup_name(const char *name, char backup[PATH_MAX + 8])
{
  snprintf(backup, PATH_MAX + 8, "%s%s", name, backup_end);
}

/* Keeps what a file is to replace, where that is no folder. */
static int back_up(const char *name)
{
  char        backup[PATH_MAX + 8];
  struct stat about;

  backup_name(name, backup);
  if (link(next_word(name), backup) == 0 || errno == ENOENT) return 0;
  if (errno == ENOSPC || errno == EDQUOT || errno == EIO) return errno;
  if (lstat(next_word(name), &about) != 0 || S_ISDIR(about.st_mode)) return 0; /* the renaming will say so */
  return rename(next_word(name), backup) == 0 ? 0 : errno; /* a file system without links */
}

static void remove_backups(int count, const char *names)
{
  char backup[PATH_MAX + 8];

  for (int i = 0; i < count; i++, names = next_word(next_word(names))) {
    backup_name(names, backup);
    unlink(backup);
  }
}

/* Puts back what stood under the names; where nothing did, the first names, which were given already, go. */
static void put_back(int given, int count, const char *names)
{
  char backup[PATH_MAX + 8];

  for (int i = 0; i < count; i++, names = next_word(next_word(names))) {
    backup_name(names, backup);
    if (rename(backup, next_word(names)) != 0 && i < given) unlink(next_word(names));
  }
}

/* Renames files, each by its present and its new name, one after the other with a closing zero: all of them or none. A
   list of them stands in the folder meanwhile, by which a later run finishes what a kill has interrupted. */
int gfb_publish(const char *folder, int count, const char *names, size_t length, int *culprit)
{
  char        list[PATH_MAX];
  const char *name;
  int         file, done, status = create_own(folder, journal, list, sizeof list, &file);

  *culprit = 0;
  if (status != 0) return status;
  status = write_all(file, names, length);
  for (done = 0, name = names; done < count && status == 0; done++, name = next_word(next_word(name))) {
    status = back_up(name);
    if (status != 0) *culprit = done;
  }
  if (status == 0) status = write_all(file, journal_end, sizeof journal_end);
  if (status == 0 && fsync(file) != 0 && errno != EINVAL) status = errno;
  for (done = 0, name = names; done < count && status == 0; name = next_word(next_word(name))) {
    if (rename(name, next_word(name)) != 0) {
      status   = errno;
      *culprit = done;
    } else done++;
  }
  if (status != 0) {
    if (ftruncate(file, (off_t)length) != 0) unlink(list); /* what is put back is not to be renamed by a later run */
    put_back(done, count, names);
  }
  sync_folder(folder);
  remove_backups(count, names);
  unlink(list); /* last: who finds it knows what else there may be */
  close(file);
  return status;
}

/* --- what dead runs have left --- */

/* Finishes a renaming that was interrupted when its list was whole, or puts back what was kept; no backup is left. */
static void finish_list(int file)
{
  struct stat about;
  char       *names = NULL;
  size_t      length;
  int         words = 0, whole;

  if (fstat(file, &about) != 0 || about.st_size <= 0) return;
  length = (size_t)about.st_size;
  names  = malloc(length);
  if (names && read(file, names, length) == (ssize_t)length) {
    whole = length > sizeof journal_end && memcmp(names + length - sizeof journal_end, journal_end, sizeof journal_end) == 0;
    for (size_t i = 0; i < length; i++) words += !names[i];
    words -= whole;
    for (const char *name = names; whole && name < names + length - sizeof journal_end; name = next_word(next_word(name)))
      rename(name, next_word(name));
    if (!whole) put_back(0, words/2, names);
    remove_backups(words/2, names);
  }
  free(names);
}

static int is_backup(const char *name)
{
  size_t length = strlen(name), end = strlen(backup_end);

  return length > end && strcmp(name + length - end, backup_end) == 0;
}

/* Whether the owner of a backup has a list in the folder, which is there before the backup and goes after it. */
static int has_list(const char *folder, const char *backup)
{
  char           begin[NAME_MAX + 1];
  const char    *owner = backup + strlen(unfinished);
  struct dirent *entry;
  DIR           *all = opendir(folder);
  int            found = 0;

  if (!all) return 1;
  snprintf(begin, sizeof begin, "%s%.*s-", journal, (int)strcspn(owner, "-"), owner);
  while (!found && (entry = readdir(all))) found = strncmp(entry->d_name, begin, strlen(begin)) == 0;
  closedir(all);
  return found;
}

/* Takes away what stands unfinished in a folder and has no living owner. */
void gfb_clear_folder(const char *folder)
{
  char           name[PATH_MAX];
  struct dirent *entry;
  DIR           *all;

  for (int lists = 1; lists >= 0; lists--) { /* lists first: they name files that are whole */
    if (!(all = opendir(folder))) return;
    while ((entry = readdir(all))) {
      const char *begin = lists ? journal : unfinished;
      int         file;
      if (strncmp(entry->d_name, begin, strlen(begin)) != 0) continue;
      if (snprintf(name, sizeof name, "%s/%s", folder, entry->d_name) >= (int)sizeof name) continue;
      if (is_backup(entry->d_name)) { /* no owner locks it */
        if (!has_list(folder, entry->d_name)) unlink(name);
        continue;
      }
      file = open(name, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
      if (file < 0) continue;
      if (flock(file, LOCK_EX | LOCK_NB) == 0) {
        if (lists) finish_list(file);
        unlink(name);
      }
      close(file);
    }
    closedir(all);
  }
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

/* Locks a case of a folder; -1: another process has it. Where a file system knows no locks, none is there. */
int gfb_lock_case(const char *name, int *file)
{
  struct stat mine, there;

  for (int tries = 0; tries < 100; tries++) {
    *file = open(name, O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (*file < 0) return errno;
    if (flock(*file, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
      close(*file);
      return -1;
    }
    if (fstat(*file, &mine) == 0 && stat(name, &there) == 0 && mine.st_ino == there.st_ino) return 0;
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
