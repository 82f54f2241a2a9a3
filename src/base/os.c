/* os.c: see os.h. What a system has is asked for by its own name; Windows is to have POSIX's names where it can. */

/* Which names headers show: those of glibc and musl, with -std=c99, what is asked for; others all, unless some is. */
#if defined __linux__ || defined __CYGWIN__ || defined __wasi__
#define _POSIX_C_SOURCE 200809L
#define _XOPEN_SOURCE 700
#endif
#define _NETBSD_SOURCE 1
#define _FILE_OFFSET_BITS 64 /* files of more than 2 GiB where long has 32 bits */

#include "base/os.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>

#ifdef _WIN32
#define PSAPI_VERSION 2 /* in kernel32 */
#include <windows.h>
/* after it */
#include <direct.h>
#include <io.h>
#include <process.h>
#include <psapi.h>
#include <pthread_time.h>

#define access _access
#define close _close
#define fdopen _fdopen
#define fileno _fileno
#define fsync _commit
#define getpid _getpid
#define isatty _isatty
#define mkdir(path, rights) _mkdir(path)
#define open _open
#define unlink _unlink
#define write _write
#define W_OK 2
enum { WINDOWS = 1, BYTES = _O_BINARY };
#else
#include <unistd.h>
enum { WINDOWS = 0, BYTES = 0 };
#endif
#if defined _WIN32 || defined __wasi__
#define fchmod(fd, rights) ((void)(fd)) /* there are none */
#endif
#ifdef __wasi__
#define getpid() 0
#undef CLOCK_PROCESS_CPUTIME_ID
#define CLOCK_PROCESS_CPUTIME_ID CLOCK_MONOTONIC
#elif !defined _WIN32
#include <sys/resource.h>
#endif

#include "base/bits.h"

/* ---- time and memory ---- */

