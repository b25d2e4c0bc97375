#include "devices/camera/v4l2_stream.h"

#include <linux/videodev2.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <utility>

namespace focalstage {

namespace {

constexpr std::uint32_t buffer_count = 4;
constexpr int longest_side_px = 16384;
// A stamp further from now than that is of another clock, or of none.
constexpr double believable_s = 1.0;

template <std::size_t size>
std::string text_of(const unsigned char (&text)[size]) {
  const auto* end = std::find(std::begin(text), std::end(text), 0);
  return {std::begin(text), end};
}

v4l2_buffer plain_buffer(std::uint32_t index) {
  v4l2_buffer buffer{};
  buffer.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  buffer.memory = V4L2_MEMORY_MMAP;
  buffer.index = index;
  return buffer;
}

/// When the exposure's middle was, as well as a stamp tells: of its start, or of the end of its reading out.
double middle_s(const v4l2_buffer& buffer, double exposure_s, double now_s) {
  const double stamp_s =
      static_cast<double>(buffer.timestamp.tv_sec) + 1e-6 * static_cast<double>(buffer.timestamp.tv_usec);
  const bool monotonic = (buffer.flags & V4L2_BUF_FLAG_TIMESTAMP_MASK) == V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC;
  const double told_s = monotonic && std::abs(stamp_s - now_s) < believable_s ? stamp_s : now_s;
  const bool start = (buffer.flags & V4L2_BUF_FLAG_TSTAMP_SRC_MASK) == V4L2_BUF_FLAG_TSTAMP_SRC_SOE;
  return told_s + (start ? 0.5 : -0.5) * exposure_s;
}

}  // namespace

std::optional<V4l2Description> describe_v4l2(V4l2Calls& calls, const std::string& address) {
  const int descriptor = calls.open(address.c_str());
  if (descriptor < 0) return std::nullopt;
  v4l2_capability can{};
  const bool answered = calls.ioctl(descriptor, VIDIOC_QUERYCAP, &can) == 0;
  calls.close(descriptor);
  const std::uint32_t here = (can.capabilities & V4L2_CAP_DEVICE_CAPS) != 0 ? can.device_caps : can.capabilities;
  constexpr std::uint32_t needed = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
  if (!answered || (here & needed) != needed) return std::nullopt;
  return V4l2Description{address, text_of(can.card), text_of(can.bus_info)};
}

Result<std::unique_ptr<V4l2Stream>> V4l2Stream::open(std::shared_ptr<V4l2Calls> calls, const V4l2Settings& settings,
                                                     const std::string& address) {
  const int descriptor = calls->open(address.c_str());
  if (descriptor < 0) {
    return Fault{"camera.absent", address, std::strerror(errno), "see that it is plugged in, and that you may open it"};
  }
  std::unique_ptr<V4l2Stream> stream(new V4l2Stream(std::move(calls), settings, address, descriptor));
  if (Status done = stream->set_format(); !done) return done.fault();
  stream->set_rate();
  if (Status done = stream->map_buffers(); !done) return done.fault();
  if (Status done = stream->begin(); !done) return done.fault();
  return stream;
}

V4l2Stream::~V4l2Stream() {
  int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  if (streams_) calls_->ioctl(descriptor_, VIDIOC_STREAMOFF, &type);
  for (const Buffer& buffer : buffers_) calls_->munmap(buffer.memory, buffer.length);
  calls_->close(descriptor_);
}

Fault V4l2Stream::refused(const std::string& what) const {
  const int error = errno;
  if (error == EBUSY) {
    return {"camera.busy", address_, "another program has it: " + what, "close that program"};
  }
  return {"camera.refused", address_, what + ": " + std::strerror(error), "see what v4l2-ctl --all says of it"};
}

/// Gray if it can, else the brightness of YUYV; the size that it makes of what was asked.
Status V4l2Stream::set_format() {
  for (const std::uint32_t wanted : {V4L2_PIX_FMT_GREY, V4L2_PIX_FMT_YUYV}) {
    v4l2_format format{};
    format.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    format.fmt.pix.width = static_cast<std::uint32_t>(settings_.width_px);
    format.fmt.pix.height = static_cast<std::uint32_t>(settings_.height_px);
    format.fmt.pix.pixelformat = wanted;
    format.fmt.pix.field = V4L2_FIELD_NONE;
    if (calls_->ioctl(descriptor_, VIDIOC_S_FMT, &format) != 0) {
      if (errno == EBUSY) return refused("its format can't be set");
      continue;
    }
    const v4l2_pix_format& got = format.fmt.pix;
    const std::size_t pixel_bytes = wanted == V4L2_PIX_FMT_GREY ? 1 : 2;
    if (got.pixelformat != wanted || got.width < 1 || got.height < 1) continue;
    if (got.width > longest_side_px || got.height > longest_side_px) continue;
    settings_.width_px = static_cast<int>(got.width);
    settings_.height_px = static_cast<int>(got.height);
    row_bytes_ = std::max<std::size_t>(got.bytesperline, got.width * pixel_bytes);
    pixel_format_ = wanted;
    return {};
  }
  return Fault{"camera.format", address_, "it gives neither GREY nor YUYV", "use a camera that does"};
}

/// A wish: many cameras have their own mind.
void V4l2Stream::set_rate() {
  v4l2_streamparm rate{};
  rate.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  rate.parm.capture.timeperframe.numerator = 1000;
  rate.parm.capture.timeperframe.denominator = static_cast<std::uint32_t>(std::lround(1000.0 * settings_.rate_hz));
  (void)calls_->ioctl(descriptor_, VIDIOC_S_PARM, &rate);
}

Status V4l2Stream::map_buffers() {
  v4l2_requestbuffers request{};
  request.count = buffer_count;
  request.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  request.memory = V4L2_MEMORY_MMAP;
  if (calls_->ioctl(descriptor_, VIDIOC_REQBUFS, &request) != 0) return refused("it gives no buffers");
  const std::size_t needed = row_bytes_ * static_cast<std::size_t>(settings_.height_px);
  for (std::uint32_t i = 0; i < std::min(request.count, buffer_count); ++i) {
    v4l2_buffer buffer = plain_buffer(i);
    if (calls_->ioctl(descriptor_, VIDIOC_QUERYBUF, &buffer) != 0) return refused("a buffer is not told");
    void* memory = calls_->mmap(descriptor_, buffer.length, buffer.m.offset);
    if (memory == nullptr) return refused("a buffer can't be mapped");
    buffers_.push_back({memory, buffer.length});
    if (buffer.length < needed) {
      return Fault{"camera.refused", address_, "its buffers are smaller than its pictures", ""};
    }
  }
  if (buffers_.size() < 2) return Fault{"camera.refused", address_, "it has too few buffers", ""};
  return {};
}

Status V4l2Stream::begin() {
  for (std::uint32_t i = 0; i < buffers_.size(); ++i) {
    v4l2_buffer buffer = plain_buffer(i);
    if (calls_->ioctl(descriptor_, VIDIOC_QBUF, &buffer) != 0) return refused("a buffer is not taken");
  }
  int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  if (calls_->ioctl(descriptor_, VIDIOC_STREAMON, &type) != 0) return refused("it does not begin to stream");
  streams_ = true;
  return {};
}

Result<std::shared_ptr<const CameraFrame>> V4l2Stream::next(int timeout_ms, double now_s) {
  std::shared_ptr<const CameraFrame> none;
  if (!calls_->wait(descriptor_, timeout_ms)) return none;
  v4l2_buffer buffer = plain_buffer(0);
  if (calls_->ioctl(descriptor_, VIDIOC_DQBUF, &buffer) != 0) {
    if (errno == EAGAIN) return none;
    return Fault{"camera.unplugged", address_, std::strerror(errno), "plug it in again"};
  }
  const bool good = (buffer.flags & V4L2_BUF_FLAG_ERROR) == 0 && buffer.index < buffers_.size();
  if (good) {
    none = picture(buffers_[buffer.index], buffer.bytesused, buffer.sequence,
                   middle_s(buffer, settings_.exposure_s, now_s));
  }
  if (calls_->ioctl(descriptor_, VIDIOC_QBUF, &buffer) != 0) {
    return Fault{"camera.unplugged", address_, std::strerror(errno), "plug it in again"};
  }
  return none;
}

/// Null where the picture is not whole.
std::shared_ptr<const CameraFrame> V4l2Stream::picture(const Buffer& buffer, std::size_t used, std::uint32_t sequence,
                                                       double time_s) const {
  const auto width = static_cast<std::size_t>(settings_.width_px);
  const auto height = static_cast<std::size_t>(settings_.height_px);
  const std::size_t pixel_bytes = pixel_format_ == V4L2_PIX_FMT_GREY ? 1 : 2;
  if (used < row_bytes_ * (height - 1) + width * pixel_bytes || used > buffer.length) return nullptr;
  auto frame = std::make_shared<CameraFrame>();
  frame->width_px = settings_.width_px;
  frame->height_px = settings_.height_px;
  frame->number = sequence;
  frame->time_s = time_s;
  frame->gray.resize(width * height);
  const auto* bytes = static_cast<const std::uint8_t*>(buffer.memory);
  for (std::size_t y = 0; y < height; ++y) {
    const std::uint8_t* row = bytes + y * row_bytes_;
    for (std::size_t x = 0; x < width; ++x) frame->gray[y * width + x] = row[x * pixel_bytes];
  }
  return frame;
}

}  // namespace focalstage
