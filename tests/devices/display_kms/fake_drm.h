#pragma once

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <cstring>
#include <map>
#include <mutex>

#include "devices/display_kms/drm_calls.h"

namespace focalstage {

/// A kernel with one card whose vblanks come when a test says so. Connector k hangs on encoder 100 + k, which either
/// crtc (200 or 201) can feed.
class FakeDrm final : public DrmCalls {
 public:
  struct Connector {
    std::uint32_t id = 0;
    bool connected = true;
    std::vector<std::uint8_t> edid;
    std::vector<drmModeModeInfo> modes;
  };

  // What a test says and asks.
  std::vector<Connector> connectors;
  std::map<std::string, std::string> properties;
  std::string path = "/dev/dri/card0";
  int master_error = 0;
  int open_error = 0;
  int mode_error = 0;
  int memory_error = 0;
  int flip_error = 0;
  bool tells_monotonic = true;
  std::uint32_t crtc_of_other = 0;  ///< one that lights something else
  int slowness = 1;                 ///< real time to the kernel's, for a test that works between two vblanks

  /// The beam returns: what was flipped is shown.
  void vblank(std::uint32_t count = 1) {
    const std::lock_guard lock(mutex_);
    sequence_ += count;
    time_s_ += count / 60.0;
    if (pending_ == 0) return;
    shown_ = pending_;
    pending_ = 0;
    done_ = true;
    changed_.notify_all();
  }
  /// One vblank after the next flip was asked for.
  bool flip_and_vblank(std::uint32_t count = 1) {
    {
      std::unique_lock lock(mutex_);
      if (!changed_.wait_for(lock, std::chrono::seconds(20), [&] { return pending_ != 0; })) return false;
    }
    vblank(count);
    return true;
  }
  bool wait_for_flip() {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, std::chrono::seconds(20), [&] { return pending_ != 0; });
  }

  /// The pixels on the cable; empty: no signal.
  std::vector<std::uint32_t> on_cable() {
    const std::lock_guard lock(mutex_);
    std::vector<std::uint32_t> pixels;
    const auto framebuffer = framebuffers_.find(shown_);
    if (framebuffer == framebuffers_.end()) return pixels;
    const Buffer& buffer = buffers_.at(framebuffer->second);
    for (std::uint32_t y = 0; y < buffer.height; ++y) {
      const std::size_t at = pixels.size();
      pixels.resize(at + buffer.width);
      std::memcpy(&pixels[at], &buffer.bytes[y * buffer.pitch], std::size_t{4} * buffer.width);
    }
    return pixels;
  }
  std::uint32_t lit_connector() {
    const std::lock_guard lock(mutex_);
    return lit_;
  }
  std::size_t left_over() {
    const std::lock_guard lock(mutex_);
    return buffers_.size() + framebuffers_.size() + static_cast<std::size_t>(open_) + (master_ ? 1 : 0);
  }
  std::size_t gamma_size() const { return gamma_.size(); }
  double time_s() {
    const std::lock_guard lock(mutex_);
    return time_s_;
  }
  void unplug(std::size_t index) {
    const std::lock_guard lock(mutex_);
    connectors[index].connected = false;
  }

  // What the kernel does.
  std::vector<std::string> cards() override { return {path}; }
  int open(const std::string& name) override {
    if (open_error != 0 || name != path) return open_error != 0 ? open_error : -ENOENT;
    const std::lock_guard lock(mutex_);
    ++open_;
    return 42;
  }
  void close(int) override {
    const std::lock_guard lock(mutex_);
    --open_;
  }
  bool monotonic(int) override { return tells_monotonic; }
  int set_master(int) override {
    const std::lock_guard lock(mutex_);
    if (master_error == 0) master_ = true;
    return master_error;
  }
  void drop_master(int) override {
    const std::lock_guard lock(mutex_);
    master_ = false;
  }

