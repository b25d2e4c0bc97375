#include "devices/display_kms/drm_calls.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <unistd.h>
#include <xf86drm.h>

#include <cerrno>
#include <cstring>

namespace focalstage {

namespace {

int checked(int result) { return result == 0 ? 0 : errno != 0 ? -errno : -EIO; }

void note_flip(int, unsigned sequence, unsigned seconds, unsigned micros, void* flip) {
  *static_cast<std::optional<DrmFlip>*>(flip) = DrmFlip{sequence, seconds + 1e-6 * micros};
}

/// The property of that name, to be freed; null where there is none.
drmModePropertyRes* find_property(int card, const drmModeConnector& connector, const std::string& name, int& index) {
  for (index = 0; index < connector.count_props; ++index) {
    drmModePropertyRes* property = drmModeGetProperty(card, connector.props[index]);
    if (property != nullptr && name == property->name) return property;
    drmModeFreeProperty(property);
  }
  return nullptr;
}

std::optional<std::uint64_t> value_named(const drmModePropertyRes& property, const std::string& name) {
  if ((property.flags & DRM_MODE_PROP_ENUM) == 0) return std::stoull(name);
  for (int i = 0; i < property.count_enums; ++i) {
    if (name == property.enums[i].name) return property.enums[i].value;
  }
  return std::nullopt;
}

class KernelDrm final : public DrmCalls {
 public:
  std::vector<std::string> cards() override {
    std::vector<std::string> found;
    for (int i = 0; i < 16; ++i) {
      const std::string path = "/dev/dri/card" + std::to_string(i);
      if (::access(path.c_str(), F_OK) == 0) found.push_back(path);
    }
    return found;
  }

  int open(const std::string& path) override {
    const int card = ::open(path.c_str(), O_RDWR | O_CLOEXEC);
    return card >= 0 ? card : -errno;
  }
  void close(int card) override { ::close(card); }

  bool monotonic(int card) override {
    std::uint64_t value = 0;
    return drmGetCap(card, DRM_CAP_TIMESTAMP_MONOTONIC, &value) == 0 && value == 1;
  }

  int set_master(int card) override { return checked(drmSetMaster(card)); }
  void drop_master(int card) override { drmDropMaster(card); }

  drmModeRes* resources(int card) override { return drmModeGetResources(card); }
  void free(drmModeRes* resources) override { drmModeFreeResources(resources); }
  drmModeConnector* connector(int card, std::uint32_t id, bool probe) override {
    return probe ? drmModeGetConnector(card, id) : drmModeGetConnectorCurrent(card, id);
  }
  void free(drmModeConnector* connector) override { drmModeFreeConnector(connector); }
  drmModeEncoder* encoder(int card, std::uint32_t id) override { return drmModeGetEncoder(card, id); }
  void free(drmModeEncoder* encoder) override { drmModeFreeEncoder(encoder); }
  drmModeCrtc* crtc(int card, std::uint32_t id) override { return drmModeGetCrtc(card, id); }
  void free(drmModeCrtc* crtc) override { drmModeFreeCrtc(crtc); }

  std::vector<std::uint8_t> blob(int card, const drmModeConnector& connector, const std::string& name) override {
    std::vector<std::uint8_t> bytes;
    int index = 0;
    drmModePropertyRes* property = find_property(card, connector, name, index);
    if (property == nullptr) return bytes;
    drmModePropertyBlobRes* content =
        drmModeGetPropertyBlob(card, static_cast<std::uint32_t>(connector.prop_values[index]));
    if (content != nullptr) {
      const auto* data = static_cast<const std::uint8_t*>(content->data);
      bytes.assign(data, data + content->length);
      drmModeFreePropertyBlob(content);
    }
    drmModeFreeProperty(property);
    return bytes;
  }