static double seconds_of(clockid_t id)
{
    struct timespec t;
    clock_gettime(id, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

double os_wall_seconds(void) { return seconds_of(CLOCK_MONOTONIC); }
double os_cpu_seconds(void) { return seconds_of(CLOCK_PROCESS_CPUTIME_ID); }

uint64_t os_unique(void)
{
    struct timespec now;
    clock_gettime(CLOCK_REALTIME, &now);
    return hash_combine(hash_combine((uint64_t)now.tv_sec, (uint64_t)now.tv_nsec), (uint64_t)getpid());
}

double os_peak_memory(void)
{
#ifdef _WIN32
    PROCESS_MEMORY_COUNTERS counters;
    bool known = GetProcessMemoryInfo(GetCurrentProcess(), &counters, sizeof counters) != 0;
    return known ? (double)counters.PeakWorkingSetSize : 0;
#elif defined __wasi__
    return 0;
#else
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
#ifdef __APPLE__
    return (double)usage.ru_maxrss;
#else
    return 1024 * (double)usage.ru_maxrss;
#endif
#endif
}

double os_memory(void)
{
#ifdef _WIN32
    MEMORYSTATUSEX memory = {.dwLength = sizeof memory};
    return GlobalMemoryStatusEx(&memory) ? (double)memory.ullTotalPhys : 0;
#elif defined _SC_PHYS_PAGES
    long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);
    return pages > 0 && page > 0 ? (double)pages * (double)page : 0;
#else
    return 0;
#endif
}

/* ---- signals ---- */

/* Those that ask the program to end. */
static const struct {
    int number;
    const char *name;
    bool repeats;
} SIGNALS[] = {{SIGINT, "SIGINT", false},
               {SIGTERM, "SIGTERM", false},
#ifdef SIGHUP
               {SIGHUP, "SIGHUP", false},
#endif
#ifdef SIGXCPU
               {SIGXCPU, "SIGXCPU", true}, /* every second, up to the hard limit */
#endif
};
enum { N_SIGNALS = sizeof SIGNALS / sizeof SIGNALS[0] };

static void catch(int number, void (*handler)(int))
{
#if defined _WIN32 || defined __wasi__
    signal(number, handler);
#else
    struct sigaction old, action;
    if (sigaction(number, NULL, &old) != 0 || old.sa_handler == SIG_IGN)
        return;
    action.sa_handler = handler;
    action.sa_flags = SA_RESTART;
    sigemptyset(&action.sa_mask);
    sigaction(number, &action, NULL);
#endif
}

void os_catch_signals(void (*handler)(int number))
{
#ifdef SIGXFSZ
    catch(SIGXFSZ, SIG_IGN);
    catch(SIGPIPE, SIG_IGN);
#endif
    for (int i = 0; i < N_SIGNALS; i++)
        catch(SIGNALS[i].number, handler);
}

static int find_signal(int number)
{
    int i = 0;
    while (i < N_SIGNALS - 1 && SIGNALS[i].number != number)
        i++;
    return i;
}

const char *os_signal_name(int number) { return SIGNALS[find_signal(number)].name; }
bool os_signal_repeats(int number) { return SIGNALS[find_signal(number)].repeats; }

/* Safe in a handler [POSIX 2.4.3]. */
void os_remove_at_once(const char *path) { unlink(path); }

void os_say_at_once(const char *text)
{
    if (write(2, text, (unsigned)strlen(text)) < 0)
        return; /* there is nobody else to tell */
}

/* ---- files ---- */

static enum os_kind kind_of(const struct stat *info)
{
    return S_ISREG(info->st_mode) ? OS_FILE : S_ISDIR(info->st_mode) ? OS_DIRECTORY : OS_OTHER;
}

enum os_kind os_kind_of(const char *path)
{
    struct stat info;
    return stat(path, &info) == 0 ? kind_of(&info) : OS_NOTHING;
}

enum os_kind os_kind_of_stream(FILE *f, uint64_t *size)
{
    struct stat info;
    bool known = fstat(fileno(f), &info) == 0;
    *size = known ? (uint64_t)info.st_size : 0;
    return known ? kind_of(&info) : OS_NOTHING;
}

bool os_same_file(const char *a, const char *b)
{
    struct stat x, y;
    if (stat(a, &x) != 0 || stat(b, &y) != 0)
        return false;
    bool numbered = x.st_ino != 0; /* not on Windows */
    return strcmp(a, b) == 0 || (numbered && x.st_ino == y.st_ino && x.st_dev == y.st_dev);
}

bool os_terminal(FILE *f) { return isatty(fileno(f)) != 0; }
bool os_may_write(const char *path) { return access(path, W_OK) == 0; }
bool os_make_directory(const char *path) { return mkdir(path, 0777) == 0 || os_kind_of(path) == OS_DIRECTORY; }

FILE *os_create_new(const char *path, const char *like)
{
    struct stat info;
    int fd = open(path, O_WRONLY | O_CREAT | O_EXCL | BYTES, 0666);
    FILE *f = fd >= 0 ? fdopen(fd, "wb") : NULL;
    if (f == NULL && fd >= 0)
        close(fd);
    if (f != NULL && stat(like, &info) == 0)
        fchmod(fd, info.st_mode & 0777);
    return f;
}

bool os_store(FILE *f)
{
#ifdef F_FULLFSYNC /* macOS, whose fsync leaves bytes in the drive's memory */
    if (fcntl(fileno(f), F_FULLFSYNC) == 0)
        return true;
#endif
    return fsync(fileno(f)) == 0 || errno == EINVAL || errno == ENOSYS || errno == ENOTSUP;
}

bool os_separator(char c) { return c == '/' || (WINDOWS && c == '\\'); }

bool os_absolute(const char *path) { return os_separator(path[0]) || (WINDOWS && path[0] != '\0' && path[1] == ':'); }

const char *os_last_separator(const char *path)
{
    const char *last = NULL;
    for (; *path != '\0'; path++)
        if (os_separator(*path))
            last = path;
    return last;
}

#ifdef _WIN32

void os_open_standard(void) {} /* its C library opens nothing in their place */
void os_binary(FILE *f) { _setmode(fileno(f), _O_BINARY); }
FILE *os_open_input(const char *path) { return fopen(path, "rb"); }

bool os_rename(const char *from, const char *to)
{
    errno = EACCES;
    return MoveFileExA(from, to, MOVEFILE_REPLACE_EXISTING) != 0;
}

#else

/* The wrong way round, so that reading and writing fail as from a closed one. */
void os_open_standard(void)
{
    for (int fd = 0; fd <= 2; fd++)
        if (fcntl(fd, F_GETFD) == -1 && errno == EBADF && open("/dev/null", fd == 0 ? O_WRONLY : O_RDONLY) < 0)
            return; /* none is left: the next could not take the right number */
}

void os_binary(FILE *f) { (void)f; }

FILE *os_open_input(const char *path)
{
    struct stat info;
    int fd = open(path, O_RDONLY | O_NONBLOCK);
    if (fd < 0)
        return NULL;
    bool device = fstat(fd, &info) == 0 && (S_ISCHR(info.st_mode) || S_ISBLK(info.st_mode));
    FILE *f = !device && fcntl(fd, F_SETFL, 0) == 0 ? fdopen(fd, "rb") : NULL;
    int reason = device ? EPERM : errno;
    if (f == NULL)
        close(fd);
    errno = reason;
    return f;
}

bool os_rename(const char *from, const char *to) { return rename(from, to) == 0; }

#endif
