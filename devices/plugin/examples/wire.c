/* A triggered projector whose pictures travel over a Unix stream socket to whatever emulates its optics, which gives
 * itself the triggers and tells what became of them: ../wire_framing.h, ../README.md. Option: socket (a path). */
#define _POSIX_C_SOURCE 200809L

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <poll.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <sys/un.h>
#include <unistd.h>

#include "../example_helpers.h"
#include "../focalstage_projector.h"
#include "../wire_framing.h"

#define MS INT64_C(1000000)

struct focalstage_projector_device {
  int fd;
  struct wire_geometry geometry;
  char path[FOCALSTAGE_TEXT_BYTES];
  pthread_t reader;
  pthread_mutex_t writing; /* one message at a time; whoever sends gives way within some ms once `hurry` is set */
  pthread_mutex_t books;   /* what follows; held for some instructions only */
  int lost;                /* the stream ended, and with it all light */
  int hurry;
  int running;
  uint64_t run;
  uint64_t submitted;
  struct wire_counts counts;
  uint64_t blanks;  /* asked for */
  uint64_t blanked; /* answered */
  uint32_t channels;
  uint32_t count; /* of exposures in a period */
  uint8_t* picture;
};

static int read_flag(struct focalstage_projector_device* device, const int* flag) {
  pthread_mutex_lock(&device->books);
  const int value = *flag;
  pthread_mutex_unlock(&device->books);
  return value;
}

static void set_flag(struct focalstage_projector_device* device, int* flag, int value) {
  pthread_mutex_lock(&device->books);
  *flag = value;
  pthread_mutex_unlock(&device->books);
}

/* The optics go dark where the stream ends: the last resort. */
static void hang_up(struct focalstage_projector_device* device) {
  set_flag(device, &device->lost, 1);
  shutdown(device->fd, SHUT_RDWR);
}

/* All of it until `until`, or nothing more ever. `urgent`: does not give way to one who hurries. */
static int send_bytes(struct focalstage_projector_device* device, const void* bytes, size_t size, int64_t until,
                      int urgent) {
  const char* next = bytes;
  while (size > 0) {
    const ssize_t sent = send(device->fd, next, size, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent > 0) {
      next += sent;
      size -= (size_t)sent;
      continue;
    }
    const int full = sent < 0 && (errno == EAGAIN || errno == EINTR);
    if (!full || now_ns() > until || (!urgent && read_flag(device, &device->hurry))) {
      hang_up(device);
      return 0;
    }
    struct pollfd room = {device->fd, POLLOUT, 0};
    poll(&room, 1, 2);
  }
  return 1;
}

struct part {
  const void* bytes;
  size_t size;
};

/* One message of a fixed part and what follows it. `writing` is held. */
static int send_message(struct focalstage_projector_device* device, uint32_t type, struct part fixed, struct part rest,
                        int64_t within_ns, int urgent) {
  const int64_t until = now_ns() + within_ns;
  const struct wire_header header = {type, 0, fixed.size + rest.size};
  return send_bytes(device, &header, sizeof header, until, urgent) &&
         send_bytes(device, fixed.bytes, fixed.size, until, urgent) &&
         send_bytes(device, rest.bytes, rest.size, until, urgent);
}

static int32_t tell(struct focalstage_projector_device* device, uint32_t type, struct part fixed, struct part rest,
                    char* error) {
  pthread_mutex_lock(&device->writing);
  const int sent = send_message(device, type, fixed, rest, 80 * MS, 0);
  pthread_mutex_unlock(&device->writing);
  return sent ? FOCALSTAGE_OK : fail(error, FOCALSTAGE_LOST, "the optics at the other end of the socket are gone");
}

static int receive(int fd, void* into, size_t size) {
  char* next = into;
  while (size > 0) {
    const ssize_t got = recv(fd, next, size, 0);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return 0;
    next += got;
    size -= (size_t)got;
  }
  return 1;
}

