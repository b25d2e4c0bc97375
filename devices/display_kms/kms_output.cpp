#include "devices/display_kms/kms_output.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>

namespace focalstage {

namespace {

Fault fault(const char* code, const std::string& where, const std::string& message, const std::string& remedy) {
  return {code, where, message, remedy};
}

std::string words(int error) { return std::strerror(-error); }

std::string describe_mode(const drmModeModeInfo& mode) {
  std::array<char, 48> text{};
  std::snprintf(text.data(), text.size(), "%dx%d@%.3f", mode.hdisplay, mode.vdisplay, 1.0 / interval_s(mode));
  return text.data();
}

bool fits(const std::string& wanted, const std::string& found) { return wanted.empty() || wanted == found; }

/// Frees what libdrm handed out.
template <class T>
struct Freer {
  DrmCalls* drm = nullptr;
  void operator()(T* thing) const { drm->free(thing); }
};
template <class T>
std::unique_ptr<T, Freer<T>> owned(DrmCalls& drm, T* thing) {
  return {thing, Freer<T>{&drm}};
}

}  // namespace

double interval_s(const drmModeModeInfo& mode) {
  const double doubled = (mode.flags & DRM_MODE_FLAG_DBLSCAN) != 0 ? 2.0 : 1.0;
  return mode.clock == 0 ? 0.0 : doubled * mode.htotal * mode.vtotal / (1e3 * mode.clock);
}

std::vector<KmsConnector> list_connectors(DrmCalls& drm) {
  std::vector<KmsConnector> found;
  for (const std::string& path : drm.cards()) {
    const int card = drm.open(path);
    if (card < 0) continue;
    if (const auto resources = owned(drm, drm.resources(card))) {
      for (int i = 0; i < resources->count_connectors; ++i) {
        const auto connector = owned(drm, drm.connector(card, resources->connectors[i], true));
        if (!connector || connector->connection != DRM_MODE_CONNECTED) continue;
        const auto identity = parse_edid(drm.blob(card, *connector, "EDID"));
        found.push_back({path,
                         connector->connector_id,
                         identity.value_or(EdidIdentity{}),
                         {connector->modes, connector->modes + connector->count_modes}});
      }
    }
    drm.close(card);
  }
  return found;
}

Result<KmsConnector> choose_connector(const std::vector<KmsConnector>& all, const KmsSettings& settings) {
  std::vector<const KmsConnector*> fitting;
  std::string names;
  for (const KmsConnector& connector : all) {
    names += (names.empty() ? "" : ", ") + describe(connector.identity);
    const EdidIdentity& identity = connector.identity;
    if (fits(settings.maker, identity.maker) && fits(settings.name, identity.name) &&
        fits(settings.serial, identity.serial)) {
      fitting.push_back(&connector);
    }
  }
  if (fitting.size() == 1) return *fitting.front();
  if (fitting.empty()) {
    return fault("display.absent", "display",
                 "no such display is connected; there are: " + (all.empty() ? "none" : names),
                 "connect it and switch it on, or change its maker, name and serial in the settings");
  }
  return fault("display.which", "display", "several displays fit: " + names,
               "say by maker, name and serial which one is the projector");
}

Result<drmModeModeInfo> choose_mode(const KmsConnector& connector, const KmsSettings& settings) {
  const drmModeModeInfo* best = nullptr;
  const auto away = [&](const drmModeModeInfo& mode) { return std::abs(1.0 / interval_s(mode) - settings.rate_hz); };
  std::string names;
  for (const drmModeModeInfo& mode : connector.modes) {
    if (mode.clock == 0 || (mode.flags & DRM_MODE_FLAG_INTERLACE) != 0) continue;
    names += (names.empty() ? "" : ", ") + describe_mode(mode);
    if (mode.hdisplay != settings.width_px || mode.vdisplay != settings.height_px) continue;
    if (away(mode) > settings.rate_tolerance * settings.rate_hz) continue;
    if (best == nullptr || away(mode) < away(*best)) best = &mode;
  }
  if (best != nullptr) return *best;
  std::array<char, 48> wanted{};
  std::snprintf(wanted.data(), wanted.size(), "%dx%d@%.3f", settings.width_px, settings.height_px, settings.rate_hz);
  return fault("display.mode", describe(connector.identity),
               std::string("it has no mode ") + wanted.data() + "; it has " + (names.empty() ? "none" : names),
               "choose one of these, or look at the projector's EDID");
}

Result<std::unique_ptr<KmsOutput>> KmsOutput::open(DrmCalls& drm, const KmsSettings& settings) {
  const Result<KmsConnector> connector = choose_connector(list_connectors(drm), settings);
  if (!connector) return connector.fault();
  const Result<drmModeModeInfo> mode = choose_mode(*connector, settings);
  if (!mode) return mode.fault();
  std::unique_ptr<KmsOutput> output(new KmsOutput(drm));
  if (const Status taken = output->take(*connector, *mode); !taken) return taken.fault();
  return output;
}

Status KmsOutput::take(const KmsConnector& chosen, const drmModeModeInfo& mode) {
  mode_ = mode;
  connector_ = chosen.id;
  card_ = drm_.open(chosen.card);
  if (card_ < 0) {
    return fault("display.permission", chosen.card, words(card_), "let this user into the group video");
  }
  if (const int error = drm_.set_master(card_); error != 0) {
    return fault("display.busy", chosen.card, "its outputs belong to another program: " + words(error),
                 "stop the window system on this card, or use the window back end there");
  }
  master_ = true;
  if (!drm_.monotonic(card_)) {
    return fault("display.refused", chosen.card, "it does not tell vblanks by the monotonic clock",
                 "use a kernel from 4.15 on");
  }
  const auto connector = owned(drm_, drm_.connector(card_, connector_, false));
  if (!connector) return fault("display.absent", chosen.card, "its connector went away", "plug it in again");
  if (const Status found = find_crtc(*connector); !found) return found;
  if (const Status made = make_buffers(); !made) return made;
  before_ = drm_.crtc(card_, crtc_);
  make_exact(*connector);
  if (const int error = drm_.set_crtc(card_, crtc_, buffers_[0].framebuffer, connector_, &mode_); error != 0) {
    return fault("display.refused", describe(chosen.identity), "its mode cannot be set: " + words(error),
                 "look whether another output of this card can be switched off");
  }
  return {};
}

Status KmsOutput::find_crtc(const drmModeConnector& connector) {
  const auto resources = owned(drm_, drm_.resources(card_));
  for (int e = 0; resources && e < connector.count_encoders; ++e) {
    const auto encoder = owned(drm_, drm_.encoder(card_, connector.encoders[e]));
    for (int c = 0; encoder && c < resources->count_crtcs; ++c) {
      if ((encoder->possible_crtcs >> c & 1U) == 0) continue;
      // One that lights another display stays with it.
      const bool own = encoder->encoder_id == connector.encoder_id && encoder->crtc_id == resources->crtcs[c];
      const auto crtc = owned(drm_, drm_.crtc(card_, resources->crtcs[c]));
      if (!crtc || (crtc->mode_valid != 0 && !own)) continue;
      crtc_ = resources->crtcs[c];
      return {};
    }
  }
  return fault("display.refused", "display", "no part of the card is free to light it",
               "switch another output of this card off");
}

Status KmsOutput::make_buffers() {
  for (Buffer& buffer : buffers_) {
    int error = drm_.create_buffer(card_, mode_.hdisplay, mode_.vdisplay, buffer.memory);
    if (error == 0) {
      error = drm_.add_framebuffer(card_, mode_.hdisplay, mode_.vdisplay, buffer.memory, buffer.framebuffer);
    }
    if (error == 0) buffer.bytes = drm_.map_buffer(card_, buffer.memory);
    if (buffer.bytes == nullptr) {
      return fault("display.refused", "display", "no memory for its frames: " + words(error != 0 ? error : -ENOMEM),
                   "close other programs that draw");
    }
    fill(buffer, nullptr);
  }
  return {};
}

void KmsOutput::make_exact(const drmModeConnector& connector) {
  (void)drm_.set_property(card_, connector, "Broadcast RGB", "Full");
  (void)drm_.set_property(card_, connector, "max bpc", "8");
  (void)drm_.set_property(card_, connector, "dithering mode", "off");
  (void)drm_.set_property(card_, connector, "dither", "off");
  (void)drm_.set_property(card_, connector, "scaling mode", "None");
  if (before_ == nullptr || before_->gamma_size < 2) return;
  std::vector<std::uint16_t> ramp(static_cast<std::size_t>(before_->gamma_size));
  for (std::size_t i = 0; i < ramp.size(); ++i) ramp[i] = static_cast<std::uint16_t>(i * 65535 / (ramp.size() - 1));
  (void)drm_.set_gamma(card_, crtc_, ramp);
}

void KmsOutput::fill(Buffer& buffer, const std::vector<std::uint32_t>* pixels) const {
  if (pixels == nullptr) {
    if (!buffer.black) std::memset(buffer.bytes, 0, buffer.memory.size);
    buffer.black = true;
    return;
  }
  buffer.black = false;
  const std::size_t row = std::size_t{4} * mode_.hdisplay;
  for (std::size_t y = 0; y < mode_.vdisplay; ++y) {
    std::memcpy(buffer.bytes + y * buffer.memory.pitch, pixels->data() + y * mode_.hdisplay, row);
  }
}

VideoMode KmsOutput::mode() const { return {mode_.hdisplay, mode_.vdisplay, interval_s(mode_)}; }

int KmsOutput::flip(const std::vector<std::uint32_t>* pixels) {
  Buffer& buffer = buffers_[next_];
  fill(buffer, pixels);
  const int error = drm_.page_flip(card_, crtc_, buffer.framebuffer);
  if (error == 0) next_ = (next_ + 1) % buffers_.size();
  return error;
}

void KmsOutput::off() { (void)drm_.set_crtc(card_, crtc_, 0, 0, nullptr); }

bool KmsOutput::connected() {
  const auto connector = owned(drm_, drm_.connector(card_, connector_, false));
  return connector && connector->connection == DRM_MODE_CONNECTED;
}

KmsOutput::~KmsOutput() {
  if (card_ < 0) return;
  if (before_ != nullptr) {
    drmModeModeInfo* mode = before_->mode_valid != 0 ? &before_->mode : nullptr;
    const bool had = mode != nullptr && before_->buffer_id != 0;
    (void)drm_.set_crtc(card_, crtc_, had ? before_->buffer_id : 0, connector_, had ? mode : nullptr);
    drm_.free(before_);
  }
  for (const Buffer& buffer : buffers_) {
    if (buffer.bytes != nullptr) drm_.unmap_buffer(buffer.bytes, buffer.memory.size);
    if (buffer.framebuffer != 0) drm_.remove_framebuffer(card_, buffer.framebuffer);
    if (buffer.memory.handle != 0) drm_.destroy_buffer(card_, buffer.memory.handle);
  }
  if (master_) drm_.drop_master(card_);
  drm_.close(card_);
}

}  // namespace focalstage