  drmModeRes* resources(int) override {
    auto* made = new drmModeRes{};
    made->count_crtcs = 2;
    made->crtcs = new std::uint32_t[2]{200, 201};
    made->count_connectors = static_cast<int>(connectors.size());
    made->connectors = new std::uint32_t[connectors.size()];
    for (std::size_t i = 0; i < connectors.size(); ++i) made->connectors[i] = connectors[i].id;
    return made;
  }
  void free(drmModeRes* made) override {
    delete[] made->crtcs;
    delete[] made->connectors;
    delete made;
  }
  drmModeConnector* connector(int, std::uint32_t id, bool) override {
    const std::lock_guard lock(mutex_);
    const auto found = std::ranges::find(connectors, id, &Connector::id);
    if (found == connectors.end()) return nullptr;
    auto* made = new drmModeConnector{};
    made->connector_id = id;
    made->connection = found->connected ? DRM_MODE_CONNECTED : DRM_MODE_DISCONNECTED;
    made->count_modes = static_cast<int>(found->modes.size());
    made->modes = new drmModeModeInfo[found->modes.size()];
    std::ranges::copy(found->modes, made->modes);
    made->count_encoders = 1;
    made->encoders = new std::uint32_t[1]{100 + id};
    return made;
  }
  void free(drmModeConnector* made) override {
    delete[] made->modes;
    delete[] made->encoders;
    delete made;
  }
  drmModeEncoder* encoder(int, std::uint32_t id) override { return new drmModeEncoder{id, 0, 0, 3, 0}; }
  void free(drmModeEncoder* made) override { delete made; }
  drmModeCrtc* crtc(int, std::uint32_t id) override {
    auto* made = new drmModeCrtc{};
    made->crtc_id = id;
    made->gamma_size = 256;
    made->mode_valid = id == crtc_of_other ? 1 : 0;
    return made;
  }
  void free(drmModeCrtc* made) override { delete made; }
  std::vector<std::uint8_t> blob(int, const drmModeConnector& of, const std::string& name) override {
    const auto found = std::ranges::find(connectors, of.connector_id, &Connector::id);
    return name == "EDID" && found != connectors.end() ? found->edid : std::vector<std::uint8_t>{};
  }
  int set_property(int, const drmModeConnector&, const std::string& name, const std::string& value) override {
    if (name != "Broadcast RGB" && name != "max bpc") return -ENOENT;
    properties[name] = value;
    return 0;
  }

  int create_buffer(int, std::uint32_t width, std::uint32_t height, DrmBuffer& buffer) override {
    const std::lock_guard lock(mutex_);
    if (memory_error != 0) return memory_error;
    Buffer made{width, height, 4 * width + 64, {}};
    made.bytes.assign(std::size_t{made.pitch} * height, 0x55);  // whatever lay there before
    buffer = {++handles_, made.pitch, made.bytes.size()};
    buffers_[buffer.handle] = std::move(made);
    return 0;
  }
  void destroy_buffer(int, std::uint32_t handle) override {
    const std::lock_guard lock(mutex_);
    buffers_.erase(handle);
  }
  std::uint8_t* map_buffer(int, const DrmBuffer& buffer) override {
    const std::lock_guard lock(mutex_);
    return buffers_.at(buffer.handle).bytes.data();
  }
  void unmap_buffer(std::uint8_t*, std::uint64_t) override {}
  int add_framebuffer(int, std::uint32_t, std::uint32_t, const DrmBuffer& buffer, std::uint32_t& framebuffer) override {
    const std::lock_guard lock(mutex_);
    framebuffer = 1000 + buffer.handle;
    framebuffers_[framebuffer] = buffer.handle;
    return 0;
  }
  void remove_framebuffer(int, std::uint32_t framebuffer) override {
    const std::lock_guard lock(mutex_);
    framebuffers_.erase(framebuffer);
    if (shown_ == framebuffer) shown_ = 0;
  }
  int set_crtc(int, std::uint32_t, std::uint32_t framebuffer, std::uint32_t connector, drmModeModeInfo* mode) override {
    const std::lock_guard lock(mutex_);
    if (mode == nullptr) {
      shown_ = lit_ = 0;
      return 0;
    }
    if (mode_error != 0) return mode_error;
    shown_ = framebuffer;
    lit_ = connector;
    return 0;
  }
  int set_gamma(int, std::uint32_t, std::span<std::uint16_t> ramp) override {
    gamma_.assign(ramp.begin(), ramp.end());
    return 0;
  }
  int page_flip(int, std::uint32_t, std::uint32_t framebuffer) override {
    const std::lock_guard lock(mutex_);
    if (flip_error != 0) return flip_error;
    if (pending_ != 0) return -EBUSY;
    if (framebuffer == shown_) torn_ = true;
    pending_ = framebuffer;
    done_ = false;
    changed_.notify_all();
    return 0;
  }
  bool torn() {  ///< a buffer was drawn into while it was shown
    const std::lock_guard lock(mutex_);
    return torn_;
  }
  std::optional<DrmFlip> wait_flip(int, int timeout_ms) override {
    std::unique_lock lock(mutex_);
    if (!changed_.wait_for(lock, std::chrono::milliseconds(timeout_ms) * slowness, [&] { return done_; }))
      return std::nullopt;
    done_ = false;
    return DrmFlip{sequence_, time_s_};
  }

 private:
  struct Buffer {
    std::uint32_t width, height, pitch;
    std::vector<std::uint8_t> bytes;
  };
  std::mutex mutex_;
  std::condition_variable changed_;
  std::map<std::uint32_t, Buffer> buffers_;
  std::map<std::uint32_t, std::uint32_t> framebuffers_;
  std::vector<std::uint16_t> gamma_;
  std::uint32_t handles_ = 0, shown_ = 0, pending_ = 0, lit_ = 0, sequence_ = 1000;
  double time_s_ = 50.0;
  int open_ = 0;
  bool master_ = false, done_ = false, torn_ = false;
};

}  // namespace focalstage