/* One message whose body is just so long; any other ends the conversation. */
static uint32_t receive_message(int fd, void* body, size_t most) {
  struct wire_header header;
  if (!receive(fd, &header, sizeof header) || header.bytes > most) return 0;
  const size_t wanted = header.type == WIRE_GEOMETRY ? sizeof(struct wire_geometry)
                        : header.type == WIRE_COUNTS ? sizeof(struct wire_counts)
                                                     : sizeof(struct wire_blank);
  if (header.bytes != wanted || !receive(fd, body, header.bytes)) return 0;
  return header.type;
}

static void* listen_to_optics(void* argument) {
  struct focalstage_projector_device* device = argument;
  union {
    struct wire_geometry geometry;
    struct wire_counts counts;
    struct wire_blank blank;
  } body;
  for (;;) {
    const uint32_t type = receive_message(device->fd, &body, sizeof body);
    if (type != WIRE_COUNTS && type != WIRE_BLANKED) break;
    pthread_mutex_lock(&device->books);
    if (type == WIRE_BLANKED) device->blanked = body.blank.number;
    if (type == WIRE_COUNTS) {
      device->counts.told_ns = body.counts.told_ns;
      if (body.counts.run == device->run) device->counts = body.counts;
    }
    pthread_mutex_unlock(&device->books);
  }
  hang_up(device);
  return NULL;
}

