#include "io/assets/picture_file.h"

#include <algorithm>
#include <list>
#include <mutex>
#include <utility>

#include "io/files/files.h"
#include "io/image/png.h"

namespace focalstage {
namespace {

using SharedTexture = std::shared_ptr<const Texture>;

/// Pixels lately made, by what they were made of.
class DecodedPictures {
 public:
  SharedTexture find(const std::string& sha256, const TextureUse& use) {
    const std::scoped_lock lock(mutex_);
    return find_locked(sha256, use);
  }

  /// Keeps the texture; another thread's, if that was faster.
  SharedTexture keep(const std::string& sha256, const TextureUse& use, SharedTexture texture) {
    const std::scoped_lock lock(mutex_);
    if (SharedTexture known = find_locked(sha256, use)) return known;
    const std::size_t bytes = texture->rgba.size() + 2 * texture->rgba16.size();
    entries_.push_front({sha256, use, texture, texture, bytes});
    held_bytes_ += bytes;
    let_go();
    return texture;
  }

 private:
  struct Entry {
    std::string sha256;
    TextureUse use;
    std::weak_ptr<const Texture> texture;  ///< as long as somebody has it
    SharedTexture held;                    ///< null once others were asked for since
    std::size_t bytes = 0;
  };
  static constexpr std::size_t most_held_bytes = std::size_t{256} << 20;

  SharedTexture find_locked(const std::string& sha256, const TextureUse& use) {
    const auto found = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) {
      return entry.sha256 == sha256 && entry.use == use && !entry.texture.expired();
    });
    if (found == entries_.end()) return nullptr;
    entries_.splice(entries_.begin(), entries_, found);
    SharedTexture texture = found->texture.lock();
    if (texture && !found->held) {
      found->held = texture;
      held_bytes_ += found->bytes;
      let_go();
    }
    return texture;
  }

  /// The oldest first, until the rest fits.
  void let_go() {
    for (auto entry = entries_.rbegin(); entry != entries_.rend() && held_bytes_ > most_held_bytes; ++entry) {
      if (!entry->held) continue;
      entry->held.reset();
      held_bytes_ -= entry->bytes;
    }
    std::erase_if(entries_, [](const Entry& entry) { return entry.texture.expired(); });
  }

  std::mutex mutex_;
  std::list<Entry> entries_;  ///< the last asked for first
  std::size_t held_bytes_ = 0;
};

DecodedPictures& decoded_pictures() {
  static DecodedPictures pictures;
  return pictures;
}

class EncodedPicture : public StoredPicture {
 public:
  explicit EncodedPicture(AssetFile file) : file_(std::move(file)) {
    if (file_.sha256.empty()) file_.sha256 = sha256_hex(file_.bytes);
  }

  Result<SharedTexture> texture(const TextureUse& use) const override {
    if (SharedTexture known = decoded_pictures().find(file_.sha256, use)) return known;
    Result<Texture> decoded = decode_image(file_.bytes, file_.path, PixelBits::as_stored);
    if (!decoded) return decoded.fault();
    decoded->wrap_u = decoded->wrap_v = use.wrap;
    decoded->magnify = use.filter;
    decoded->color_space = use.color_space;
    return decoded_pictures().keep(file_.sha256, use, std::make_shared<const Texture>(*std::move(decoded)));
  }

 private:
  AssetFile file_;
};

}  // namespace

Result<PictureFile> open_picture(const AssetFile& file) {
  const Result<PictureHead> head = picture_head(file.bytes, file.path);
  if (!head) return head.fault();
  return PictureFile{std::make_shared<const EncodedPicture>(file), head->width_px, head->height_px};
}

}  // namespace focalstage
