#pragma once

#include <linux/videodev2.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <deque>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "devices/camera/v4l2_calls.h"

namespace focalstage::sample {

/// What a fake camera can and how it misbehaves.
struct FakeCamera {
  std::string model = "Fake Camera";
  std::string bus = "usb-fake-1";
  bool can_gray = true;
  bool can_yuyv = true;
  bool busy = false;
  std::uint32_t capabilities = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
  std::uint32_t row_padding = 0;    ///< bytes behind each row
  std::uint32_t buffer_shrink = 0;  ///< bytes that each buffer lacks
  std::uint32_t width_px = 8;       ///< whatever is asked for
  std::uint32_t height_px = 4;
  bool silent = false;
};

/// Cameras behind V4L2's calls, and a machine that they are plugged into. Written after the kernel's documentation.
class FakeV4l2 final : public V4l2Calls {
 public:
  void plug(const std::string& path, const FakeCamera& camera) {
    const std::lock_guard lock(mutex_);
    cameras_[path] = camera;
  }
  void unplug(const std::string& path) {
    const std::lock_guard lock(mutex_);
    cameras_.erase(path);
  }
  FakeCamera& camera(const std::string& path) { return cameras_.at(path); }

  /// The camera took a picture: its brightness is x + 10 y + `code`, its color is not.
  void expose(std::uint8_t code, std::uint32_t sequence, double time_s, std::uint32_t flags = monotonic) {
    const std::lock_guard lock(mutex_);
    if (queued_.empty()) return;
    const FakeCamera& it = cameras_.begin()->second;
    const std::uint32_t index = queued_.front();
    queued_.pop_front();
    std::vector<std::uint8_t>& memory = memory_[index];
    const std::uint32_t step = format_ == V4L2_PIX_FMT_GREY ? 1 : 2;
    for (std::uint32_t y = 0; y < it.height_px; ++y) {
      for (std::uint32_t x = 0; x < it.width_px; ++x) {
        std::uint8_t* pixel = memory.data() + y * row_bytes(it) + x * step;
        pixel[0] = static_cast<std::uint8_t>(x + 10 * y + code);
        if (step == 2) pixel[1] = 128;
      }
    }
    v4l2_buffer done{};
    done.index = index;
    done.sequence = sequence;
    done.flags = flags;
    done.bytesused = row_bytes(it) * it.height_px - short_by_;
    done.timestamp.tv_sec = static_cast<long>(time_s);
    done.timestamp.tv_usec = static_cast<long>(1e6 * (time_s - static_cast<double>(done.timestamp.tv_sec)));
    done_.push_back(done);
  }
  void cut(std::uint32_t bytes) { short_by_ = bytes; }

  std::size_t queued() {
    const std::lock_guard lock(mutex_);
    return queued_.size();
  }
  int opened() {
    const std::lock_guard lock(mutex_);
    return static_cast<int>(open_.size());
  }
  int mapped() {
    const std::lock_guard lock(mutex_);
    return mapped_;
  }
  bool streaming() {
    const std::lock_guard lock(mutex_);
    return streaming_;
  }

  static constexpr std::uint32_t monotonic = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC;

  int open(const char* path) override {
    const std::lock_guard lock(mutex_);
    if (!cameras_.contains(path)) return failed(ENOENT);
    open_[++last_] = path;
    return last_;
  }
  void close(int descriptor) override {
    const std::lock_guard lock(mutex_);
    open_.erase(descriptor);
  }