static int connect_to(const char* path) {
  struct sockaddr_un address = {.sun_family = AF_UNIX};
  if (strlen(path) >= sizeof address.sun_path) return -1;
  memcpy(address.sun_path, path, strlen(path) + 1);
  const int fd = socket(AF_UNIX, SOCK_STREAM, 0);
  if (fd < 0) return -1;
  fcntl(fd, F_SETFD, FD_CLOEXEC);
  const struct timeval patience = {2, 0};
  setsockopt(fd, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  if (connect(fd, (const struct sockaddr*)&address, sizeof address) == 0) return fd;
  close(fd);
  return -1;
}

static int greet(struct focalstage_projector_device* device) {
  const struct {
    struct wire_header header;
    struct wire_hello hello;
  } message = {{WIRE_HELLO, 0, sizeof(struct wire_hello)}, {WIRE_VERSION, 0}};
  if (send(device->fd, &message, sizeof message, MSG_NOSIGNAL) != (ssize_t)sizeof message) return 0;
  struct wire_geometry* geometry = &device->geometry;
  if (receive_message(device->fd, geometry, sizeof *geometry) != WIRE_GEOMETRY) return 0;
  const struct timeval forever = {0, 0};
  setsockopt(device->fd, SOL_SOCKET, SO_RCVTIMEO, &forever, sizeof forever);
  geometry->serial[sizeof geometry->serial - 1] = 0;
  return geometry->version == WIRE_VERSION && geometry->width_px >= 1 && geometry->width_px <= 8192 &&
         geometry->height_px >= 1 && geometry->height_px <= 8192;
}

static void discard(struct focalstage_projector_device* device) {
  if (device->fd >= 0) close(device->fd);
  free(device->picture);
  free(device);
}

static int32_t wire_open(const struct focalstage_setting* settings, uint32_t count,
                         struct focalstage_projector_device** device, char* error) {
  if (count != 1 || strcmp(settings[0].key, "socket") != 0) {
    return fail(error, FOCALSTAGE_SETTINGS, "the wire projector has one option: socket, the path of the optics");
  }
  struct focalstage_projector_device* made = calloc(1, sizeof *made);
  if (made == NULL) return fail(error, FOCALSTAGE_UNABLE, "there is not enough memory");
  snprintf(made->path, sizeof made->path, "%s", settings[0].value);
  made->fd = connect_to(settings[0].value);
  if (made->fd < 0 || !greet(made)) {
    discard(made);
    return fail(error, FOCALSTAGE_ABSENT, "no optics answer at this socket");
  }
  made->picture = malloc((size_t)made->geometry.width_px * made->geometry.height_px * 3);
  made->counts.told_ns = now_ns();
  pthread_mutex_init(&made->writing, NULL);
  pthread_mutex_init(&made->books, NULL);
  if (made->picture == NULL || pthread_create(&made->reader, NULL, listen_to_optics, made) != 0) {
    discard(made);
    return fail(error, FOCALSTAGE_UNABLE, "there is not enough memory");
  }
  *device = made;
  return FOCALSTAGE_OK;
}

static void wire_close(struct focalstage_projector_device* device) {
  hang_up(device);
  pthread_join(device->reader, NULL);
  pthread_mutex_destroy(&device->writing);
  pthread_mutex_destroy(&device->books);
  discard(device);
}

static void wire_describe(struct focalstage_projector_device* device, struct focalstage_identity* identity,
                          struct focalstage_projector_abilities* abilities) {
  memset(identity, 0, sizeof *identity);
  snprintf(identity->model, sizeof identity->model, "optics behind a socket");
  snprintf(identity->serial, sizeof identity->serial, "%s", device->geometry.serial);
  memcpy(identity->address, device->path, sizeof identity->address);
  memset(abilities, 0, sizeof *abilities);
  abilities->width_px = device->geometry.width_px;
  abilities->height_px = device->geometry.height_px;
  abilities->pacing = FOCALSTAGE_TRIGGERED;
  abilities->most_bits = 8;
  abilities->rgb = 1;
  abilities->most_periods_ahead = device->geometry.most_periods_ahead;
  abilities->latency_ns = device->geometry.latency_ns;
}

static const struct part nothing = {NULL, 0};

static int32_t wire_identify(struct focalstage_projector_device* device, char* error) {
  return tell(device, WIRE_IDENTIFY, nothing, nothing, error);
}

static int32_t wire_configure(struct focalstage_projector_device* device, const struct focalstage_exposures* exposures,
                              char* error) {
  if (exposures->count < 1) return fail(error, FOCALSTAGE_UNABLE, "it shows at least one picture in a period");
  device->channels = exposures->channels;
  pthread_mutex_lock(&device->books);
  device->count = exposures->count;
  pthread_mutex_unlock(&device->books);
  const struct wire_configure told = {exposures->period_ns, exposures->exposure_ns, exposures->channels,
                                      exposures->count};
  const struct part starts = {exposures->start_ns, exposures->count * sizeof *exposures->start_ns};
  return tell(device, WIRE_CONFIGURE, (struct part){&told, sizeof told}, starts, error);
}

static int32_t wire_start(struct focalstage_projector_device* device, char* error) {
  pthread_mutex_lock(&device->books);
  device->run = (uint64_t)now_ns(); /* another one each time, also than those before this process */
  const struct wire_start told = {device->run};
  device->submitted = 0;
  device->counts.run = device->run;
  device->counts.shown = device->counts.missed = 0;
  device->hurry = 0;
  device->running = device->count > 0;
  const int running = device->running;
  pthread_mutex_unlock(&device->books);
  if (!running) return fail(error, FOCALSTAGE_UNABLE, "it was not configured");
  return tell(device, WIRE_START, (struct part){&told, sizeof told}, nothing, error);
}

static void wire_stop(struct focalstage_projector_device* device) {
  char words[FOCALSTAGE_ERROR_BYTES];
  set_flag(device, &device->running, 0);
  if (!read_flag(device, &device->lost)) (void)tell(device, WIRE_STOP, nothing, nothing, words);
}

/* How a picture that comes now fares. */
static int32_t admission(struct focalstage_projector_device* device) {
  pthread_mutex_lock(&device->books);
  const uint64_t most = (uint64_t)device->geometry.most_periods_ahead * device->count;
  const int room = device->submitted - device->counts.shown < most;
  const int32_t code = device->lost       ? FOCALSTAGE_LOST
                       : !device->running ? FOCALSTAGE_DARK
                       : room             ? FOCALSTAGE_OK
                                          : FOCALSTAGE_NOT_YET;
  pthread_mutex_unlock(&device->books);
  return code;
}

static int32_t wire_acquire(struct focalstage_projector_device* device, uint8_t** buffer, int64_t timeout_ns,
                            char* error) {
  (void)error;
  const int64_t until = now_ns() + timeout_ns;
  int32_t code = admission(device);
  while (code == FOCALSTAGE_NOT_YET && now_ns() < until) {
    pause_ns(MS / 2);
    code = admission(device);
  }
  *buffer = device->picture; /* it is sent whole before the next one is asked for */
  return code;
}

static int32_t wire_submit(struct focalstage_projector_device* device, uint8_t* buffer, uint64_t period,
                           uint32_t exposure, char* error) {
  const int32_t code = admission(device);
  if (code != FOCALSTAGE_OK) return code;
  const struct wire_geometry* geometry = &device->geometry;
  const struct wire_frame frame = {period,         exposure, geometry->width_px, geometry->height_px, device->channels,
                                   buffer == NULL, 0};
  const size_t bytes = (size_t)geometry->width_px * geometry->height_px * device->channels;
  const struct part codes = {buffer, buffer == NULL ? 0 : bytes};
  pthread_mutex_lock(&device->books); /* counted before the optics can show it */
  ++device->submitted;
  pthread_mutex_unlock(&device->books);
  return tell(device, WIRE_FRAME, (struct part){&frame, sizeof frame}, codes, error);
}

static int32_t wire_status(struct focalstage_projector_device* device, struct focalstage_projector_counts* counts,
                           char* error) {
  memset(counts, 0, sizeof *counts);
  counts->temperature_c = NAN;
  pthread_mutex_lock(&device->books);
  counts->told_ns = device->counts.told_ns;
  counts->shown = device->counts.shown;
  counts->missed = device->counts.missed;
  const int lost = device->lost;
  pthread_mutex_unlock(&device->books);
  return lost ? fail(error, FOCALSTAGE_LOST, "the optics at the other end of the socket are gone") : FOCALSTAGE_OK;
}

static int32_t wire_blank(struct focalstage_projector_device* device) {
  const int64_t until = now_ns() + 80 * MS;
  pthread_mutex_lock(&device->books);
  device->running = 0;
  device->hurry = 1;
  const struct wire_blank told = {++device->blanks};
  pthread_mutex_unlock(&device->books);
  int sent = 0;
  while (!sent && now_ns() < until && !read_flag(device, &device->lost)) {
    if (pthread_mutex_trylock(&device->writing) == 0) {
      sent = send_message(device, WIRE_BLANK, (struct part){&told, sizeof told}, nothing, until - now_ns(), 1);
      pthread_mutex_unlock(&device->writing);
    } else {
      pause_ns(MS);
    }
  }
  while (sent && now_ns() < until && !read_flag(device, &device->lost)) {
    pthread_mutex_lock(&device->books);
    const int dark = device->blanked >= told.number;
    pthread_mutex_unlock(&device->books);
    if (dark) return FOCALSTAGE_OK;
    pause_ns(MS / 5);
  }
  hang_up(device);
  return FOCALSTAGE_LOST;
}

static const struct focalstage_projector table = {sizeof table,  FOCALSTAGE_PROJECTOR_ABI,
                                                  "wire",        wire_open,
                                                  wire_close,    wire_describe,
                                                  wire_identify, wire_configure,
                                                  wire_start,    wire_stop,
                                                  wire_acquire,  wire_submit,
                                                  wire_status,   wire_blank};

uint32_t focalstage_projector_abi(void) { return FOCALSTAGE_PROJECTOR_ABI; }

const struct focalstage_projector* focalstage_projector_get(uint32_t abi) {
  return abi == FOCALSTAGE_PROJECTOR_ABI ? &table : NULL;
}