  int set_property(int card, const drmModeConnector& connector, const std::string& name,
                   const std::string& value) override {
    int index = 0;
    drmModePropertyRes* property = find_property(card, connector, name, index);
    if (property == nullptr) return -ENOENT;
    const auto wanted = value_named(*property, value);
    const int result =
        wanted ? checked(drmModeConnectorSetProperty(card, connector.connector_id, property->prop_id, *wanted))
               : -ENOENT;
    drmModeFreeProperty(property);
    return result;
  }

  int create_buffer(int card, std::uint32_t width, std::uint32_t height, DrmBuffer& buffer) override {
    drm_mode_create_dumb request{};
    request.width = width;
    request.height = height;
    request.bpp = 32;
    if (drmIoctl(card, DRM_IOCTL_MODE_CREATE_DUMB, &request) != 0) return -errno;
    buffer = {request.handle, request.pitch, request.size};
    return 0;
  }

  void destroy_buffer(int card, std::uint32_t handle) override {
    drm_mode_destroy_dumb request{handle};
    drmIoctl(card, DRM_IOCTL_MODE_DESTROY_DUMB, &request);
  }

  std::uint8_t* map_buffer(int card, const DrmBuffer& buffer) override {
    drm_mode_map_dumb request{};
    request.handle = buffer.handle;
    if (drmIoctl(card, DRM_IOCTL_MODE_MAP_DUMB, &request) != 0) return nullptr;
    void* bytes =
        ::mmap(nullptr, buffer.size, PROT_READ | PROT_WRITE, MAP_SHARED, card, static_cast<off_t>(request.offset));
    return bytes == MAP_FAILED ? nullptr : static_cast<std::uint8_t*>(bytes);
  }
  void unmap_buffer(std::uint8_t* bytes, std::uint64_t size) override { ::munmap(bytes, size); }

  int add_framebuffer(int card, std::uint32_t width, std::uint32_t height, const DrmBuffer& buffer,
                      std::uint32_t& framebuffer) override {
    return checked(drmModeAddFB(card, width, height, 24, 32, buffer.pitch, buffer.handle, &framebuffer));
  }
  void remove_framebuffer(int card, std::uint32_t framebuffer) override { drmModeRmFB(card, framebuffer); }

  int set_crtc(int card, std::uint32_t crtc, std::uint32_t framebuffer, std::uint32_t connector,
               drmModeModeInfo* mode) override {
    std::uint32_t connectors = connector;
    return checked(drmModeSetCrtc(card, crtc, framebuffer, 0, 0, mode != nullptr ? &connectors : nullptr,
                                  mode != nullptr ? 1 : 0, mode));
  }

  int set_gamma(int card, std::uint32_t crtc, std::span<std::uint16_t> ramp) override {
    return checked(drmModeCrtcSetGamma(card, crtc, static_cast<std::uint32_t>(ramp.size()), ramp.data(), ramp.data(),
                                       ramp.data()));
  }

  int page_flip(int card, std::uint32_t crtc, std::uint32_t framebuffer) override {
    return checked(drmModePageFlip(card, crtc, framebuffer, DRM_MODE_PAGE_FLIP_EVENT, &flip_));
  }

  std::optional<DrmFlip> wait_flip(int card, int timeout_ms) override {
    flip_.reset();
    pollfd polled{card, POLLIN, 0};
    int ready = 0;
    do {
      ready = ::poll(&polled, 1, timeout_ms);
    } while (ready < 0 && errno == EINTR);
    if (ready <= 0 || (polled.revents & POLLIN) == 0) return std::nullopt;
    drmEventContext context{};
    context.version = 2;
    context.page_flip_handler = note_flip;
    drmHandleEvent(card, &context);
    return flip_;
  }

 private:
  static thread_local std::optional<DrmFlip> flip_;  // each output flips and waits in one thread of its own
};

thread_local std::optional<DrmFlip> KernelDrm::flip_;

}  // namespace

DrmCalls& kernel_drm() {
  static KernelDrm drm;
  return drm;
}

}  // namespace focalstage