  int ioctl(int descriptor, unsigned long request, void* argument) override {
    const std::lock_guard lock(mutex_);
    const auto path = open_.find(descriptor);
    if (path == open_.end()) return failed(EBADF);
    const auto found = cameras_.find(path->second);
    if (found == cameras_.end()) return failed(ENODEV);
    FakeCamera& it = found->second;
    switch (request) {
      case VIDIOC_QUERYCAP:
        return query(it, *static_cast<v4l2_capability*>(argument));
      case VIDIOC_S_FMT:
        return set_format(it, *static_cast<v4l2_format*>(argument));
      case VIDIOC_S_PARM:
        return failed(ENOTTY);
      case VIDIOC_REQBUFS:
        return request_buffers(it, *static_cast<v4l2_requestbuffers*>(argument));
      case VIDIOC_QUERYBUF: {
        auto& buffer = *static_cast<v4l2_buffer*>(argument);
        buffer.length = static_cast<std::uint32_t>(memory_.at(buffer.index).size());
        buffer.m.offset = buffer.index * 4096;
        return 0;
      }
      case VIDIOC_QBUF:
        queued_.push_back(static_cast<v4l2_buffer*>(argument)->index);
        return 0;
      case VIDIOC_DQBUF:
        if (done_.empty()) return failed(EAGAIN);
        *static_cast<v4l2_buffer*>(argument) = done_.front();
        done_.pop_front();
        return 0;
      case VIDIOC_STREAMON:
        streaming_ = true;
        return 0;
      case VIDIOC_STREAMOFF:
        streaming_ = false;
        return 0;
      default:
        return failed(ENOTTY);
    }
  }

  void* mmap(int, std::size_t, std::size_t offset) override {
    const std::lock_guard lock(mutex_);
    ++mapped_;
    return memory_.at(offset / 4096).data();
  }
  void munmap(void*, std::size_t) override {
    const std::lock_guard lock(mutex_);
    --mapped_;
  }

  bool wait(int descriptor, int timeout_ms) override {
    {
      const std::lock_guard lock(mutex_);
      const auto path = open_.find(descriptor);
      if (!done_.empty() || path == open_.end() || !cameras_.contains(path->second)) return true;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(std::min(timeout_ms, 2)));
    return false;
  }

 private:
  static int failed(int error) {
    errno = error;
    return -1;
  }
  std::uint32_t row_bytes(const FakeCamera& it) const {
    return it.width_px * (format_ == V4L2_PIX_FMT_GREY ? 1 : 2) + it.row_padding;
  }
  static int query(const FakeCamera& it, v4l2_capability& out) {
    std::memcpy(out.card, it.model.c_str(), it.model.size() + 1);
    std::memcpy(out.bus_info, it.bus.c_str(), it.bus.size() + 1);
    out.capabilities = V4L2_CAP_DEVICE_CAPS;
    out.device_caps = it.capabilities;
    return 0;
  }
  int set_format(const FakeCamera& it, v4l2_format& format) {
    if (it.busy) return failed(EBUSY);
    v4l2_pix_format& pix = format.fmt.pix;
    const bool can =
        (pix.pixelformat == V4L2_PIX_FMT_GREY && it.can_gray) || (pix.pixelformat == V4L2_PIX_FMT_YUYV && it.can_yuyv);
    if (!can) pix.pixelformat = V4L2_PIX_FMT_MJPEG;  // as the documentation has it: another one, not an error
    format_ = pix.pixelformat;
    pix.width = it.width_px;
    pix.height = it.height_px;
    pix.bytesperline = row_bytes(it);
    return 0;
  }
  int request_buffers(const FakeCamera& it, v4l2_requestbuffers& request) {
    memory_.assign(request.count, std::vector<std::uint8_t>(row_bytes(it) * it.height_px - it.buffer_shrink));
    queued_.clear();
    done_.clear();
    return 0;
  }

  std::mutex mutex_;
  std::map<std::string, FakeCamera> cameras_;
  std::map<int, std::string> open_;
  int last_ = 2;
  int mapped_ = 0;
  bool streaming_ = false;
  std::uint32_t format_ = 0;
  std::uint32_t short_by_ = 0;
  std::vector<std::vector<std::uint8_t>> memory_;
  std::deque<std::uint32_t> queued_;
  std::deque<v4l2_buffer> done_;
};

}  // namespace focalstage::sample
